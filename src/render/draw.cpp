#include "render/draw.h"

#include <algorithm>
#include <cmath>

#include "base/expect.h"
#include "base/parallel.h"
#include "render/color.h"
#include "render/finish.h"
#include "render/lighting.h"
#include "render/viewed_triangles.h"
#include "render/visibility.h"

namespace skinforge {
namespace {

// All numbers of this block are ours, chosen by eye.
const Vec3f kBackdropTop = rgb_color(0xEF, 0xF2, 0xF6).cast<float>();
const Vec3f kBackdropBottom = rgb_color(0xC6, 0xCE, 0xD9).cast<float>();
const Vec3f kWireColor = rgb_color(0x1B, 0x24, 0x33).cast<float>();
constexpr float kWireStrength = 0.78F;
constexpr double kWireHalfWidth = 0.55;  // pixels
constexpr double kShadowTexelsPerPixel = 0.8;
// Neighbouring points of 2 x 2 pixels share their view of the sky when this near (pixels) and this alike
// (cosine).
constexpr float kSharedPixels = 2.5F, kSharedCosine = 0.995F;

std::vector<Vec3f> to_float(std::span<const Vec3> values) {
  std::vector<Vec3f> result(values.size());
  std::transform(values.begin(), values.end(), result.begin(),
                 [](const Vec3& v) { return Vec3f(v.cast<float>()); });
  return result;
}

std::vector<Vec3f> corner_normals(const Subject& subject, const Posture& posture) {
  if (!posture.normals.empty()) return to_float(posture.normals);
  if (posture.positions.empty()) return to_float(subject.mesh().normals);
  return to_float(subject.normals_at(posture.positions));
}

std::vector<TriangleIndices> finite_triangles(const Subject& subject, std::span<const Vec3f> positions) {
  std::vector<TriangleIndices> result;
  for (const TriangleIndices& t : subject.triangles())
    if (std::all_of(t.begin(), t.end(), [&](std::int32_t v) { return positions[v].allFinite(); }))
      result.push_back(t);
  return result;
}

std::vector<bool> highlighted_faces(const Subject& subject, std::span<const FaceId> faces) {
  std::vector<bool> highlighted(faces.empty() ? 0 : subject.mesh().face_count());
  for (const FaceId face : faces) highlighted[face.index()] = true;
  return highlighted;
}

int shadow_texels(const DrawOptions& options) {
  const double wanted = kShadowTexelsPerPixel * std::max(options.width, options.height);
  return std::clamp(static_cast<int>(wanted) / 4 * 4, 128, 1024);
}

constexpr std::uint8_t kOpaque = 255;

void set_pixel(Raster& raster, int x, int y, const Vec3f& color, std::uint8_t alpha) {
  auto* pixel = raster.rgba.data() + 4 * (static_cast<std::size_t>(y) * raster.width + x);
  for (int k = 0; k < 3; ++k) pixel[k] = srgb_from_linear(color[k]);
  pixel[3] = alpha;
}

std::uint8_t coverage_code(const std::array<std::int32_t, kSamples>& owners) {
  const auto covered = kSamples - std::count(owners.begin(), owners.end(), VisibilityTile::kNone);
  return static_cast<std::uint8_t>(kOpaque * covered / kSamples);
}

/// Share of the sky found for 2 x 2 pixels, shared by the triangles that meet there.
struct SharedSky {
  bool is_known = false;
  Vec3f position, normal;
  float light = 1;
};

/// Samples of one pixel that belong to one triangle.
struct Fragment {
  std::int32_t viewed = VisibilityTile::kNone;
  int samples = 0;
  double x = 0, y = 0;  ///< their mean place in the picture
};

/// One picture in the making.
class Painter {
 public:
  Painter(const Subject& subject, const Posture& posture, const View& view, const DrawOptions& options)
      : subject_(subject),
        options_(options),
        projection_(view, options.width, options.height),
        eye_(view.eye.cast<float>()),
        positions_(to_float(posture.positions.empty() ? std::span<const Vec3>(subject.mesh().positions)
                                                      : posture.positions)),
        normals_(corner_normals(subject, posture)),
        highlighted_(highlighted_faces(subject, options.highlight)),
        viewed_(viewed_triangles(subject,
                                 posture.positions.empty() ? subject.mesh().positions : posture.positions,
                                 projection_, {options.back_face_color.has_value(), options.wireframe})),
        lighting_(positions_, finite_triangles(subject, positions_), view, shadow_texels(options),
                  options.floor),
        pixel_slope_(static_cast<float>(2 * std::tan(view.fov / 2) / options.height)) {}

