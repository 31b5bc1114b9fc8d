#pragma once

#include <span>
#include <vector>

#include "model/skeleton.h"

namespace skinforge {

/// A straight piece of a bone, rest pose, model space, metres. `a` may equal `b` (a bone without length).
struct BoneSegment {
  JointId joint;  ///< the joint that moves it
  Vec3 a = Vec3::Zero(), b = Vec3::Zero();

  /// The point of the segment nearest to `p`; finite for any length.
  Vec3 closest(const Vec3& p) const;
  double distance(const Vec3& p) const { return (closest(p) - p).norm(); }
};

/// The bones of a skeleton, by rising joint: from each joint to each of its children, moved by the joint. A
/// joint without children gets half the segment of its parent, carried on in the same direction, unless its
/// name says that it only marks an end ("_end", ".end", "Nub", "_leaf"; any case). Pieces shorter than 1e-6
/// of the skeleton's extent are left out where the joint has a longer one.
std::vector<BoneSegment> bone_segments(const Skeleton& skeleton);

/// For each of `points` the joint of the nearest segment, ties to the lowest joint. Quadratic.
std::vector<JointId> nearest_bones(std::span<const Vec3> points, std::span<const BoneSegment> segments);

}  // namespace skinforge
