#pragma once

#include <openvdb/openvdb.h>

#include "field/signed_distance.h"

/// OpenVDB's side of a distance field. Only the two files that need OpenVDB include this.
namespace skinforge {

/// The field as a sparse grid in index space (voxel 1, point (i, j, k) of the lattice at (i, j, k)), its
/// values times `unit`, its background the largest of them, at least one voxel's. The values of the lattice's
/// faces go on for `padding` points outside. Blocks of 8 x 8 x 8 points in which `keep(low, high)` holds, low
/// and high being the extreme values of the block and its neighbouring points, are stored and active where
/// |value| < background; the others become inactive tiles of plus or minus the background.
openvdb::FloatGrid::Ptr sparse_grid(const DistanceField& field, int padding, float unit,
                                    bool (*keep)(float low, float high, float background));

}  // namespace skinforge
