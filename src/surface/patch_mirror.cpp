#include "surface/patch_mirror.h"

#include <map>
#include <queue>

namespace skinforge {
namespace {

using HalfEdge = std::pair<std::int32_t, std::int32_t>;

// The faces of a patch, and where they have each half edge.
class Faces {
 public:
  explicit Faces(const QuadPatch& patch) : patch_(patch) {
    for (std::size_t f = 0; f < count(); ++f)
      for (std::size_t k = 0; k < face(f).size(); ++k) corner_.emplace(edge(f, k), std::pair(f, k));
  }

  std::size_t count() const { return patch_.quads.size() + patch_.triangles.size(); }
  std::span<const std::int32_t> face(std::size_t f) const {
    if (f < patch_.quads.size()) return patch_.quads[f];
    return patch_.triangles[f - patch_.quads.size()];
  }
  HalfEdge edge(std::size_t f, std::size_t k) const {
    const auto corners = face(f);
    return {corners[k], corners[(k + 1) % corners.size()]};
  }
  // The face that runs along an edge, and its corner there.
  std::optional<std::pair<std::size_t, std::size_t>> along(HalfEdge edge) const {
    const auto found = corner_.find(edge);
    if (found == corner_.end()) return std::nullopt;
    return found->second;
  }

 private:
  const QuadPatch& patch_;
  std::map<HalfEdge, std::pair<std::size_t, std::size_t>> corner_;
};

class Spreading {
 public:
  Spreading(const QuadPatch& patch, const PatchMirror& borders)
      : faces_(patch), image_(patch.positions.size(), -1), is_done_(faces_.count(), 0) {
    std::copy_n(borders.image.begin(), patch.fixed, image_.begin());
  }

  std::optional<std::vector<std::int32_t>> run() {
    for (std::size_t f = 0; f < faces_.count(); ++f)
      for (std::size_t k = 0; k < faces_.face(f).size(); ++k) {
        const HalfEdge edge = faces_.edge(f, k);
        const bool is_border = !faces_.along({edge.second, edge.first});
        if (is_border && image_[edge.first] >= 0 && image_[edge.second] >= 0) open_.push({f, k});
      }
    while (!open_.empty()) {
      const auto [f, k] = open_.front();
      open_.pop();
      if (!take(f, k)) return std::nullopt;
    }
    for (std::size_t v = 0; v < image_.size(); ++v)
      if (image_[v] < 0 || image_[static_cast<std::size_t>(image_[v])] != static_cast<std::int32_t>(v))
        return std::nullopt;
    return image_;
  }

 private:
  // Maps face f, whose edge k has an image, and goes on across its other edges.
  bool take(std::size_t f, std::size_t k) {
    const auto corners = faces_.face(f);
    const HalfEdge edge = faces_.edge(f, k);
    const auto found = faces_.along({image_[edge.second], image_[edge.first]});
    if (!found) return false;
    const auto image = faces_.face(found->first);
    const std::size_t n = corners.size();
    if (image.size() != n) return false;
    for (std::size_t i = 0; i < n; ++i) {  // forwards here, backwards there
      std::int32_t& known = image_[corners[(k + i) % n]];
      const std::int32_t read = image[(found->second + 1 + n - i) % n];
      if (known >= 0 && known != read) return false;
      known = read;
    }
    if (is_done_[f]) return true;
    is_done_[f] = 1;
    for (std::size_t i = 0; i < n; ++i) {
      const HalfEdge next = faces_.edge(f, i);
      if (const auto other = faces_.along({next.second, next.first})) open_.push(*other);
    }
    return true;
  }

  Faces faces_;
  std::vector<std::int32_t> image_;
  std::vector<char> is_done_;
  std::queue<std::pair<std::size_t, std::size_t>> open_;
};

}  // namespace

std::optional<PatchMirror> mirror_of(const QuadPatch& patch, const PatchMirror& borders) {
  auto image = Spreading(patch, borders).run();
  if (!image) return std::nullopt;
  return PatchMirror{borders.plane, *std::move(image)};
}

void make_symmetric(QuadPatch& patch, const PatchMirror& mirror) {
  for (std::size_t v = patch.fixed; v < patch.positions.size(); ++v) {
    const auto w = static_cast<std::size_t>(mirror.image[v]);
    if (w == v) patch.positions[v] = mirror.plane.onto(patch.positions[v]);
    if (w <= v) continue;
    patch.positions[v] = 0.5 * (patch.positions[v] + mirror.plane.mirrored(patch.positions[w]));
    patch.positions[w] = mirror.plane.mirrored(patch.positions[v]);
  }
}

WantedSurface mirrored(const WantedSurface& surface, const MirrorPlane& plane) {
  return {[&surface, plane](const Vec3& p) {
            if (plane.height(p) >= 0) return surface.project(p);
            return plane.mirrored(surface.project(plane.mirrored(p)));
          },
          [&surface, plane](const Vec3& p) {
            if (plane.height(p) >= 0) return surface.outward(p);
            return plane.mirrored_direction(surface.outward(plane.mirrored(p)));
          },
          [&surface, plane](const Vec3& p) {
            return surface.distance(plane.height(p) >= 0 ? p : plane.mirrored(p));
          },
          surface.voxel};
}

}  // namespace skinforge
