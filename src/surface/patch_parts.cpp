#include "surface/patch_parts.h"

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
