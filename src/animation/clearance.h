#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "animation/seam.h"

namespace skinforge {

/// How deep a completed part and the driving part go into each other where one hangs on the other, asked of
/// balls inside their skins (`MotionSet::balls`): rough, but for thousands of keyframes at once.
class Clearance {
 public:
  /// Frames of the driver's motion set, [first, first + count); refers to the motion sets.
  Clearance(std::span<const Seam> seams, std::size_t first, std::size_t count);

  /// Depth of the deepest pair beyond what it has in the bind pose, as a share of the base's diagonal. 0 =
  /// they are clear. `row`: of the driver's frames; `candidate`: frame of the part's motion set.
  double depth(std::size_t row, std::size_t candidate) const;
  /// The same for all candidates, but at most `most`.
  Eigen::ArrayXf depths(std::size_t row, std::size_t candidates, double most) const;

 private:
  // Two balls that may meet.
  struct Pair {
    std::size_t driver, part;
    float touch;  // distance at which they count
  };
  // A ball's places in a stretch of frames that begins at a multiple of its length.
  using Reaches = std::vector<Eigen::AlignedBox3f>;
  struct Side {
    std::vector<BallTrack> driver, part;  // per ball
    std::vector<Reaches> reaches;         // per ball of the part
    std::vector<Pair> pairs;
    float unit = 1;  // what a length in its frame is, of the base's diagonal
  };
  // Of candidates, in lengths of a seam's frame, and the least of each stretch.
  struct Depths {
    std::size_t count;
    float most;
    std::vector<float> deepest, shallowest;
  };
  static void deepen(const Side& side, const Pair& pair, const Eigen::Vector3f& ball, std::size_t stretch,
                     Depths& depths);

  std::vector<Side> sides_;
};

}  // namespace skinforge
