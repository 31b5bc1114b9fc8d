#include "model/polygon_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

namespace skinforge {
namespace {

Vec3 newell_normal(std::span<const Vec3> positions) {
  Vec3 normal = Vec3::Zero();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec3 a = positions[i] - positions[0];  // relative: no cancellation far from the origin
    const Vec3 b = positions[(i + 1) % positions.size()] - positions[0];
    normal += a.cross(b);
  }
  return normal;
}

std::vector<std::array<int, 3>> split_quad(std::span<const Vec3> p, const Vec3& normal) {
  const auto folds = [&](int a, int b, int c) { return (p[b] - p[a]).cross(p[c] - p[a]).dot(normal) <= 0; };
  const bool first_folds = folds(0, 1, 2) || folds(0, 2, 3);
  const bool second_folds = folds(0, 1, 3) || folds(1, 2, 3);
  if (!first_folds || second_folds) return {{0, 1, 2}, {0, 2, 3}};
  return {{0, 1, 3}, {1, 2, 3}};
}

bool is_ear(std::span<const Vec3> p, const std::vector<int>& ring, std::size_t i, const Vec3& normal) {
  const std::size_t n = ring.size();
  const int a = ring[(i + n - 1) % n], b = ring[i], c = ring[(i + 1) % n];
  if ((p[b] - p[a]).cross(p[c] - p[b]).dot(normal) <= 0) return false;
  for (const int q : ring) {
    if (q == a || q == b || q == c) continue;
    const bool inside = (p[b] - p[a]).cross(p[q] - p[a]).dot(normal) >= 0 &&
                        (p[c] - p[b]).cross(p[q] - p[b]).dot(normal) >= 0 &&
                        (p[a] - p[c]).cross(p[q] - p[c]).dot(normal) >= 0;
    if (inside) return false;
  }
  return true;
}

std::vector<std::array<int, 3>> clip_ears(std::span<const Vec3> p, const Vec3& normal) {
  std::vector<int> ring(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) ring[i] = static_cast<int>(i);
  std::vector<std::array<int, 3>> triangles;
  while (ring.size() > 3) {
    std::size_t ear = 0;
    while (ear < ring.size() && !is_ear(p, ring, ear, normal)) ++ear;
    if (ear == ring.size())
      ear = 0;  // a degenerate polygon has no ear: cut any corner, the count stays right
    const std::size_t n = ring.size();
    triangles.push_back({ring[(ear + n - 1) % n], ring[ear], ring[(ear + 1) % n]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  triangles.push_back({ring[0], ring[1], ring[2]});
  return triangles;
}

std::vector<Vec3> face_positions(const PolygonMesh& mesh, FaceId face) {
  std::vector<Vec3> positions;
  for (const VertexId v : mesh.face(face)) positions.push_back(mesh.positions[v.index()]);
  return positions;
}

}  // namespace

const SplitNormals* PolygonMesh::split_of(FaceId f) const {
  const auto found = std::lower_bound(split.begin(), split.end(), f,
                                      [](const SplitNormals& s, FaceId wanted) { return s.face < wanted; });
  return found != split.end() && found->face == f ? &*found : nullptr;
}

double PolygonMesh::diagonal() const {
  if (positions.empty()) return 0;
  Eigen::AlignedBox3d box;
  for (const Vec3& p : positions) box.extend(p);
  return box.diagonal().norm();
}

Vec3 area_normal(const PolygonMesh& mesh, FaceId face) {
  return newell_normal(face_positions(mesh, face));
}

std::vector<std::array<int, 3>> triangulate(std::span<const Vec3> positions) {
  if (positions.size() == 3) return {{0, 1, 2}};
  const Vec3 normal = newell_normal(positions);
  return positions.size() == 4 ? split_quad(positions, normal) : clip_ears(positions, normal);
}

Triangulation triangulate(const PolygonMesh& mesh) {
  Triangulation result;
  std::vector<Vec3> positions;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto first = static_cast<std::int32_t>(mesh.first_corner(FaceId(f)));
    const auto add = [&](const std::array<int, 3>& t) {
      const std::array<std::int32_t, 3> corners{first + t[0], first + t[1], first + t[2]};
      result.corners.push_back(corners);
      result.triangles.push_back(
          {mesh.corners[corners[0]], mesh.corners[corners[1]], mesh.corners[corners[2]]});
      result.face.push_back(FaceId(f));
    };
    const auto face = mesh.face(FaceId(f));
    if (face.size() == 3) {
      add({0, 1, 2});
      continue;
    }
    positions.clear();
    for (const VertexId v : face) positions.push_back(mesh.positions[v.index()]);
    for (const auto& t : triangulate(std::span<const Vec3>(positions))) add(t);
  }
  return result;
}

}  // namespace skinforge
