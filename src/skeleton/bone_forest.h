#pragma once

#include <span>
#include <vector>

#include "model/bone_graph.h"
#include "skeleton/rigid_motion.h"

namespace skinforge {

/// The trees that bones form, in any order of edges (ETH Sec. 3). One entry a bone unless it says else.
struct BoneForest {
  std::vector<Vec3> source, end;     ///< rest positions of the joints of each bone
  std::vector<std::int32_t> parent;  ///< the bone that ends where this one starts; -1 for root bones
  std::vector<std::int32_t> order;   ///< every bone once, parents before children
  std::vector<std::int32_t> roots;   ///< bones without parent, rising; at least one

  std::size_t size() const { return parent.size(); }
};

/// Throws Error (BadInput) where a joint is the end of two bones, or bones form a cycle. Linear.
BoneForest make_bone_forest(const BoneGraph& graph);

/// Absolute motion of each bone with respect to its rest pose, from its rotation relative to its parent,
/// given in model axes of the rest pose (ETH Sec. 3). With r the rest position of the source joint: a root
/// bone turns about it, R = q, T = r - R r; a child of p has R = R_p q, T = T_p + R_p r - R r, so that its
/// source stays at its parent's end. `local`: one unit quaternion a bone. Linear.
std::vector<RigidMotion> forward_kinematics(const BoneForest& forest, std::span<const Quat> local);

/// Rotations on the way from rest (t = 0) to `target` (t = 1): per bone slerp along the shorter arc. (The
/// literal ETH Eq. 1 takes the long way where a quaternion has w < 0; both meet at t = 1.)
std::vector<Quat> pose_towards(std::span<const Quat> target, double t);

}  // namespace skinforge
