#pragma once

#include <vector>

#include "base/math.h"

namespace skinforge {

/// Relative rotations of all bones, frame after frame (ETH Sec. 1.1).
struct RotationFrames {
  std::vector<std::vector<Quat>> frames;  ///< [frame][bone], unit
  std::size_t normalised = 0;  ///< rows that were off unit length, or off a rotation, by more than 1e-5
  std::size_t flips = 0;  ///< quaternions turned to the side of the frame before: -q is the same rotation
};

/// A table of rotations as frames of `bones` rotations each: rows x, y, z, w (4 columns), matrices row by row
/// (9 columns), or matrices below each other (3 columns). Frame after frame, in it bone after bone. Rotations
/// of each bone come out on one side of the double cover, so that keys can be interpolated. A matrix is
/// brought to the nearest rotation. Throws Error (BadInput) where the rows are no multiple of the bones, for
/// another number of columns, for a quaternion of length below 1e-6, and for a matrix farther than 0.1 from
/// every rotation.
RotationFrames rotation_frames(const Eigen::MatrixXd& table, std::size_t bones);

}  // namespace skinforge
