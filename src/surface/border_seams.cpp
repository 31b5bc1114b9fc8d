#include "surface/border_seams.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <set>

namespace skinforge {
namespace {

// Loops of a patch that become two borders, those of either side joined by seams.
class Joining {
 public:
  Joining(const TrianglePatch& patch, const std::vector<IndexLoop>& loops, const BorderSides& is_on_b)
      : patch_(patch),
        is_on_b_(is_on_b),
        loop_of_vertex_(patch.positions.size(), -1),
        blocked_(patch.positions.size(), 0) {
    for (std::size_t l = 0; l < loops.size(); ++l)
      for (const std::int32_t v : loops[l]) loop_of_vertex_[v] = static_cast<std::int32_t>(l);
    group_.resize(loops.size());
    std::iota(group_.begin(), group_.end(), 0);
    std::map<std::pair<std::int32_t, std::int32_t>, double> edges;
    for (const Triangle& t : patch.triangles)
      for (int k = 0; k < 3; ++k) {
        const std::int32_t a = t[k], b = t[(k + 1) % 3];
        edges[std::minmax(a, b)] = (patch.positions[a] - patch.positions[b]).norm();
      }
    neighbours_.resize(patch.positions.size());
    for (const auto& [edge, length] : edges) {
      neighbours_[edge.first].push_back({edge.second, length});
      neighbours_[edge.second].push_back({edge.first, length});
    }
  }

  // Shortest seams until all loops of a side are one; none when seams would touch each other or a border.
  std::optional<std::vector<SeamPath>> join() {
    std::vector<SeamPath> seams;
    for (std::size_t joined = 2; joined < group_.size(); ++joined) {
      const SeamPath seam = shortest_seam();
      if (seam.empty()) return std::nullopt;
      for (const std::int32_t v : seam) blocked_[v] = 1;
      const std::int32_t from = group_[loop_of_vertex_[seam.front()]],
                         to = group_[loop_of_vertex_[seam.back()]];
      for (std::int32_t& g : group_)
        if (g == to) g = from;
      seams.push_back(seam);
    }
    return seams;
  }

 private:
  SeamPath shortest_seam() const {
    SeamPath best;
    double least = std::numeric_limits<double>::infinity();
    std::set<std::int32_t> groups(group_.begin(), group_.end());
    for (const std::int32_t g : groups) {
      const SeamPath path = shortest_from(g);
      if (!path.empty() && length_of(patch_, path) < (1 - 1e-6) * least)
        best = path, least = length_of(patch_, path);
    }
    return best;
  }

  // From the border vertices of a group to the nearest of another group of its side, through free vertices
  // (Dijkstra).
  SeamPath shortest_from(std::int32_t group) const {
    const auto is_beside = [&](std::int32_t loop) {
      return is_on_b_[static_cast<std::size_t>(loop)] == is_on_b_[static_cast<std::size_t>(group)];
    };
    std::vector<double> distance(patch_.positions.size(), std::numeric_limits<double>::infinity());
    std::vector<std::int32_t> before(patch_.positions.size(), -1);
    using Entry = std::pair<double, std::int32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    for (std::size_t v = 0; v < loop_of_vertex_.size(); ++v)
      if (loop_of_vertex_[v] >= 0 && group_[loop_of_vertex_[v]] == group && !blocked_[v])
        distance[v] = 0, open.push({0, static_cast<std::int32_t>(v)});
    while (!open.empty()) {
      const auto [d, v] = open.top();
      open.pop();
      if (d > distance[v]) continue;
      const std::int32_t loop = loop_of_vertex_[v];
      if (loop >= 0 && group_[loop] != group) {
        SeamPath path;
        for (std::int32_t at = v; at >= 0; at = before[at]) path.push_back(at);
        std::reverse(path.begin(), path.end());
        return path;
      }
      for (const auto& [next, length] : neighbours_[v]) {
        const std::int32_t other = loop_of_vertex_[next];
        const bool is_open = other < 0 || (group_[other] != group && is_beside(other));
        if (!is_open || blocked_[next] || d + length >= distance[next]) continue;
        distance[next] = d + length;
        before[next] = v;
        open.push({distance[next], next});
      }
    }
    return {};
  }

  const TrianglePatch& patch_;
  const BorderSides& is_on_b_;
  std::vector<std::int32_t> loop_of_vertex_, group_;  // a group is named after one of its loops
  std::vector<char> blocked_;                         // on a seam
  std::vector<std::vector<std::pair<std::int32_t, double>>> neighbours_;
};

}  // namespace

double length_of(const TrianglePatch& patch, const SeamPath& path) {
  double length = 0;
  for (std::size_t k = 0; k + 1 < path.size(); ++k)
    length += (patch.positions[path[k]] - patch.positions[path[k + 1]]).norm();
  return length;
}

std::optional<std::vector<SeamPath>> shortest_seams(const TrianglePatch& patch,
                                                    const std::vector<IndexLoop>& loops,
                                                    const BorderSides& is_on_b) {
  return Joining(patch, loops, is_on_b).join();
}

}  // namespace skinforge
