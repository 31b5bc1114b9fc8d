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
  // Balls of both sides, thick ones first.
  struct Side {
    std::vector<BallTrack> driver, part;
    // Per ball of the part: the boxes of its places in stretches of frames.
    std::vector<std::vector<Eigen::AlignedBox3f>> reaches;
    // Balls of the driver that a ball of the part may meet, and the distance at which they count; for each
    // ball of the part [begin[b], begin[b + 1]), whole blocks, filled up with some that never count.
    std::vector<std::size_t> begin = {0};
    std::vector<std::uint32_t> meets;
    std::vector<float> touch;
    float unit = 1;  // what a length in its frame is, of the base's diagonal

    void add(std::uint32_t driver_ball, float distance);
    std::vector<float> met_at(std::size_t row, std::size_t part_ball) const;  // 3 x #met
  };
  // Of candidates, in lengths of a seam's frame, and the least of each stretch.
  struct Depths {
    std::size_t count;
    float most;
    std::vector<float> deepest, shallowest;
    std::vector<std::uint32_t> near;  // room
  };
  static Side make_side(const Seam& seam, std::size_t first, std::size_t count);
  static void deepen(const Side& side, std::size_t part_ball, const std::vector<float>& met,
                     std::size_t stretch, Depths& depths);

  std::vector<Side> sides_;
};

}  // namespace skinforge
