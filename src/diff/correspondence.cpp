#include "diff/correspondence.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <tuple>

namespace skinforge {

namespace {
std::vector<Vec3> bind_positions(const Skeleton& skeleton) {
  std::vector<Vec3> positions;
  for (const Affine3& m : skeleton.model_from_joint()) positions.push_back(m.translation());
  return positions;
}

std::vector<JointId> match_joints(const Character& a, const Character& b) {
  std::vector<JointId> image(a.skeleton.size());
  std::vector<bool> is_taken(b.skeleton.size(), false);
  for (std::size_t j = 0; j < a.skeleton.size(); ++j)
    if (const auto found = b.skeleton.find(a.skeleton.joints[j].name)) {
      image[j] = *found;
      is_taken[found->index()] = true;
    }
  // Names are gone in files of some optimisers: then place and parent tell.
  const std::vector<Vec3> at_a = bind_positions(a.skeleton), at_b = bind_positions(b.skeleton);
  const double reach = kSameVertex * a.mesh.diagonal();
  for (std::size_t j = 0; j < a.skeleton.size(); ++j) {
    if (image[j].is_valid()) continue;
    const JointId parent = a.skeleton.joints[j].parent;
    const JointId wanted = parent.is_valid() ? image[parent.index()] : JointId();
    double nearest = reach;
    for (std::size_t k = 0; k < b.skeleton.size(); ++k) {
      if (is_taken[k] || b.skeleton.joints[k].parent != wanted) continue;
      if (const double distance = (at_a[j] - at_b[k]).norm(); distance < nearest) {
        nearest = distance;
        image[j] = JointId(k);
      }
    }
    if (image[j].is_valid()) is_taken[image[j].index()] = true;
  }
  return image;
}

// Points sorted by cells as wide as the reach: all within it lie in the 27 cells around.
class CellIndex {
 public:
  CellIndex(const std::vector<Vec3>& points, double reach) : points_(points), width_(reach) {
    for (std::size_t i = 0; i < points.size(); ++i) entries_.push_back({cell(points[i]), i});
    std::sort(entries_.begin(), entries_.end());
  }

  template <class Visit>
  void near(const Vec3& point, const Visit& visit) const {
    const auto [x, y, z] = cell(point);
    for (std::int64_t dx = -1; dx <= 1; ++dx)
      for (std::int64_t dy = -1; dy <= 1; ++dy) {  // three cells in z are one run
        const Cell first{x + dx, y + dy, z - 1}, last{x + dx, y + dy, z + 1};
        for (auto at = std::lower_bound(entries_.begin(), entries_.end(), Entry{first, 0});
             at != entries_.end() && at->first <= last; ++at)
          if ((points_[at->second] - point).norm() <= width_) visit(at->second);
      }
  }

 private:
  using Cell = std::tuple<std::int64_t, std::int64_t, std::int64_t>;
  using Entry = std::pair<Cell, std::size_t>;
  Cell cell(const Vec3& p) const {
    const auto at = [&](double x) { return static_cast<std::int64_t>(std::floor(x / width_)); };
    return {at(p.x()), at(p.y()), at(p.z())};
  }
  const std::vector<Vec3>& points_;
  double width_;
  std::vector<Entry> entries_;
};

std::vector<VertexId> match_vertices(const Character& a, const Character& b,
                                     std::span<const JointId> joints) {
  std::vector<VertexId> image(a.mesh.vertex_count());
  const double diagonal = std::max(a.mesh.diagonal(), b.mesh.diagonal());
  if (diagonal <= 0) return image;
  const CellIndex index(b.mesh.positions, kSameVertex * diagonal);
  constexpr double kSamePlace = 0.1;  // ours: of the reach; within it the weights decide
  for (std::size_t v = 0; v < image.size(); ++v) {
    double best = 1e300;
    index.near(a.mesh.positions[v], [&](std::size_t w) {
      const double distance = (a.mesh.positions[v] - b.mesh.positions[w]).norm() / (kSameVertex * diagonal);
      const double weights = weight_distance(a.weights.of(VertexId(v)), b.weights.of(VertexId(w)), joints);
      const double score = (distance < kSamePlace ? 0 : distance) + kSamePlace * weights + 1e-6 * distance;
      if (score < best) {
        best = score;
        image[v] = VertexId(w);
      }
    });
  }
  return image;
}

std::vector<JointId> inverse(std::span<const JointId> b_of_a, std::size_t joints_of_b) {
  std::vector<JointId> a_of_b(joints_of_b);
  for (std::size_t j = 0; j < b_of_a.size(); ++j)
    if (b_of_a[j].is_valid()) a_of_b[b_of_a[j].index()] = JointId(j);
  return a_of_b;
}
}  // namespace

double weight_distance(std::span<const Influence> a, std::span<const Influence> b,
                       std::span<const JointId> b_of_a) {
  double sum = 0, shared = 0;
  for (const Influence& of_a : a) {
    const JointId image = b_of_a[of_a.joint.index()];
    const auto found = std::find_if(b.begin(), b.end(), [&](const Influence& i) { return i.joint == image; });
    const bool is_shared = image.is_valid() && found != b.end();
    sum += is_shared ? std::abs(of_a.weight - found->weight) : of_a.weight;
    if (is_shared) shared += found->weight;
  }
  double all = 0;
  for (const Influence& of_b : b) all += of_b.weight;
  return sum + std::max(0.0, all - shared);
}

std::vector<JointId> Correspondence::joints_only_in(const Character& b) const {
  std::vector<bool> is_met(b.skeleton.size(), false);
  for (const JointId joint : joints)
    if (joint.is_valid()) is_met[joint.index()] = true;
  std::vector<JointId> rest;
  for (std::size_t j = 0; j < is_met.size(); ++j)
    if (!is_met[j]) rest.push_back(JointId(j));
  return rest;
}

Correspondence correspond(const Character& a, const Character& b) {
  Correspondence found;
  found.joints = match_joints(a, b);
  found.vertices = match_vertices(a, b, found.joints);
  found.back = match_vertices(b, a, inverse(found.joints, b.skeleton.size()));
  return found;
}

}  // namespace skinforge
