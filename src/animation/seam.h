#pragma once

#include <Eigen/Geometry>
#include <array>
#include <span>
#include <vector>

#include "animation/completed_part.h"

namespace skinforge {

/// Where one ball is in some frames of a motion set, in the frame of its seam; refers to the set.
struct BallTrack {
  std::array<Eigen::Map<const Eigen::ArrayXf>, 3> places;

  Eigen::Vector3f at(std::size_t frame) const {
    const auto f = static_cast<Eigen::Index>(frame);
    return {places[0][f], places[1][f], places[2][f]};
  }
};

/// One of two sources at a seam.
struct SeamSide {
  SourceId source;
  const MotionSet* set = nullptr;
  const SeamBalls* balls = nullptr;
  double scale = 1;  ///< of radii: what a metre of the input is in the seam's frame

  /// Of all balls, in `count` frames of the set from `first` on.
  std::vector<BallTrack> tracks(std::size_t first, std::size_t count) const;
};

/// A site where a completed part and the driving part hang on each other.
struct Seam {
  std::size_t site = 0;  ///< of the graft
  SeamSide driver, part;
  double unit = 1;  ///< what a length in its frame is, of the base's diagonal

  /// Sum of the radii of two balls, in the seam's frame.
  double radii(std::size_t driver_ball, std::size_t part_ball) const;
  /// Distance at which they count as cutting: the sum of their radii, or their distance in the bind pose
  /// where that is less, as where the parts grow together.
  /// `thickness`: of the balls, times their radius.
  double touching(std::size_t driver_ball, std::size_t part_ball, double thickness = 1) const;
};

/// Seams where both sides have frames. Arguments as for `complete_clip`; refers to `motions`.
std::vector<Seam> seams_between(std::span<const Character* const> characters, const Graft& graft,
                                std::span<const MotionSet* const> motions, const DrivingClip& driver,
                                const PartToComplete& part);

}  // namespace skinforge
