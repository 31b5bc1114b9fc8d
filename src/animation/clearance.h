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
  /// Arguments as for `complete_clip`; all must outlive it.
  Clearance(std::span<const Character* const> characters, const Graft& graft,
            std::span<const MotionSet* const> motions, const DrivingClip& driver, const PartToComplete& part);

  /// Depth of the deepest pair beyond what it has in the bind pose, as a share of the base's diagonal. 0 =
  /// they are clear. `driver_frame`, `candidate`: frames of the two motion sets.
  double depth(std::size_t driver_frame, std::size_t candidate);
  /// The same for all candidates, 0 for those that are not allowed; `allowed` must not change between calls.
  std::vector<double> depths(std::size_t driver_frame, const std::vector<bool>& allowed);

 private:
  // One side of a seam: the balls of a source, and how they come into the frame of the joint it meets at.
  struct Side {
    const Character* input = nullptr;
    const MotionSet* set = nullptr;
    JointId anchor;  // of the input: balls are taken relative to it; invalid: to the model
    Affine3 from_anchor = Affine3::Identity();  // into the frame where both sides meet
    double scale = 1;                           // of radii
    std::vector<std::vector<Vec3>> places;      // per frame, when asked for
    std::vector<Vec3> bind;

    const std::vector<Vec3>& at(std::size_t frame);
    Affine3 from_model(const Pose& pose) const;
    std::vector<Vec3> bind_places() const;
  };
  struct Pair {
    std::size_t driver, part;  // balls
    double touch;              // distance at which they count
  };
  struct Seam {
    Side driver, part;
    double unit = 1;  // what a length in its frame is, of the base's diagonal
    std::vector<Pair> pairs;
    std::vector<Eigen::AlignedBox3d> reach;  // per ball of the part, over all allowed candidates
  };

  static std::vector<Eigen::AlignedBox3d> reach_of(Side& part, const std::vector<bool>& allowed);
  static std::vector<Pair> all_pairs(const Seam& seam);
  std::vector<Seam> seams_;
};

}  // namespace skinforge
