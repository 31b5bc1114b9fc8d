#include "surface/raise_worst.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "geometry/scaled_jacobian.h"

namespace skinforge {
namespace {

constexpr double kGood = 0.5;                      // junction.md c: the target
constexpr int kRounds = 16;                        // ours
constexpr int kDirections = 8;                     // ours: tried around a vertex
constexpr double kFirstStep = 0.4, kShrink = 0.8;  // ours: of the mean edge at the vertex
constexpr double kGain = 1.0 / 1024;  // ours: less is no gain, so equals do not hang on the last bit

class Search {
 public:
  Search(QuadPatch& patch, const WantedSurface& surface, const PatchMirror* mirror)
      : patch_(patch), surface_(surface), mirror_(mirror), faces_(patch.positions.size()) {
    for (std::size_t f = 0; f < face_count(); ++f)
      for (const std::int32_t v : face(f)) faces_[v].push_back(f);
  }

  void run() {
    double step = kFirstStep;
    for (int round = 0; round < kRounds; ++round, step *= kShrink) {
      const std::set<std::int32_t> poor = poor_vertices();
      if (poor.empty()) return;
      for (const std::int32_t v : poor) improve(v, step);
    }
  }

 private:
  std::size_t face_count() const { return patch_.quads.size() + patch_.triangles.size(); }
  std::span<const std::int32_t> face(std::size_t f) const {
    if (f < patch_.quads.size()) return patch_.quads[f];
    return patch_.triangles[f - patch_.quads.size()];
  }

  double quality(std::size_t f) const {
    std::array<Vec3, 4> corners;
    const auto vertices = face(f);
    Vec3 centre = Vec3::Zero();
    for (std::size_t k = 0; k < vertices.size(); ++k) centre += corners[k] = patch_.positions[vertices[k]];
    centre /= static_cast<double>(vertices.size());
    const double jacobian = scaled_jacobian(std::span(corners).first(vertices.size()));
    const Vec3 normal = vertices.size() == 4 ? (corners[2] - corners[0]).cross(corners[3] - corners[1])
                                             : (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    return normal.dot(surface_.outward(centre)) < 0 ? std::min(jacobian, 0.0) - 1 : jacobian;
  }

  double quality_around(std::int32_t v) const {
    double least = 1;
    for (const std::size_t f : faces_[v]) least = std::min(least, quality(f));
    return least;
  }

  std::set<std::int32_t> poor_vertices() const {
    std::set<std::int32_t> poor;
    for (std::size_t f = 0; f < face_count(); ++f)
      if (quality(f) < kGood)
        for (const std::int32_t v : face(f))
          if (static_cast<std::size_t>(v) >= patch_.fixed) poor.insert(leading(v));
    return poor;
  }

  // Of a vertex and its image the one that is moved.
  std::int32_t leading(std::int32_t v) const { return mirror_ ? std::min(v, mirror_->image[v]) : v; }

  void move(std::int32_t v, const Vec3& place) {
    patch_.positions[v] = place;
    if (!mirror_) return;
    const std::int32_t image = mirror_->image[v];
    patch_.positions[image] = image == v ? mirror_->plane.onto(place) : mirror_->plane.mirrored(place);
  }

  // The faces' mean normal at a vertex, and the mean length of its edges.
  std::pair<Vec3, double> frame(std::int32_t v) const {
    Vec3 normal = Vec3::Zero();
    double length = 0;
    int edges = 0;
    for (const std::size_t f : faces_[v]) {
      const auto vertices = face(f);
      const std::size_t k =
          static_cast<std::size_t>(std::find(vertices.begin(), vertices.end(), v) - vertices.begin());
      const Vec3 next = patch_.positions[vertices[(k + 1) % vertices.size()]] - patch_.positions[v];
      const Vec3 last =
          patch_.positions[vertices[(k + vertices.size() - 1) % vertices.size()]] - patch_.positions[v];
      normal += next.cross(last);
      length += next.norm() + last.norm();
      edges += 2;
    }
    return {normal.norm() > 0 ? Vec3(normal.normalized()) : Vec3(Vec3::UnitZ()), length / edges};
  }

  void improve(std::int32_t v, double step) {
    const Vec3 start = patch_.positions[v];
    const auto [normal, length] = frame(v);
    const auto& ring = face(faces_[v].front());
    const std::size_t k = static_cast<std::size_t>(std::find(ring.begin(), ring.end(), v) - ring.begin());
    const Vec3 along = patch_.positions[ring[(k + 1) % ring.size()]] - start;
    const Vec3 x = (along - along.dot(normal) * normal).normalized(), y = normal.cross(x);
    if (!x.allFinite()) return;
    double best = quality_around(v);
    Vec3 place = start;
    for (int d = 0; d < kDirections; ++d) {
      const double angle = 2 * std::numbers::pi * d / kDirections;
      move(v, surface_.project(start + step * length * (std::cos(angle) * x + std::sin(angle) * y)));
      const double found = quality_around(v);
      if (found > best + kGain) best = found, place = patch_.positions[v];
    }
    move(v, place);
  }

  QuadPatch& patch_;
  const WantedSurface& surface_;
  const PatchMirror* mirror_;
  std::vector<std::vector<std::size_t>> faces_;
};

}  // namespace

void raise_worst(QuadPatch& patch, const WantedSurface& surface, const PatchMirror* mirror) {
  Search(patch, surface, mirror).run();
}

void polish_symmetric(QuadPatch& patch, const WantedSurface& surface, const PatchMirror& mirror) {
  const WantedSurface both = mirrored(surface, mirror.plane);
  make_symmetric(patch, mirror);
  polish(patch, both.project);
  make_symmetric(patch, mirror);  // but for rounding it is
  raise_worst(patch, both, &mirror);
}

}  // namespace skinforge
