#include "skinning/linear_blend.h"

#include <algorithm>

#include "base/expect.h"
#include "base/parallel.h"

namespace skinforge {
namespace {

constexpr std::size_t kChunk = 2048;  // ours: vertices a task; about 50 microseconds of work

using Matrix34 = Eigen::Matrix<double, 3, 4>;

// Sum of w_j * palette_j; the identity for an empty row.
Matrix34 blended_matrix(std::span<const Influence> row, std::span<const Affine3> palette) {
  if (row.empty()) return Matrix34::Identity();
  Matrix34 sum = row[0].weight * palette[row[0].joint.index()].matrix();
  for (std::size_t i = 1; i < row.size(); ++i)
    sum.noalias() += row[i].weight * palette[row[i].joint.index()].matrix();
  return sum;
}

// Inverse transpose up to a positive factor: the cofactors with the sign of the determinant. No division, so
// a singular matrix is no special case.
Mat3 normal_matrix(const Matrix34& m) {
  const Vec3 a = m.col(0), b = m.col(1), c = m.col(2);
  Mat3 cofactors;
  cofactors << b.cross(c), c.cross(a), a.cross(b);
  return a.dot(cofactors.col(0)) < 0 ? Mat3(-cofactors) : cofactors;
}

Vec3 unit_or_zero(const Vec3& v) {
  const double length = v.norm();
  return length > 0 ? Vec3(v / length) : Vec3(Vec3::Zero());
}

}  // namespace

std::vector<Vec3> linear_blend(std::span<const Vec3> positions, const SkinWeights& weights,
                               std::span<const Affine3> palette) {
  SF_EXPECT(positions.size() == weights.vertex_count());
  std::vector<Vec3> posed(positions.size());
  parallel_chunks(positions.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const Matrix34 m = blended_matrix(weights.of(VertexId(v)), palette);
      posed[v] = m.leftCols<3>() * positions[v] + m.col(3);
    }
  });
  return posed;
}

Affine3 blended_map(std::span<const Influence> row, std::span<const Affine3> palette) {
  Affine3 map;
  map.matrix() = blended_matrix(row, palette);
  return map;
}

std::vector<Vec3> linear_blend_normals(std::span<const Vec3> normals, std::span<const VertexId> corners,
                                       const SkinWeights& weights, std::span<const Affine3> palette) {
  SF_EXPECT(normals.size() == corners.size());
  std::vector<Mat3> of_vertex(weights.vertex_count());
  parallel_chunks(of_vertex.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v)
      of_vertex[v] = normal_matrix(blended_matrix(weights.of(VertexId(v)), palette));
  });
  std::vector<Vec3> turned(normals.size());
  parallel_chunks(normals.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c)
      turned[c] = unit_or_zero(of_vertex[corners[c].index()] * normals[c]);
  });
  return turned;
}

}  // namespace skinforge
