#pragma once

#include "stages/rigging.h"

/// Files that count by the vertices and bones of a bound model's files, and tables that do.
namespace skinforge {

/// One pose of a .dmat file. Throws Error (BadInput) with the file.
Pose read_pose(const InputFile& file, const Rigged& rigged);

/// A shape whose vertices count as those of the model's file: #V of the character. Throws Error (BadInput).
std::vector<Vec3> read_shape(const InputFile& file, const Rigged& rigged);

/// The weights, #vertices of the file x #bones.
Eigen::MatrixXd weight_table(const Rigged& rigged);
/// The handles, one column: bones from 0, -1 = free.
Eigen::MatrixXd handle_table(const Rigged& rigged);

}  // namespace skinforge
