#pragma once

#include <span>
#include <vector>

#include "model/skeleton.h"

namespace skinforge {

/// One local transform per joint: parent_from_joint.
using Pose = std::vector<Transform>;

/// The bind pose.
Pose bind_pose(const Skeleton& skeleton);

/// model_from_joint of every joint in `pose` (forward kinematics). Linear.
std::vector<Affine3> model_from_joint(const Skeleton& skeleton, std::span<const Transform> pose);

/// model_from_joint of one joint: the product of the local transforms down to it.
Affine3 model_from_joint(const Skeleton& skeleton, std::span<const Transform> pose, JointId joint);

/// model_from_joint rotations only: the product of the local rotations down from the root. Linear.
std::vector<Quat> global_rotations(const Skeleton& skeleton, std::span<const Transform> pose);

/// The matrices that skinning reads, model_from_joint * joint_from_model: mesh points in the bind pose ->
/// posed.
std::vector<Affine3> skinning_palette(const Skeleton& skeleton, std::span<const Transform> pose);

/// Spreads translations given at some joints over all others: harmonic over the joint tree seen as a graph,
/// the given joints fixed (Sec. 4.1, smoothing to convergence, solved at once). No given joint: all zero.
std::vector<Vec3> spread_translations(const Skeleton& skeleton,
                                      std::span<const std::pair<JointId, Vec3>> given);

}  // namespace skinforge
