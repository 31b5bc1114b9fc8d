#include "render/visibility.h"

#include <algorithm>
#include <cmath>

#include "render/four.h"

namespace skinforge {
namespace {

using Row = std::array<float, kSamples>;

constexpr auto kOffsets = [] {
  std::array<Row, 2> offsets{};
  for (int s = 0; s < kSamples; ++s)
    for (std::size_t axis = 0; axis < 2; ++axis)
      offsets[axis][static_cast<std::size_t>(s)] = sample_offset(s)[axis];
  return offsets;
}();

// Offsets of the linear function (a, b, c) at the samples, from its value at the pixel's centre.
Row sample_rises(const Vec3& f) {
  Row rises{};
  const auto a = static_cast<float>(f.x()), b = static_cast<float>(f.y());
  for (std::size_t s = 0; s < kSamples; ++s) rises[s] = a * kOffsets[0][s] + b * kOffsets[1][s];
  return rises;
}

// Where two triangles share an edge they hold exactly opposite functions, so each sample is inside one of
// them.
struct EdgeTest {
  explicit EdgeTest(const Vec3& f) : function(f), rise(sample_rises(f)) {
    reach = -0.5 * (std::abs(f.x()) + std::abs(f.y()));
  }
  double at(double x, double y) const { return function.x() * x + (function.y() * y + function.z()); }

  Vec3 function;
  Row rise;
  double reach;  ///< below it at the centre, the whole pixel is outside
};

std::optional<std::array<int, 4>> pixel_box(const std::array<Vec3, 3>& corners,
                                            const Projection& projection) {
  const bool crosses = corners[0].z() < projection.near || corners[1].z() < projection.near ||
                       corners[2].z() < projection.near;
  std::array<int, 4> box{0, 0, projection.width - 1, projection.height - 1};
  if (crosses) {
    if (std::max({corners[0].z(), corners[1].z(), corners[2].z()}) < projection.near) return std::nullopt;
    return box;
  }
  Eigen::AlignedBox2d bounds;
  for (const Vec3& c : corners) bounds.extend(Vec2(c.x() / c.z(), c.y() / c.z()));
  const Vec2 low = bounds.min().cwiseMax(Vec2(0, 0));
  const Vec2 high = bounds.max().cwiseMin(Vec2(projection.width - 0.5, projection.height - 0.5));
  if (!(low.x() <= high.x() && low.y() <= high.y())) return std::nullopt;
  return std::array<int, 4>{static_cast<int>(low.x()), static_cast<int>(low.y()), static_cast<int>(high.x()),
                            static_cast<int>(high.y())};
}

}  // namespace

Projection::Projection(const View& view, int width_, int height_)
    : eye(view.eye), width(width_), height(height_), near(view.near) {
  const double pixels = height / 2.0 / std::tan(view.fov / 2);
  Mat3 pixel_from_view;  // view: x right, y up, z back
  pixel_from_view << pixels, 0, -width / 2.0, 0, -pixels, -height / 2.0, 0, 0, -1;
  pixel_from_model = pixel_from_view * view.axes().transpose();
  model_from_pixel = pixel_from_model.inverse();
}

Vec3 ScreenTriangle::barycentric(double x, double y) const {
  const Vec3 at(x, y, 1);
  const Vec3 weights(edge[0].dot(at), edge[1].dot(at), edge[2].dot(at));
  const double sum = weights.sum();
  return sum > 0 ? Vec3(weights / sum) : Vec3(1, 0, 0);
}

double ScreenTriangle::edge_distance(int corner, double x, double y) const {
  const Vec3& f = edge[static_cast<std::size_t>(corner)];
  return f.dot(Vec3(x, y, 1)) / std::hypot(f.x(), f.y());
}

std::optional<ScreenTriangle> screen_triangle(const std::array<Vec3, 3>& corners,
                                              const Projection& projection) {
  const double det = corners[0].dot(corners[1].cross(corners[2]));
  if (!(std::abs(det) > 0) || !std::isfinite(det)) return std::nullopt;
  const auto box = pixel_box(corners, projection);
  if (!box) return std::nullopt;
  ScreenTriangle triangle;
  triangle.is_front = det < 0;  // y points down, so counter-clockwise comes out negative
  triangle.box = *box;
  const double sign = det > 0 ? 1 : -1;
  for (std::size_t i = 0; i < 3; ++i)
    triangle.edge[i] = sign * corners[(i + 1) % 3].cross(corners[(i + 2) % 3]);
  triangle.inverse_w = (triangle.edge[0] + triangle.edge[1] + triangle.edge[2]) / std::abs(det);
  return triangle;
}

VisibilityTile::VisibilityTile(int x0, int y0, double near)
    : x0_(x0), y0_(y0), nearest_(static_cast<float>(1 / near)), depth_(kEdge * kEdge), owner_(kEdge * kEdge) {
  for (auto& owners : owner_) owners.fill(kNone);
}

void VisibilityTile::draw(const ScreenTriangle& triangle, std::int32_t owner, const Cutout& cutout) {
  const EdgeTest e0(triangle.edge[0]), e1(triangle.edge[1]), e2(triangle.edge[2]), w(triangle.inverse_w);
  const int x0 = std::max(triangle.box[0], x0_), x1 = std::min(triangle.box[2], x0_ + kEdge - 1);
  const int y0 = std::max(triangle.box[1], y0_), y1 = std::min(triangle.box[3], y0_ + kEdge - 1);
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const double cx = x + 0.5, cy = y + 0.5;
      const double a = e0.at(cx, cy), b = e1.at(cx, cy), c = e2.at(cx, cy);
      if (a < e0.reach || b < e1.reach || c < e2.reach) continue;
      const auto fa = static_cast<float>(a), fb = static_cast<float>(b), fc = static_cast<float>(c);
      const auto fw = static_cast<float>(w.at(cx, cy));
      auto& depth = depth_[pixel(x, y)];
      auto& owners = owner_[pixel(x, y)];
      std::array<std::int32_t, kSamples> covered;
      for (std::size_t s = 0; s < kSamples; s += 4) {
        const FourFloats height = fw + load_four(&w.rise[s]);
        const FourInts inside = (fa + load_four(&e0.rise[s]) >= 0) & (fb + load_four(&e1.rise[s]) >= 0) &
                                (fc + load_four(&e2.rise[s]) >= 0);
        store_four(inside & (height > load_four(&depth[s])) & (height <= nearest_), &covered[s]);
      }
      if (cutout) cut(cutout, x, y, covered);
      for (std::size_t s = 0; s < kSamples; s += 4) {
        const FourInts is_covered = load_four(&covered[s]), old = load_four(&owners[s]);
        const FourFloats height = fw + load_four(&w.rise[s]);
        store_four(is_covered ? height : load_four(&depth[s]), &depth[s]);
        store_four((old & ~is_covered) | (owner & is_covered), &owners[s]);
      }
    }
}

void VisibilityTile::cut(const Cutout& cutout, int x, int y,
                         std::array<std::int32_t, kSamples>& covered) const {
  for (int s = 0; s < kSamples; ++s) {
    if (!covered[static_cast<std::size_t>(s)]) continue;
    const auto [dx, dy] = sample_offset(s);
    covered[static_cast<std::size_t>(s)] = cutout(x + 0.5 + dx, y + 0.5 + dy, s) ? -1 : 0;
  }
}

}  // namespace skinforge
