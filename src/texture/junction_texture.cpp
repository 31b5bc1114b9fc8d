#include "texture/junction_texture.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/expect.h"
#include "base/parallel.h"
#include "texture/pack_charts.h"
#include "texture/texel_map.h"
#include "texture/unroll.h"

namespace skinforge {
namespace {

constexpr double kFlatEnds = 0.1;  // ours: shares below it are 0 for colours: two texels of a band of twenty
constexpr double kFacing = 0.2;  // junction.md (e): least cosine between the junction's and a source's normal
constexpr double kRayReach =
    2;  // ours: mean edges; how far a ray looks for a surface that faces the right way
constexpr double kLimitSlack = 1 + 1e-9;  // keeps rounding from cutting off the answer of a bounded query
constexpr double kOneColor = 0.5 / 255;   // spread of encoded colours that 8 bits cannot show

// A triangle of the junction.
struct JunctionTriangle {
  std::array<std::size_t, 3> slots;  // index into the corners of `faces`, face after face
  std::array<VertexId, 3> vertices;
  std::array<Vec3, 3> normals;
  double area = 0;
};

std::vector<JunctionTriangle> triangles_of(const JunctionSurface& junction) {
  const PolygonMesh& mesh = *junction.mesh;
  std::vector<JunctionTriangle> triangles;
  std::size_t slot = 0;
  for (const FaceId f : junction.faces) {
    std::vector<Vec3> positions;
    for (const VertexId v : mesh.face(f)) positions.push_back(mesh.positions[v.index()]);
    const Vec3 flat = area_normal(mesh, f).normalized();
    for (const auto& t : triangulate(std::span<const Vec3>(positions))) {
      JunctionTriangle triangle;
      for (int i = 0; i < 3; ++i) {
        triangle.slots[i] = slot + static_cast<std::size_t>(t[i]);
        triangle.vertices[i] = mesh.face(f)[t[i]];
        const Vec3& normal = mesh.normals[mesh.first_corner(f) + static_cast<std::size_t>(t[i])];
        triangle.normals[i] = normal.isZero(0) ? flat : normal;
      }
      triangle.area = (positions[t[1]] - positions[t[0]]).cross(positions[t[2]] - positions[t[0]]).norm() / 2;
      triangles.push_back(triangle);
    }
    slot += positions.size();
  }
  return triangles;
}

double mean_edge_of(const JunctionSurface& junction) {
  double sum = 0;
  std::size_t count = 0;
  for (const FaceId f : junction.faces) {
    const auto corners = junction.mesh->face(f);
    for (std::size_t c = 0; c < corners.size(); ++c, ++count)
      sum += (junction.mesh->positions[corners[c].index()] -
              junction.mesh->positions[corners[(c + 1) % corners.size()].index()])
                 .norm();
  }
  return count == 0 ? 0 : sum / static_cast<double>(count);
}

struct SurfacePoint {
  Vec3 position;
  Vec3 normal;
};

SurfacePoint point_of(const PolygonMesh& mesh, const JunctionTriangle& triangle, const Vec3& barycentric) {
  SurfacePoint point{Vec3::Zero(), Vec3::Zero()};
  for (int i = 0; i < 3; ++i) {
    point.position += barycentric[i] * mesh.positions[triangle.vertices[i].index()];
    point.normal += barycentric[i] * triangle.normals[i];
  }
  point.normal.normalize();
  return point;
}

// Finds, for a moving point, the point of one source that it corresponds to.
class SourceProbe {
 public:
  SourceProbe(const TextureSource& source, double mean_edge)
      : source_(source), reach_(kRayReach * mean_edge) {}

  ClosestPoint find(const SurfacePoint& at) {
    const ClosestPoint nearest = closest(at.position);
    if (nearest.triangle < 0 || faces(nearest.triangle, at.normal)) return nearest;
    const auto outwards = along_ray(at, at.normal), inwards = along_ray(at, -at.normal);
    if (!outwards && !inwards) return nearest;
    if (!inwards || (outwards && outwards->distance <= inwards->distance)) return *outwards;
    return *inwards;
  }

