#include "surface/cut_line.h"

#include <algorithm>
#include <map>

namespace skinforge {
namespace {

using EdgeKey = std::pair<VertexId, VertexId>;

struct Segment {
  EdgeKey ends[2];
  Vec3 middle;
  double length;
};

std::vector<Segment> half_presence_segments(const PolygonMesh& mesh, const std::vector<double>& presence) {
  std::vector<Segment> segments;
  for (const auto& triangle : triangulate(mesh).triangles) {
    EdgeKey keys[3];
    Vec3 points[3];
    int found = 0;
    for (int k = 0; k < 3; ++k) {
      const VertexId a = triangle[k], b = triangle[(k + 1) % 3];
      const double pa = presence[a.index()] - 0.5, pb = presence[b.index()] - 0.5;
      if ((pa < 0) == (pb < 0)) continue;
      keys[found] = std::minmax(a, b);
      points[found++] = mesh.positions[a.index()] +
                        pa / (pa - pb) * (mesh.positions[b.index()] - mesh.positions[a.index()]);
    }
    if (found == 2)
      segments.push_back({{keys[0], keys[1]}, 0.5 * (points[0] + points[1]), (points[1] - points[0]).norm()});
  }
  return segments;
}

}  // namespace

std::optional<CutLine> longest_cut_line(const PolygonMesh& mesh, const std::vector<double>& presence) {
  const std::vector<Segment> segments = half_presence_segments(mesh, presence);
  std::map<EdgeKey, EdgeKey> root;
  const auto find = [&](EdgeKey key) {
    while (root.at(key) != key) key = root.at(key);
    return key;
  };
  for (const Segment& s : segments) {
    for (const EdgeKey& end : s.ends) root.try_emplace(end, end);
    const EdgeKey a = find(s.ends[0]), b = find(s.ends[1]);
    root[std::max(a, b)] = std::min(a, b);
  }
  std::map<EdgeKey, CutLine> lines;
  for (const Segment& s : segments) {
    CutLine& line = lines[find(s.ends[0])];
    line.centre += s.length * s.middle;
    line.length += s.length;
  }
  std::optional<CutLine> longest;
  for (const auto& [key, line] : lines)
    if (line.length > 0 && (!longest || line.length > longest->length)) longest = line;
  if (longest) longest->centre /= longest->length;
  return longest;
}

}  // namespace skinforge
