#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/skeleton.h"

namespace skinforge {

/// What the joint map asks of a skeleton, worked out once: bind positions, parametric positions, valences and
/// hop counts (SkinMixer Sec. 5.1).
class SkeletonShape {
 public:
  /// `model_from_input` places the bind pose first: directions of two skeletons are compared as they will
  /// stand together. Quadratic in joints (the hop counts).
  explicit SkeletonShape(const Skeleton& skeleton, const Similarity& model_from_input = {});

  std::size_t size() const { return positions_.size(); }
  JointId root() const { return JointId(0); }
  /// Parent of a joint; invalid for the root.
  JointId parent(JointId joint) const { return parents_[joint.index()]; }
  /// Bind position, model space.
  const Vec3& position(JointId joint) const { return positions_[joint.index()]; }
  /// Unit vector from one joint to the other; none when they lie closer than 1e-9 of the skeleton's extent.
  std::optional<Vec3> direction(JointId from, JointId to) const;
  /// P of Sec. 5.1: 0 at the root, 1 at leaves; the mean, over all paths from the root to a leaf through the
  /// joint, of its share of the path's length. Paths without length count edges instead; a lone joint has 0.
  double parametric(JointId joint) const { return parametric_[joint.index()]; }
  /// Number of joints connected to this one: its children and its parent.
  int valence(JointId joint) const { return valence_[joint.index()]; }
  /// Number of edges between two joints.
  int hops(JointId a, JointId b) const { return hops_[a.index() * size() + b.index()]; }

 private:
  void measure_parametric(const std::vector<int>& child_count);
  void count_hops();

  std::vector<Vec3> positions_;
  std::vector<JointId> parents_;
  std::vector<double> parametric_;
  std::vector<int> valence_;
  std::vector<std::uint16_t> hops_;
  double min_length_ = 0;
};

}  // namespace skinforge
