#include "geometry/uv_measures.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

namespace skinforge {

namespace {
constexpr double kFlat = 1e-8;     // ours: of a texture; a sixth of a texel where it has 4096 x 4096
constexpr int kSize = 256;         // ours: pixels; 0.0015 % of the texture each
constexpr double kMostTiles = 16;  // ours: so that a broken file costs no more time
constexpr double kFarthest = 1e6;  // ours: where 32-bit floats know no pixel any more

struct UvTriangle {
  std::array<Vec3, 3> at;
  std::array<Vec2, 3> uv;

  double area() const { return (at[1] - at[0]).cross(at[2] - at[0]).norm() / 2; }
  double uv_area() const {
    const Vec2 u = uv[1] - uv[0], v = uv[2] - uv[0];
    return (u.x() * v.y() - u.y() * v.x()) / 2;
  }
  // Square of L2: half the sum of the squared lengths of the derivatives by u and v.
  double squared_stretch() const {
    const auto slope = [&](int axis) -> Vec3 {
      const auto other = [&](int i) { return uv[i][1 - axis]; };
      return (at[0] * (other(1) - other(2)) + at[1] * (other(2) - other(0)) + at[2] * (other(0) - other(1))) /
             (2 * uv_area());
    };
    return (slope(0).squaredNorm() + slope(1).squaredNorm()) / 2;
  }
};

// By material: textures of two materials are not one.
std::map<std::int32_t, std::vector<UvTriangle>> triangles_of(const PolygonMesh& mesh) {
  std::map<std::int32_t, std::vector<UvTriangle>> triangles;
  if (mesh.uvs.empty()) return triangles;
  const Triangulation triangulation = triangulate(mesh);
  for (std::size_t t = 0; t < triangulation.triangles.size(); ++t) {
    const FaceId face = triangulation.face[t];
    if (mesh.parts[mesh.face_part[face.index()].index()].uv_sets == 0) continue;
    UvTriangle& triangle = triangles[mesh.face_material[face.index()].value].emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      triangle.at[i] = mesh.positions[triangulation.triangles[t][i].index()];
      triangle.uv[i] = mesh.uvs[0][static_cast<std::size_t>(triangulation.corners[t][i])];
    }
  }
  return triangles;
}

struct Stretch {
  double area = 0, uv_area = 0;
  double sum = 0, most = 0;  // of squares, by area; of them
};

void add(const UvTriangle& triangle, Stretch& stretch, UvMeasures& measures) {
  const double area = triangle.area(), uv_area = std::abs(triangle.uv_area());
  if (!(area > 0)) return;
  if (!(uv_area > kFlat)) {
    ++measures.flat;
    return;
  }
  ++measures.triangles;
  const double square = triangle.squared_stretch();
  stretch.area += area;
  stretch.uv_area += uv_area;
  stretch.sum += square * area;
  stretch.most = std::max(stretch.most, square);
}

// How often the centre of each pixel of a repeated texture is covered. A row holds where spans begin and end.
class Coverage {
 public:
  Coverage() : steps_(kSize * kRow, 0) {}

  // In pixels, centres at whole numbers. Of a border between two triangles a centre belongs to one of them:
  // both find the same crossing, because it is reckoned from the end with lower v.
  void add(std::array<Vec2, 3> corners) {
    std::sort(corners.begin(), corners.end(),
              [](const Vec2& a, const Vec2& b) { return std::pair(a.y(), a.x()) < std::pair(b.y(), b.x()); });
    for (auto y = std::int64_t(std::ceil(corners[0].y())); double(y) < corners[2].y(); ++y) {
      const double on_long = crossing(corners[0], corners[2], double(y));
      const double on_short = double(y) < corners[1].y() ? crossing(corners[0], corners[1], double(y))
                                                         : crossing(corners[1], corners[2], double(y));
      add_span(y, std::int64_t(std::ceil(std::min(on_long, on_short))),
               std::int64_t(std::ceil(std::max(on_long, on_short))));
    }
  }

  void count(std::size_t& covered, std::size_t& several) const {
    for (int y = 0; y < kSize; ++y) {
      int depth = 0;
      for (int x = 0; x < kSize; ++x) {
        depth += steps_[static_cast<std::size_t>(y * kRow + x)];
        covered += depth > 0;
        several += depth > 1;
      }
    }
  }

 private:
  static constexpr int kRow = kSize + 1;

  static double crossing(const Vec2& low, const Vec2& high, double y) {
    return low.x() + (y - low.y()) / (high.y() - low.y()) * (high.x() - low.x());
  }
  static std::int64_t wrapped(std::int64_t i) { return ((i % kSize) + kSize) % kSize; }

  void add_span(std::int64_t y, std::int64_t begin, std::int64_t end) {
    int* row = steps_.data() + wrapped(y) * kRow;
    const std::int64_t length = end - begin, turns = length / kSize;
    row[0] += static_cast<int>(turns);
    const std::int64_t first = wrapped(begin), last = first + length % kSize;
    ++row[first];
    if (last > kSize) {
      ++row[0];
      --row[last - kSize];
    } else {
      --row[last];
    }
  }

  std::vector<int> steps_;
};

bool can_be_drawn(const std::array<Vec2, 3>& uv) {
  Eigen::AlignedBox2d box;
  for (const Vec2& point : uv) {
    if (!(point.cwiseAbs().maxCoeff() <= kFarthest)) return false;
    box.extend(point);
  }
  return box.sizes().maxCoeff() <= kMostTiles;
}

void count_overlap(const std::vector<UvTriangle>& triangles, std::size_t& covered, std::size_t& several) {
  Coverage coverage;
  for (const UvTriangle& triangle : triangles) {
    if (!can_be_drawn(triangle.uv)) continue;
    std::array<Vec2, 3> pixels = triangle.uv;
    for (Vec2& p : pixels) p = p * kSize - Vec2(0.5, 0.5);
    coverage.add(pixels);
  }
  coverage.count(covered, several);
}
}  // namespace

UvMeasures measure_uvs(const PolygonMesh& mesh) {
  UvMeasures measures;
  Stretch stretch;
  std::size_t covered = 0, several = 0;
  for (const auto& [material, triangles] : triangles_of(mesh)) {
    for (const UvTriangle& triangle : triangles) add(triangle, stretch, measures);
    count_overlap(triangles, covered, several);
  }
  if (stretch.area > 0) {
    const double scale = stretch.uv_area / stretch.area;
    measures.stretch = std::sqrt(stretch.sum / stretch.area * scale);
    measures.stretch_max = std::sqrt(stretch.most * scale);
  }
  measures.overlap = covered > 0 ? double(several) / double(covered) : 0;
  return measures;
}

}  // namespace skinforge
