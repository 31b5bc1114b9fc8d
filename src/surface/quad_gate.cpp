#include "surface/quad_gate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace skinforge {
namespace {

constexpr double kMostDeviation = 2.5, kP95 = 1.0;  // junction.md c; voxels

// Of the inner vertices and the middles of the faces, in voxels.
std::vector<double> deviations(const QuadPatch& patch, const DistanceField& field) {
  std::vector<double> values;
  const auto add = [&](const Vec3& p) { values.push_back(std::abs(field.at(p)) / field.lattice.voxel); };
  for (std::size_t v = patch.fixed; v < patch.positions.size(); ++v) add(patch.positions[v]);
  for (const Quad& q : patch.quads)
    add(0.25 *
        (patch.positions[q[0]] + patch.positions[q[1]] + patch.positions[q[2]] + patch.positions[q[3]]));
  std::sort(values.begin(), values.end());
  return values;
}

std::size_t count_folds(const QuadPatch& patch, const DistanceField& field) {
  return static_cast<std::size_t>(std::count_if(patch.quads.begin(), patch.quads.end(), [&](const Quad& q) {
    const auto& p = patch.positions;
    const Vec3 normal = (p[q[2]] - p[q[0]]).cross(p[q[3]] - p[q[1]]);
    return normal.dot(field.gradient(0.25 * (p[q[0]] + p[q[1]] + p[q[2]] + p[q[3]]))) < 0;
  }));
}

}  // namespace

std::string fault_of(const QuadPatch& patch, const DistanceField& field) {
  const double jacobian = least_scaled_jacobian(patch);
  if (jacobian < kLeastJacobian) return fmt::format("least scaled Jacobian {:.2f}", jacobian);
  if (const std::size_t folds = count_folds(patch, field); folds > 0)
    return fmt::format("{} faces against the field", folds);
  const std::vector<double> values = deviations(patch, field);
  if (values.empty()) return {};
  const double p95 = values[static_cast<std::size_t>(0.95 * static_cast<double>(values.size() - 1))];
  if (p95 > kP95 || values.back() > kMostDeviation)
    return fmt::format("{:.1f} voxels off the field at 95 %, {:.1f} at most", p95, values.back());
  return {};
}

}  // namespace skinforge
