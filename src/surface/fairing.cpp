#include "surface/fairing.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <set>

namespace skinforge {

std::vector<Support> supports_of(const std::vector<JunctionLoop>& loops) {
  std::vector<Support> supports;
  std::int32_t fixed = 0;
  for (const JunctionLoop& loop : loops) {
    for (const auto& inward : loop.inward) {
      for (const Vec3& p : inward) supports.push_back({fixed, p});
      ++fixed;
    }
  }
  return supports;
}

TrianglePatch fair(const TrianglePatch& patch, const std::vector<Support>& supports) {
  const std::size_t count = patch.positions.size(), free_count = count - patch.fixed;
  if (free_count == 0) return patch;
  std::vector<std::set<std::int32_t>> neighbours(count);
  for (const Triangle& t : patch.triangles)
    for (int k = 0; k < 3; ++k) neighbours[t[k]].insert({t[(k + 1) % 3], t[(k + 2) % 3]});
  std::vector<Vec3> support_sum(count, Vec3::Zero());
  std::vector<double> support_count(count, 0);
  for (const Support& s : supports) support_sum[s.fixed] += s.position, support_count[s.fixed] += 1;

  // One row per vertex: mean of the neighbours minus the vertex; fixed vertices without supports have no
  // sensible row.
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(static_cast<Eigen::Index>(count), 3);
  for (std::size_t v = 0; v < count; ++v) {
    const double degree = static_cast<double>(neighbours[v].size()) + support_count[v];
    if (degree == 0 || (v < patch.fixed && support_count[v] == 0)) continue;
    const auto row = static_cast<Eigen::Index>(v);
    const auto add = [&](std::size_t u, double factor) {
      if (u < patch.fixed)
        right.row(row) -= factor * patch.positions[u].transpose();
      else
        entries.emplace_back(row, static_cast<Eigen::Index>(u - patch.fixed), factor);
    };
    add(v, -1);
    for (const std::int32_t n : neighbours[v]) add(n, 1 / degree);
    right.row(row) -= support_sum[v].transpose() / degree;
  }
  Eigen::SparseMatrix<double> laplacian(static_cast<Eigen::Index>(count),
                                        static_cast<Eigen::Index>(free_count));
  laplacian.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseMatrix<double> normal = laplacian.transpose() * laplacian;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(normal);
  if (solver.info() != Eigen::Success) return patch;
  const Eigen::MatrixX3d places = solver.solve(laplacian.transpose() * right);
  if (!places.allFinite()) return patch;
  TrianglePatch faired = patch;
  for (std::size_t v = 0; v < free_count; ++v)
    faired.positions[patch.fixed + v] = places.row(static_cast<Eigen::Index>(v));
  return faired;
}

}  // namespace skinforge