  Raster paint() const;

 private:
  void paint_tile(int x0, int y0, std::span<const std::int32_t> triangles, Raster& raster) const;
  void paint_backdrop(int x0, int y0, Raster& raster) const;
  void draw(VisibilityTile& tile, std::int32_t viewed) const;
  Vec3f pixel_color(const std::array<std::int32_t, kSamples>& owners, int x, int y, SharedSky& shared) const;
  Vec3f fragment_color(const Fragment& fragment, SharedSky& shared) const;
  Vec3f backdrop(double x, double y) const;
  SubjectPoint point_at(const ViewedTriangle& viewed, double x, double y) const;
  Vec3f normal_at(const ViewedTriangle& viewed, const SubjectPoint& point, const Vec3f& to_eye) const;
  float wire_at(const ViewedTriangle& viewed, double x, double y) const;
  float sky_light(const SurfacePoint& point, SharedSky& shared) const;

  const Subject& subject_;
  const DrawOptions& options_;
  Projection projection_;
  Vec3f eye_;
  std::vector<Vec3f> positions_, normals_;
  std::vector<bool> highlighted_;
  std::vector<ViewedTriangle> viewed_;
  Lighting lighting_;
  float pixel_slope_;  ///< height of a pixel at 1 m, metres
};

Raster Painter::paint() const {
  constexpr int kEdge = VisibilityTile::kEdge;
  Raster raster{options_.width, options_.height, {}};
  raster.rgba.resize(4 * static_cast<std::size_t>(raster.width) * raster.height);
  const int across = (raster.width + kEdge - 1) / kEdge, down = (raster.height + kEdge - 1) / kEdge;
  const auto tiles = triangles_by_tile(viewed_, across, down);
  parallel_for(tiles.size(), [&](std::size_t i) {
    const int x = static_cast<int>(i) % across, y = static_cast<int>(i) / across;
    if (tiles[i].empty())
      paint_backdrop(x * kEdge, y * kEdge, raster);
    else
      paint_tile(x * kEdge, y * kEdge, tiles[i], raster);
  });
  return raster;
}

void Painter::paint_tile(int x0, int y0, std::span<const std::int32_t> triangles, Raster& raster) const {
  VisibilityTile tile(x0, y0, projection_.near);
  for (const std::int32_t viewed : triangles) draw(tile, viewed);
  std::array<SharedSky, VisibilityTile::kEdge / 2> shared;
  for (int y = y0; y < std::min(y0 + VisibilityTile::kEdge, raster.height); ++y) {
    if (y % 2 == 0) shared.fill({});
    for (int x = x0; x < std::min(x0 + VisibilityTile::kEdge, raster.width); ++x) {
      const auto& owners = tile.owners(x, y);
      set_pixel(raster, x, y, pixel_color(owners, x, y, shared[static_cast<std::size_t>((x - x0) / 2)]),
                options_.alpha_is_coverage ? coverage_code(owners) : kOpaque);
    }
  }
}

void Painter::paint_backdrop(int x0, int y0, Raster& raster) const {
  for (int y = y0; y < std::min(y0 + VisibilityTile::kEdge, raster.height); ++y)
    for (int x = x0; x < std::min(x0 + VisibilityTile::kEdge, raster.width); ++x)
      set_pixel(raster, x, y, backdrop(x + 0.5, y + 0.5), options_.alpha_is_coverage ? 0 : kOpaque);
}

void Painter::draw(VisibilityTile& tile, std::int32_t index) const {
  const ViewedTriangle& viewed = viewed_[index];
  const FaceId face = subject_.face_of(static_cast<std::size_t>(viewed.triangle));
  if (!options_.vertex_colors.empty() || subject_.material_of(face).alpha_mode == AlphaMode::Opaque)
    return tile.draw(viewed.screen, index);
  tile.draw(viewed.screen, index, [&](double x, double y, int sample) {
    return exists_at(subject_, point_at(viewed, x, y), sample);
  });
}

Vec3f Painter::pixel_color(const std::array<std::int32_t, kSamples>& owners, int x, int y,
                           SharedSky& shared) const {
  const double cx = x + 0.5, cy = y + 0.5;
  if (std::all_of(owners.begin(), owners.end(), [&](std::int32_t o) { return o == owners[0]; }))
    return fragment_color({owners[0], kSamples, cx, cy}, shared);
  Vec3f sum = Vec3f::Zero();
  std::array<bool, kSamples> done{};
  for (std::size_t first = 0; first < kSamples; ++first) {
    if (done[first]) continue;
    Fragment fragment{owners[first], 0, 0, 0};
    for (std::size_t s = first; s < kSamples; ++s) {
      if (owners[s] != owners[first]) continue;
      done[s] = true;
      const auto [dx, dy] = sample_offset(static_cast<int>(s));
      ++fragment.samples;
      fragment.x += dx;
      fragment.y += dy;
    }
    fragment.x = cx + fragment.x / fragment.samples;
    fragment.y = cy + fragment.y / fragment.samples;
    sum += static_cast<float>(fragment.samples) * fragment_color(fragment, shared);
  }
  return sum / kSamples;
}

Vec3f Painter::fragment_color(const Fragment& fragment, SharedSky& shared) const {
  if (fragment.viewed == VisibilityTile::kNone) return backdrop(fragment.x, fragment.y);
  const ViewedTriangle& viewed = viewed_[fragment.viewed];
  const SubjectPoint at = point_at(viewed, fragment.x, fragment.y);
  const FaceId face = subject_.face_of(at.triangle);
  SurfacePoint point;
  point.position = at.weights.mix<Vec3f>(positions_, subject_.triangles()[at.triangle]);
  point.to_eye = (eye_ - point.position).normalized();
  point.normal = normal_at(viewed, at, point.to_eye);

  Finish finish = finish_at(subject_, options_, at, !highlighted_.empty() && highlighted_[face.index()]);
  if (!viewed.screen.is_front && !subject_.material_of(face).double_sided)
    finish = {.albedo = options_.back_face_color->cast<float>()};
  const Vec3f color = finish.is_unlit ? Vec3f(finish.albedo + finish.emissive)
                                      : lighting_.shade(point, finish, sky_light(point, shared));
  const float wire = options_.wireframe ? wire_at(viewed, fragment.x, fragment.y) : 0;
  return color + wire * (kWireColor - color);
}

SubjectPoint Painter::point_at(const ViewedTriangle& viewed, double x, double y) const {
  const Eigen::Vector3f w = viewed.screen.barycentric(x, y).cast<float>();
  return {static_cast<std::size_t>(viewed.triangle), {w[0], w[1], w[2]}, viewed.spread};
}

// The given normal, turned to the side that is seen; the triangle's own where there is none.
Vec3f Painter::normal_at(const ViewedTriangle& viewed, const SubjectPoint& point, const Vec3f& to_eye) const {
  const Vec3f normal = point.weights.mix<Vec3f>(normals_, subject_.triangle_corners()[point.triangle]);
  const float length = normal.norm();
  if (length > 0.1F)
    return (viewed.screen.is_front ? 1 : -1) / length * normal;  // opposite normals cancel: no answer
  const auto& [a, b, c] = subject_.triangles()[point.triangle];
  const Vec3f flat = (positions_[b] - positions_[a]).cross(positions_[c] - positions_[a]).normalized();
  return flat.dot(to_eye) < 0 ? Vec3f(-flat) : flat;
}

// Strength of the nearest line at a point of the picture, a pixel-wide box filter over its edge.
float Painter::wire_at(const ViewedTriangle& viewed, double x, double y) const {
  float strongest = 0;
  for (int i = 0; i < 3; ++i) {
    const float strength = viewed.wire[static_cast<std::size_t>(i)];
    if (strength <= 0) continue;
    const double cover = std::clamp(kWireHalfWidth + 0.5 - viewed.screen.edge_distance(i, x, y), 0.0, 1.0);
    strongest = std::max(strongest, strength * static_cast<float>(cover));
  }
  return kWireStrength * strongest;
}

float Painter::sky_light(const SurfacePoint& point, SharedSky& shared) const {
  const float pixel = pixel_slope_ * (eye_ - point.position).norm();
  const bool can_share = shared.is_known &&
                         (point.position - shared.position).norm() < kSharedPixels * pixel &&
                         point.normal.dot(shared.normal) > kSharedCosine;
  if (!can_share)
    shared = {true, point.position, point.normal, lighting_.sky_light(point.position, point.normal)};
  return shared.light;
}

Vec3f Painter::backdrop(double x, double y) const {
  const auto down = static_cast<float>(y / options_.height);
  const Vec3f color = kBackdropTop + down * (kBackdropBottom - kBackdropTop);
  if (!options_.floor) return color;
  return lighting_.floor_light(eye_, projection_.ray(x, y).cast<float>()) * color;
}

}  // namespace

Raster draw(const Subject& subject, const Posture& posture, const View& view, const DrawOptions& options) {
  SF_EXPECT(options.width > 0 && options.height > 0);
  SF_EXPECT(posture.positions.empty() || posture.positions.size() == subject.mesh().vertex_count());
  SF_EXPECT(posture.normals.empty() || posture.normals.size() == subject.mesh().corner_count());
  SF_EXPECT(options.vertex_colors.empty() || options.vertex_colors.size() == subject.mesh().vertex_count());
  return Painter(subject, posture, view, options).paint();
}

double visible_area(const Subject& subject, const Posture& posture, std::span<const FaceId> faces,
                    const View& view, int pixels) {
  if (faces.empty()) return 0;
  const Projection projection(view, pixels, pixels);
  const auto positions =
      posture.positions.empty() ? std::span<const Vec3>(subject.mesh().positions) : posture.positions;
  const auto viewed = viewed_triangles(subject, positions, projection, {.back_faces = true});
  const std::vector<bool> wanted = highlighted_faces(subject, faces);
  constexpr int kEdge = VisibilityTile::kEdge;
  const int across = (pixels + kEdge - 1) / kEdge;
  const auto tiles = triangles_by_tile(viewed, across, across);
  std::int64_t seen = 0;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const int x0 = static_cast<int>(i) % across * kEdge, y0 = static_cast<int>(i) / across * kEdge;
    VisibilityTile tile(x0, y0, projection.near);
    for (const std::int32_t t : tiles[i]) tile.draw(viewed[t].screen, t);
    const auto counts = [&](std::int32_t owner) {
      return owner != VisibilityTile::kNone && viewed[owner].screen.is_front &&
             wanted[subject.face_of(static_cast<std::size_t>(viewed[owner].triangle)).index()];
    };
    for (int y = y0; y < std::min(y0 + kEdge, pixels); ++y)
      for (int x = x0; x < std::min(x0 + kEdge, pixels); ++x)
        seen += std::count_if(tile.owners(x, y).begin(), tile.owners(x, y).end(), counts);
  }
  return static_cast<double>(seen) / (static_cast<double>(pixels) * pixels * kSamples);
}

}  // namespace skinforge