 private:
  // The last answer bounds the next: no point moves away faster than the query does.
  ClosestPoint closest(const Vec3& query) {
    ClosestPoint found;
    if (last_)
      found = source_.bvh->closest(query, (last_->distance + (query - last_query_).norm()) * kLimitSlack);
    if (found.triangle < 0) found = source_.bvh->closest(query);
    if (found.triangle >= 0) last_ = found;
    last_query_ = query;
    return found;
  }
  std::array<Vec3, 3> corners(std::int32_t triangle) const {
    const auto& t = source_.triangles->triangles[triangle];
    return {source_.positions[t[0].index()], source_.positions[t[1].index()],
            source_.positions[t[2].index()]};
  }
  bool faces(std::int32_t triangle, const Vec3& normal) const {
    const auto p = corners(triangle);
    const Vec3 n = (p[1] - p[0]).cross(p[2] - p[0]);
    return n.dot(normal) >= kFacing * n.norm();
  }
  std::optional<ClosestPoint> along_ray(const SurfacePoint& at, const Vec3& direction) const {
    const RayHit hit = source_.bvh->first_hit(at.position, direction, reach_);
    if (hit.triangle < 0 || !faces(hit.triangle, at.normal)) return std::nullopt;
    const auto p = corners(hit.triangle);
    const Vec3 point = at.position + hit.distance * direction, n = (p[1] - p[0]).cross(p[2] - p[0]);
    const double b1 = (point - p[0]).cross(p[2] - p[0]).dot(n) / n.squaredNorm();
    const double b2 = (p[1] - p[0]).cross(point - p[0]).dot(n) / n.squaredNorm();
    const Vec3 barycentric = Vec3(1 - b1 - b2, b1, b2).cwiseMax(0.0);
    return ClosestPoint{hit.triangle, barycentric / barycentric.sum(), point, hit.distance};
  }

