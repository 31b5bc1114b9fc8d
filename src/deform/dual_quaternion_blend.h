#pragma once

#include <span>
#include <vector>

#include "model/skin_weights.h"
#include "skeleton/rigid_motion.h"

namespace skinforge {

/// Dual quaternion skinning (ETH Eq. 4, Kavan 2007): the dual quaternions of the bones are mixed by weight
/// and scaled to unit length, so that every vertex moves rigidly. Before, each quaternion that lies on the
/// other hemisphere than that of the vertex's largest weight (lowest joint on ties) is negated: q and -q are
/// one rotation, and the order of bones does not matter. Bones that cancel out (half turns against each
/// other) leave the vertex to its largest weight alone, so nothing becomes NaN. `positions`: #V, rest pose.
/// `weights`: a row a vertex, any order, sum 1; an empty row keeps its place. `motions`: one a joint. Linear
/// in influences, parallel over vertices, same bits for any number of threads.
std::vector<Vec3> dual_quaternion_blend(std::span<const Vec3> positions, const SkinWeights& weights,
                                        std::span<const RigidMotion> motions);

/// The rigid motion of each vertex, as above.
std::vector<RigidMotion> dual_quaternion_motions(const SkinWeights& weights,
                                                 std::span<const RigidMotion> motions);

/// The entry with the largest weight, the lowest joint on ties. The row must not be empty.
const Influence& largest_influence(std::span<const Influence> row);

}  // namespace skinforge
