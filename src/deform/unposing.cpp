#include "deform/unposing.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>

#include "base/expect.h"
#include "base/parallel.h"
#include "skinning/linear_blend.h"

namespace skinforge {
namespace {

constexpr std::size_t kChunk = 2048;
constexpr double kSingular = 1e3;  // ours: course data stay below 4, an elbow bent by 170 degrees below 150

Vec3 damped_solution(const Eigen::JacobiSVD<Mat3>& svd, const Vec3& right) {
  Vec3 inverse;
  for (int i = 0; i < 3; ++i) {
    const double s = svd.singularValues()[i];
    const double floor = std::max(svd.singularValues()[0], 1e-12) / kSingular;
    inverse[i] = s / (s * s + floor * floor);
  }
  return svd.matrixV() * (inverse.asDiagonal() * (svd.matrixU().transpose() * right));
}

}  // namespace

Unposed unpose(std::span<const Vec3> rest, std::span<const Vec3> posed, const SkinWeights& weights,
               std::span<const Affine3> palette) {
  SF_EXPECT(rest.size() == posed.size() && rest.size() == weights.vertex_count());
  Unposed result;
  result.offsets.resize(rest.size());
  std::vector<double> condition(rest.size(), 1);
  parallel_chunks(rest.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const auto row = weights.of(VertexId(v));
      const Affine3 map = blended_map(row, palette);
      const Vec3 residual = posed[v] - map * rest[v];  // solved for the offset itself: no cancellation
      if (row.size() <= 1) {
        result.offsets[v] = map.linear().inverse() * residual;
        continue;
      }
      const Mat3 inverse = map.linear().inverse();
      condition[v] = map.linear().norm() * inverse.norm() / 3;  // Frobenius: 1 for a rotation
      result.offsets[v] = inverse * residual;
      if (condition[v] < kSingular / 3 && result.offsets[v].allFinite()) continue;
      const Eigen::JacobiSVD<Mat3> svd(map.linear(), Eigen::ComputeFullU | Eigen::ComputeFullV);
      condition[v] = svd.singularValues()[0] / std::max(svd.singularValues()[2], 1e-300);
      if (condition[v] > kSingular) result.offsets[v] = damped_solution(svd, residual);
    }
  });
  for (std::size_t v = 0; v < rest.size(); ++v) {
    result.worst_condition = std::max(result.worst_condition, condition[v]);
    if (condition[v] > kSingular) result.damped.emplace_back(v);
  }
  return result;
}

}  // namespace skinforge
