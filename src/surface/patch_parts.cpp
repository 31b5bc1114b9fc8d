#include "surface/patch_parts.h"

#include <algorithm>
#include <map>

namespace skinforge {

std::vector<PatchPart> split_parts(const TrianglePatch& whole, const std::vector<JunctionLoop>& loops) {
  const auto [component, count] = triangle_components(whole.triangles, whole.positions.size());
  std::vector<std::int32_t> component_of_vertex(whole.positions.size(), -1);
  for (std::size_t t = 0; t < whole.triangles.size(); ++t)
    for (const std::int32_t v : whole.triangles[t]) component_of_vertex[v] = component[t];
  std::vector<PatchPart> parts(static_cast<std::size_t>(count));
  std::vector<std::int32_t> name(whole.positions.size(), -1);
  const auto add_vertex = [&](std::size_t v) {
    if (component_of_vertex[v] < 0) return;
    PatchPart& part = parts[static_cast<std::size_t>(component_of_vertex[v])];
    name[v] = static_cast<std::int32_t>(part.vertex.size());
    part.vertex.push_back(static_cast<std::int32_t>(v));
    part.patch.positions.push_back(whole.positions[v]);
    part.patch.fixed += v < whole.fixed;
  };
  std::size_t first = 0;
  for (std::size_t l = 0; l < loops.size(); ++l) {
    const std::int32_t owner = component_of_vertex[first];
    if (owner >= 0) parts[static_cast<std::size_t>(owner)].loops.push_back(l);
    for (std::size_t k = 0; k < loops[l].positions.size(); ++k) add_vertex(first++);
  }
  for (std::size_t v = whole.fixed; v < whole.positions.size(); ++v) add_vertex(v);
  for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
    const auto& [a, b, c] = whole.triangles[t];
    parts[static_cast<std::size_t>(component[t])].patch.triangles.push_back({name[a], name[b], name[c]});
  }
  return parts;
}

std::optional<PartImage> image_of_part(const std::vector<PatchPart>& parts, std::size_t p,
                                       const PatchMirror& borders) {
  if (parts[p].patch.fixed == 0) return std::nullopt;
  const std::int32_t first = borders.image[static_cast<std::size_t>(parts[p].vertex[0])];
  for (std::size_t q = 0; q < parts.size(); ++q) {
    const auto begin = parts[q].vertex.begin(),
               end = begin + static_cast<std::ptrdiff_t>(parts[q].patch.fixed);
    if (std::find(begin, end, first) == end || parts[q].patch.fixed != parts[p].patch.fixed) continue;
    std::map<std::int32_t, std::int32_t> name;
    for (auto v = begin; v != end; ++v) name[*v] = static_cast<std::int32_t>(v - begin);
    PartImage image{q, {borders.plane, {}}};
    for (std::size_t v = 0; v < parts[p].patch.fixed; ++v) {
      const auto found = name.find(borders.image[static_cast<std::size_t>(parts[p].vertex[v])]);
      if (found == name.end()) return std::nullopt;
      image.borders.image.push_back(found->second);
    }
    return image;
  }
  return std::nullopt;
}

QuadPatch reflected(const QuadPatch& quads, const PatchMirror& borders, std::span<const Vec3> fixed) {
  QuadPatch result{{fixed.begin(), fixed.end()}, {}, {}, quads.fixed};
  for (std::size_t v = quads.fixed; v < quads.positions.size(); ++v)
    result.positions.push_back(borders.plane.mirrored(quads.positions[v]));
  const auto name = [&](std::int32_t v) {
    return static_cast<std::size_t>(v) < quads.fixed ? borders.image[static_cast<std::size_t>(v)] : v;
  };
  for (const Quad& q : quads.quads) result.quads.push_back({name(q[0]), name(q[3]), name(q[2]), name(q[1])});
  for (const Triangle& t : quads.triangles) result.triangles.push_back({name(t[0]), name(t[2]), name(t[1])});
  return result;
}

void add_part(QuadPatch& whole, const PatchPart& part, const QuadPatch& quads) {
  const auto offset = static_cast<std::int32_t>(whole.positions.size() - quads.fixed);
  whole.positions.insert(whole.positions.end(),
                         quads.positions.begin() + static_cast<std::ptrdiff_t>(quads.fixed),
                         quads.positions.end());
  const auto name = [&](std::int32_t v) {
    return static_cast<std::size_t>(v) < quads.fixed ? part.vertex[v] : v + offset;
  };
  for (const Quad& q : quads.quads) whole.quads.push_back({name(q[0]), name(q[1]), name(q[2]), name(q[3])});
  for (const Triangle& t : quads.triangles) whole.triangles.push_back({name(t[0]), name(t[1]), name(t[2])});
}

QuadPatch triangles_of(const PatchPart& part) {
  return {part.patch.positions, {}, part.patch.triangles, part.patch.fixed};
}

}  // namespace skinforge
