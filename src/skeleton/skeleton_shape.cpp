#include "skeleton/skeleton_shape.h"

#include <Eigen/Geometry>

#include "skeleton/pose.h"

namespace skinforge {
namespace {
constexpr double kMinLength = 1e-9;  // ours: of the extent; far below any joint offset, above rounding
}

SkeletonShape::SkeletonShape(const Skeleton& skeleton, const Similarity& model_from_input) {
  Eigen::AlignedBox3d box;
  std::vector<int> child_count(skeleton.size(), 0);
  for (const Affine3& joint : model_from_joint(skeleton, bind_pose(skeleton))) {
    positions_.push_back(model_from_input * Vec3(joint.translation()));
    box.extend(positions_.back());
  }
  for (const Joint& joint : skeleton.joints) {
    parents_.push_back(joint.parent);
    if (joint.parent.is_valid()) ++child_count[joint.parent.index()];
  }
  if (!box.isEmpty()) min_length_ = kMinLength * box.diagonal().norm();
  for (std::size_t j = 0; j < size(); ++j)
    valence_.push_back(child_count[j] + (parents_[j].is_valid() ? 1 : 0));
  measure_parametric(child_count);
  count_hops();
}

std::optional<Vec3> SkeletonShape::direction(JointId from, JointId to) const {
  const Vec3 offset = position(to) - position(from);
  const double length = offset.norm();
  if (length <= min_length_) return std::nullopt;
  return Vec3(offset / length);
}

void SkeletonShape::measure_parametric(const std::vector<int>& child_count) {
  const std::size_t n = size();
  std::vector<double> length(n, 0.0);  // from the root
  std::vector<int> depth(n, 0);        // edges from the root
  for (std::size_t j = 1; j < n; ++j) {
    const std::size_t parent = parents_[j].index();
    length[j] = length[parent] + (positions_[j] - positions_[parent]).norm();
    depth[j] = depth[parent] + 1;
  }
  // Per joint, over the paths through it: their number, and the sums of 1 / length and of 1 / edges.
  std::vector<double> paths(n, 0.0), per_length(n, 0.0), per_edge(n, 0.0);
  for (std::size_t j = n; j-- > 0;) {
    if (child_count[j] == 0) {
      paths[j] = 1;
      if (length[j] > min_length_)
        per_length[j] = 1 / length[j];
      else if (depth[j] > 0)
        per_edge[j] = 1.0 / depth[j];
    }
    if (j == 0) break;
    const std::size_t parent = parents_[j].index();
    paths[parent] += paths[j];
    per_length[parent] += per_length[j];
    per_edge[parent] += per_edge[j];
  }
  parametric_.resize(n);
  for (std::size_t j = 0; j < n; ++j)
    parametric_[j] = (length[j] * per_length[j] + depth[j] * per_edge[j]) / paths[j];
}

void SkeletonShape::count_hops() {
  const std::size_t n = size();
  hops_.assign(n * n, 0);
  for (std::size_t i = 1; i < n; ++i)
    for (std::size_t j = 0; j < i;
         ++j) {  // j is no descendant of i, so every way from i starts at its parent
      const int hops = hops_[parents_[i].index() * n + j] + 1;
      hops_[i * n + j] = hops_[j * n + i] = static_cast<std::uint16_t>(hops);
    }
}

}  // namespace skinforge
