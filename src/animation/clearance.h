#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "animation/completed_part.h"

namespace skinforge {

/// Balls inside the skin: of each joint in `kept` those that lie along the vertices it moves most, as thick
/// as these lie round their axis.
std::vector<SkinBall> skin_balls(const Character& input, std::span<const JointId> kept);

/// Where the balls of a set are in each of its frames: #frames x #balls x 3, in the input's model space.
std::vector<float> ball_centers(const Skeleton& skeleton, const MotionSet& set);

/// How deep a completed part and the driving part go into each other where one hangs on the other, asked of
/// balls inside their skins (`MotionSet::balls`): rough, but for thousands of keyframes at once.
class Clearance {
 public:
  /// Frames of the driver's motion set, [first, first + count), and flags of the part's keyframes that may be
  /// asked about.
  struct Scope {
    std::size_t first = 0, count = 0;
    const std::vector<bool>& allowed;
  };
  /// Other arguments as for `complete_clip`; nothing of them is kept.
  Clearance(std::span<const Character* const> characters, const Graft& graft,
            std::span<const MotionSet* const> motions, const DrivingClip& driver, const PartToComplete& part,
            const Scope& scope);

  /// Depth of the deepest pair beyond what it has in the bind pose, as a share of the base's diagonal. 0 =
  /// they are clear. `row`: of the scope; `candidate`: allowed frame of the part's motion set.
  double depth(std::size_t row, std::size_t candidate) const;
  /// The same for all candidates, 0 for those that are not allowed.
  Eigen::ArrayXf depths(std::size_t row) const;

 private:
  // Places of one ball, one per frame.
  struct Track {
    Eigen::ArrayX3f places;
    Eigen::AlignedBox3f reach;
  };
  // Two balls that may meet.
  struct Pair {
    std::size_t driver, part;
    float touch;  // distance at which they count
  };
  struct Seam {
    std::vector<Track> driver, part;  // per ball
    std::vector<Pair> pairs;
    float unit = 1;  // what a length in its frame is, of the base's diagonal
  };
  struct Side;
  static Seam make_seam(const Side& driver, const Side& part, double unit, const Scope& scope);

  Eigen::Index candidates_;
  std::vector<Seam> seams_;
};

}  // namespace skinforge
