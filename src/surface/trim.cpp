#include "surface/trim.h"

#include <algorithm>
#include <map>

namespace skinforge {
namespace {

class Trimmer {
 public:
  Trimmer(const IsoSurface& surface, std::span<const double> value) : surface_(surface), value_(value) {
    patch_.positions = surface.positions;
  }

  TrianglePatch run() {
    for (const Triangle& t : surface_.triangles) add(t);
    return without_unused_vertices(patch_);
  }

 private:
  bool is_inside(std::int32_t v) const { return value_[v] > 0; }

  void add(const Triangle& t) {
    const int inside = is_inside(t[0]) + is_inside(t[1]) + is_inside(t[2]);
    if (inside == 3) patch_.triangles.push_back(t);
    if (inside == 0 || inside == 3) return;
    int k = 0;  // the odd one out first, orientation kept
    while (is_inside(t[k]) != (inside == 1)) ++k;
    const std::int32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
    const std::int32_t ab = cut(a, b), ac = cut(a, c);
    if (inside == 1) {
      patch_.triangles.push_back({a, ab, ac});
    } else {
      patch_.triangles.push_back({ab, b, c});
      patch_.triangles.push_back({ab, c, ac});
    }
  }

  std::int32_t cut(std::int32_t a, std::int32_t b) {
    const auto key = std::minmax(a, b);
    const auto [entry, is_new] = cuts_.try_emplace(key, static_cast<std::int32_t>(patch_.positions.size()));
    if (is_new) {
      const double va = value_[key.first], vb = value_[key.second];
      constexpr double kLeast = 0.1;  // ours: cuts stay a tenth of the edge away from its ends
      const double t = std::clamp(va / (va - vb), kLeast, 1 - kLeast);
      patch_.positions.push_back(surface_.positions[key.first] +
                                 t * (surface_.positions[key.second] - surface_.positions[key.first]));
    }
    return entry->second;
  }

  const IsoSurface& surface_;
  std::span<const double> value_;
  TrianglePatch patch_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> cuts_;
};

}  // namespace

TrianglePatch trim_positive(const IsoSurface& surface, std::span<const double> value) {
  return Trimmer(surface, value).run();
}

}  // namespace skinforge