  const TextureSource& source_;
  double reach_;
  std::optional<ClosestPoint> last_;
  Vec3 last_query_ = Vec3::Zero();
};

// Smoothstep with flat ends: 0 up to `kFlatEnds`, 1 from 1 - `kFlatEnds` on.
double color_share(double factor) {
  const double t = std::clamp((factor - kFlatEnds) / (1 - 2 * kFlatEnds), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// Shares of all sources at a point of the junction; they sum to 1.
std::vector<double> shares_at(std::span<const TextureSource> sources, const JunctionTriangle& triangle,
                              const Vec3& barycentric) {
  std::vector<double> linear, shares;
  for (const TextureSource& source : sources) {
    double factor = 0;
    for (int i = 0; i < 3; ++i) factor += barycentric[i] * source.factor[triangle.vertices[i].index()];
    linear.push_back(factor);
    shares.push_back(color_share(factor));
  }
  double sum = 0;
  for (const double s : shares) sum += s;
  if (!(sum > 0)) {  // many sources with small shares each
    shares = linear;
    for (const double s : shares) sum += s;
  }
  for (double& s : shares) s = sum > 0 ? s / sum : 1.0 / static_cast<double>(shares.size());
  return shares;
}

CornerMix corner_mix(const TextureSource& source, const ClosestPoint& at) {
  return {source.triangles->corners[at.triangle], at.barycentric};
}

// Texels per metre of a source's base colour texture on one face; none without texture or without area.
std::optional<double> texture_density(const TextureSource& source, std::int32_t triangle) {
  const ColoredMesh& colored = source.colored;
  const auto& texture = material_of(colored, source.triangles->face[triangle]).base_color_texture;
  if (!texture || !texture->image.is_valid() || texture->image.index() >= colored.images.size())
    return std::nullopt;
  if (static_cast<std::size_t>(texture->uv_set) >= colored.mesh->uvs.size()) return std::nullopt;
  const Raster& image = colored.images[texture->image.index()];
  const auto& uv = colored.mesh->uvs[static_cast<std::size_t>(texture->uv_set)];
  const auto& c = source.triangles->corners[triangle];
  const auto& t = source.triangles->triangles[triangle];
  const Vec2 texels = Vec2(image.width, image.height).cwiseProduct(texture->uv_scale);
  const Vec2 a = (uv[c[1]] - uv[c[0]]).cwiseProduct(texels), b = (uv[c[2]] - uv[c[0]]).cwiseProduct(texels);
  const Vec3 p = source.positions[t[0].index()];
  const double area = (source.positions[t[1].index()] - p).cross(source.positions[t[2].index()] - p).norm();
  if (!(area > 0)) return std::nullopt;
  return std::sqrt(std::abs(a.x() * b.y() - a.y() * b.x()) / area);
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// What the middles of the junction's triangles see: texture density and the material's other properties.
struct JunctionLook {
  double density = 0;
  Material material;
};

JunctionLook mean_look(const JunctionSurface& junction, std::span<const JunctionTriangle> triangles,
                       std::span<const TextureSource> sources, double mean_edge) {
  std::vector<double> densities;
  JunctionLook mean;
  SurfaceLook sum{Vec3::Zero(), Vec3::Zero(), 0, 0};
  double weight_sum = 0;
  bool all_unlit = true;
  std::vector<SourceProbe> probes;
  for (const TextureSource& source : sources) probes.emplace_back(source, mean_edge);
  const Vec3 middle = Vec3::Constant(1.0 / 3);
  for (const JunctionTriangle& triangle : triangles) {
    const SurfacePoint point = point_of(*junction.mesh, triangle, middle);
    const auto shares = shares_at(sources, triangle, middle);
    for (std::size_t k = 0; k < sources.size(); ++k) {
      if (!(shares[k] > 0)) continue;
      const ClosestPoint at = probes[k].find(point);
      if (at.triangle < 0) continue;
      const FaceId face = sources[k].triangles->face[at.triangle];
      const SurfaceLook look = look_at(sources[k].colored, face, corner_mix(sources[k], at));
      const double weight = shares[k] * triangle.area;
      weight_sum += weight;
      sum.emissive += weight * look.emissive;
      sum.metallic += weight * look.metallic;
      sum.roughness += weight * look.roughness;
      const Material& material = material_of(sources[k].colored, face);
      mean.material.double_sided = mean.material.double_sided || material.double_sided;
      all_unlit = all_unlit && material.unlit;
      if (const auto density = texture_density(sources[k], at.triangle)) densities.push_back(*density);
    }
  }
  mean.material.name = "junction";
  if (weight_sum > 0) {
    mean.material.emissive = (sum.emissive / weight_sum).cwiseMin(1.0);
    mean.material.metallic = std::clamp(sum.metallic / weight_sum, 0.0, 1.0);
    mean.material.roughness = std::clamp(sum.roughness / weight_sum, 0.0, 1.0);
    mean.material.unlit = all_unlit;
  }
  mean.density = median(std::move(densities));
  return mean;
}

// Texel coordinates of all corners of `faces`, face after face.
std::vector<Vec2> texel_corners(const JunctionSurface& junction, std::span<const Chart> charts,
                                const ChartPacking& packing) {
  std::vector<std::size_t> first(junction.faces.size());
  std::size_t count = 0;
  for (std::size_t f = 0; f < junction.faces.size(); ++f) {
    first[f] = count;
    count += junction.mesh->face(junction.faces[f]).size();
  }
  std::vector<Vec2> texels(count, Vec2::Zero());
  for (std::size_t c = 0; c < charts.size(); ++c)
    for (std::size_t i = 0; i < charts[c].faces.size(); ++i)
      for (std::size_t k = 0; k < charts[c].corners[i].size(); ++k)
        texels[first[charts[c].faces[i]] + k] =
            packing.origin[c] + packing.texels_per_metre * charts[c].corners[i][k];
  return texels;
}

Vec3 blended_color(const JunctionSurface& junction, const JunctionTriangle& triangle, const Vec3& barycentric,
                   std::span<const TextureSource> sources, std::vector<SourceProbe>& probes) {
  const SurfacePoint point = point_of(*junction.mesh, triangle, barycentric);
  const auto shares = shares_at(sources, triangle, barycentric);
  Vec3 sum = Vec3::Zero();
  double found = 0;
  for (std::size_t k = 0; k < sources.size(); ++k) {
    if (!(shares[k] > 0)) continue;
    const ClosestPoint at = probes[k].find(point);
    if (at.triangle < 0) continue;
    sum += shares[k] * base_color_at(sources[k].colored, sources[k].triangles->face[at.triangle],
                                     corner_mix(sources[k], at));
    found += shares[k];
  }
  return found > 0 ? Vec3(sum / found) : Vec3(Vec3::Ones());
}

// Linear colour of every mapped texel.
std::vector<Vec3> bake_texels(const JunctionSurface& junction, std::span<const JunctionTriangle> triangles,
                              std::span<const TextureSource> sources, const std::vector<TexelPoint>& map,
                              int width, double mean_edge) {
  std::vector<Vec3> colors(map.size(), Vec3::Zero());
  parallel_for(map.size() / width, [&](std::size_t row) {
    std::vector<SourceProbe> probes;
    for (const TextureSource& source : sources) probes.emplace_back(source, mean_edge);
    for (std::size_t i = row * width; i < (row + 1) * width; ++i)
      if (map[i].triangle >= 0)
        colors[i] = blended_color(junction, triangles[map[i].triangle], map[i].barycentric, sources, probes);
  });
  return colors;
}

// The one colour that all mapped texels have, if there is one.
std::optional<Vec3> only_color(const std::vector<Vec3>& colors, const std::vector<TexelPoint>& map) {
  std::optional<Vec3> low, high;
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (map[i].triangle < 0) continue;
    low = low ? Vec3(low->cwiseMin(colors[i])) : colors[i];
    high = high ? Vec3(high->cwiseMax(colors[i])) : colors[i];
  }
  if (!low || (*high - *low).maxCoeff() > kOneColor / 12.92)
    return std::nullopt;  // 12.92: steepest part of sRGB
  return Vec3((*low + *high) / 2);
}

Raster encoded(const std::vector<Vec3>& colors, const std::vector<TexelPoint>& map, int width) {
  Raster raster{width, static_cast<int>(map.size()) / width, std::vector<std::uint8_t>(4 * map.size(), 255)};
  std::vector<bool> is_set(map.size());
  for (std::size_t i = 0; i < map.size(); ++i) {
    is_set[i] = map[i].triangle >= 0;
    for (int c = 0; is_set[i] && c < 3; ++c) raster.rgba[4 * i + c] = srgb8_from_linear(colors[i][c]);
  }
  fill_unset(raster, std::move(is_set));
  return raster;
}

}  // namespace

JunctionTexture bake_junction_texture(const JunctionSurface& junction, std::span<const TextureSource> sources,
                                      const JunctionTextureOptions& options) {
  JunctionTexture result;
  result.material.name = "junction";
  if (junction.faces.empty() || sources.empty()) return result;
  const auto triangles = triangles_of(junction);
  const double mean_edge = mean_edge_of(junction);
  const JunctionLook look = mean_look(junction, triangles, sources, mean_edge);
  result.material = look.material;
  result.neighbours_density = look.density;

  const auto charts = make_charts(*junction.mesh, junction.faces, options.charts);
  const double wanted = std::max(look.density, mean_edge > 0 ? options.texels_per_edge / mean_edge : 1.0);
  const ChartPacking packing =
      pack_charts(charts, {wanted, options.smallest, options.largest, options.gutter});
  const auto texels = texel_corners(junction, charts, packing);
  std::vector<std::array<Vec2, 3>> flat;
  for (const JunctionTriangle& t : triangles)
    flat.push_back({texels[t.slots[0]], texels[t.slots[1]], texels[t.slots[2]]});
  const auto map = map_texels(flat, packing.width, packing.height, options.gutter + 0.5);
  const auto colors = bake_texels(junction, triangles, sources, map, packing.width, mean_edge);

  result.charts = charts.size();
  if (const auto color = only_color(colors, map)) {
    result.material.base_color.head<3>() = *color;
    return result;
  }
  result.texels_per_metre = packing.texels_per_metre;
  for (const Vec2& t : texels) result.uv.push_back(t.cwiseQuotient(Vec2(packing.width, packing.height)));
  result.base_color = encoded(colors, map, packing.width);
  TextureRef& texture = result.material.base_color_texture.emplace();
  texture.wrap_u = texture.wrap_v = Wrap::ClampToEdge;
  return result;
}

}  // namespace skinforge
