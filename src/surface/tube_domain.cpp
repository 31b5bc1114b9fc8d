#include "surface/tube_domain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "surface/border_seams.h"

namespace skinforge {
namespace {

// Per border vertex the loop that it belongs to.
std::vector<std::int32_t> loops_of_vertices(std::size_t fixed, const std::vector<IndexLoop>& borders) {
  std::vector<std::int32_t> loop_of_vertex(fixed, -1);
  for (std::size_t l = 0; l < borders.size(); ++l)
    for (const std::int32_t v : borders[l])
      loop_of_vertex[static_cast<std::size_t>(v)] = static_cast<std::int32_t>(l);
  return loop_of_vertex;
}

// Cuts a patch open along a path from border to border: what lies to its right gets vertices of its own, at
// the same places. `original`: per vertex, what it was before any cut; grows.
void cut_open(TrianglePatch& patch, const SeamPath& path, std::vector<std::int32_t>& original) {
  std::set<std::pair<std::int32_t, std::int32_t>> along;  // left half edges of the path
  for (std::size_t k = 0; k + 1 < path.size(); ++k) along.insert({path[k], path[k + 1]});
  std::vector<std::pair<std::size_t, std::int32_t>> renamed;  // corner (3 t + k) to a new vertex
  for (std::size_t i = 0; i < path.size(); ++i) {
    const std::int32_t v = path[i];
    std::map<std::int32_t, std::size_t> by_first, by_second;  // triangles around v by their other corners
    for (std::size_t t = 0; t < patch.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        if (patch.triangles[t][k] == v) {
          by_first[patch.triangles[t][(k + 1) % 3]] = 3 * t + k;
          by_second[patch.triangles[t][(k + 2) % 3]] = 3 * t + k;
        }
    const auto copy = static_cast<std::int32_t>(patch.positions.size());
    patch.positions.push_back(patch.positions[v]);
    original.push_back(original[v]);
    // Right of the path, turning clockwise: from the edge to the next vertex, or from the one to the last.
    const bool has_next = i + 1 < path.size();
    const std::int32_t stop = has_next ? (i > 0 ? path[i - 1] : -1) : -1;
    if (has_next) {
      for (std::int32_t edge = path[i + 1]; by_second.contains(edge) && edge != stop;) {
        const std::size_t corner = by_second.at(edge);
        renamed.push_back({corner, copy});
        edge = patch.triangles[corner / 3][(corner % 3 + 1) % 3];
      }
    } else {
      for (std::int32_t edge = path[i - 1]; by_first.contains(edge);) {
        const std::size_t corner = by_first.at(edge);
        renamed.push_back({corner, copy});
        edge = patch.triangles[corner / 3][(corner % 3 + 2) % 3];
      }
    }
  }
  for (const auto& [corner, vertex] : renamed) patch.triangles[corner / 3][corner % 3] = vertex;
}

// The seams of one domain as vertices of the result.
struct Seam {
  SeamPath path;
  int pieces = 1;
  std::int32_t first = 0;  // name of its first inner vertex
};

// The points of one boundary loop of the cut patch.
TubeBorder border_of(const TubeDomain& domain, const IndexLoop& loop,
                     const std::vector<std::int32_t>& original, const std::vector<Seam>& seams) {
  TubeBorder border{loop, {}, 0};
  const auto fixed = static_cast<std::int32_t>(domain.fixed);
  const auto was = [&](std::size_t k) { return original[loop[k % loop.size()]]; };
  std::size_t start = 0;
  while (was(start) >= fixed) ++start;  // a border has its own vertices, seams run between them
  std::rotate(border.loop.begin(), border.loop.begin() + static_cast<std::ptrdiff_t>(start),
              border.loop.end());
  const IndexLoop& l = border.loop;
  for (std::size_t k = 0; k < l.size();) {
    const std::int32_t v = original[l[k]];
    border.points.push_back({static_cast<double>(k), v});
    std::size_t edges = 1;
    while (original[l[(k + edges) % l.size()]] >= fixed) ++edges;
    const std::int32_t next = original[l[(k + edges) % l.size()]];
    for (const Seam& seam : seams) {
      const bool forwards = seam.path.front() == v && seam.path.back() == next;
      const bool backwards = seam.path.back() == v && seam.path.front() == next;
      if ((!forwards && !backwards) || seam.path.size() != edges + 1) continue;
      const auto places = spaced_places(domain.patch, l, k, edges, seam.pieces);
      for (std::size_t p = 0; p < places.size(); ++p)
        border.points.push_back(
            {places[p], seam.first + static_cast<std::int32_t>(forwards ? p : places.size() - 1 - p)});
    }
    k += edges;
  }
  return border;
}

// Mean edge and mean depth of the preserved row, over the loops of a side.
struct Pace {
  double edge = 0, depth = 0;
};

Pace pace_of(const std::vector<JunctionLoop>& loops, const BorderSides& is_on_b, bool side) {
  Pace sum;
  double edges = 0;
  for (std::size_t l = 0; l < loops.size(); ++l) {
    if (is_on_b[l] != side) continue;
    const auto count = static_cast<double>(loops[l].positions.size());
    sum.edge += loop_length(loops[l].positions);
    sum.depth += count * row_depth(loops[l]);
    edges += count;
  }
  return {sum.edge / edges, sum.depth / edges};
}

// New vertices along a path, an edge's length apart.
Seam lay_seam(TubeDomain& domain, const TrianglePatch& patch, const SeamPath& path, double edge) {
  const int pieces = std::max(1, static_cast<int>(std::lround(length_of(patch, path) / edge)));
  const Seam seam{path, pieces, static_cast<std::int32_t>(domain.fixed + domain.seams.size())};
  for (const double place : spaced_places(patch, path, 0, path.size() - 1, pieces)) {
    const auto k = static_cast<std::size_t>(place);
    const Vec3 &p = patch.positions[path[k]], &q = patch.positions[path[k + 1]];
    domain.seams.emplace_back(p + (place - static_cast<double>(k)) * (q - p));
  }
  return seam;
}

std::optional<TubeDomain> domain_between(const TrianglePatch& patch, const std::vector<JunctionLoop>& loops,
                                         const BorderSides& is_on_b) {
  const std::vector<IndexLoop> borders = lay_borders(loops).loops;
  const auto paths = shortest_seams(patch, borders, is_on_b);
  if (!paths) return std::nullopt;
  TubeDomain domain{patch, {}, {}, {}, patch.fixed};
  std::vector<std::int32_t> original(patch.positions.size());
  std::iota(original.begin(), original.end(), 0);
  const std::array<Pace, 2> pace = {pace_of(loops, is_on_b, false), pace_of(loops, is_on_b, true)};
  const std::vector<std::int32_t> loop_of_vertex = loops_of_vertices(patch.fixed, borders);
  std::vector<Seam> seams;
  for (const SeamPath& path : *paths) {
    const bool side = is_on_b[static_cast<std::size_t>(loop_of_vertex[static_cast<std::size_t>(path[0])])];
    seams.push_back(lay_seam(domain, patch, path, pace[side].edge));
    cut_open(domain.patch, path, original);
  }
  const auto boundary = boundary_loops(domain.patch.triangles);
  if (boundary.size() != 2) return std::nullopt;
  const std::size_t first =
      static_cast<std::size_t>(std::find(is_on_b.begin(), is_on_b.end(), false) - is_on_b.begin());
  const bool is_first =
      std::find(boundary[0].begin(), boundary[0].end(), borders[first][0]) != boundary[0].end();
  domain.a = border_of(domain, boundary[is_first ? 0 : 1], original, seams);
  domain.b = border_of(domain, boundary[is_first ? 1 : 0], original, seams);
  domain.a.depth = pace[0].depth;
  domain.b.depth = pace[1].depth;
  turn_round(domain.b);
  return domain;
}

// All ways to lay more than three loops on two sides of two loops each at least, the first loop on A.
std::vector<BorderSides> divisions(std::size_t loops) {
  std::vector<BorderSides> all;
  for (std::size_t bits = 1; loops > 3 && bits < (std::size_t{1} << (loops - 1)); ++bits) {
    BorderSides is_on_b(loops, false);
    for (std::size_t l = 1; l < loops; ++l) is_on_b[l] = (bits >> (l - 1)) & 1;
    const auto on_b = static_cast<std::size_t>(std::count(is_on_b.begin(), is_on_b.end(), true));
    if (on_b >= 2 && on_b + 2 <= loops) all.push_back(std::move(is_on_b));
  }
  return all;
}

}  // namespace

double row_depth(const JunctionLoop& loop) {
  const double edge = loop_length(loop.positions) / static_cast<double>(loop.positions.size());
  double sum = 0;
  int count = 0;
  for (std::size_t v = 0; v < loop.positions.size(); ++v)
    for (const Vec3& p : loop.inward[v]) sum += (p - loop.positions[v]).norm(), ++count;
  return count == 0 ? edge : std::clamp(sum / count, edge / 2, 2 * edge);
}

std::vector<double> spaced_places(const TrianglePatch& patch, const IndexLoop& loop, std::size_t begin,
                                  std::size_t edges, int pieces) {
  std::vector<double> until = {0};
  for (std::size_t k = 0; k < edges; ++k)
    until.push_back(until.back() + (patch.positions[loop[(begin + k) % loop.size()]] -
                                    patch.positions[loop[(begin + k + 1) % loop.size()]])
                                       .norm());
  std::vector<double> places;
  std::size_t k = 0;
  for (int p = 1; p < pieces; ++p) {
    const double wanted = until.back() * p / pieces;
    while (k + 2 < until.size() && until[k + 1] < wanted) ++k;
    places.push_back(static_cast<double>(begin + k) + (wanted - until[k]) / (until[k + 1] - until[k]));
  }
  return places;
}

void turn_round(TubeBorder& border) {
  std::reverse(border.loop.begin(), border.loop.end());
  const double last = static_cast<double>(border.loop.size() - 1);
  for (TubeBorderPoint& point : border.points)
    point.place = std::fmod(last - point.place + last + 1, last + 1);
  std::sort(border.points.begin(), border.points.end(),
            [](const TubeBorderPoint& p, const TubeBorderPoint& q) { return p.place < q.place; });
}

std::optional<TubeDomain> tube_domain(const TrianglePatch& patch, const std::vector<JunctionLoop>& loops) {
  BorderSides is_on_b(loops.size(), true);
  is_on_b[0] = false;
  return domain_between(patch, loops, is_on_b);
}

std::optional<TubeDomain> even_domain(const TrianglePatch& patch, const std::vector<JunctionLoop>& loops) {
  std::optional<TubeDomain> best;
  const auto difference = [](const TubeDomain& d) {
    return std::max(d.a.points.size(), d.b.points.size()) - std::min(d.a.points.size(), d.b.points.size());
  };
  for (const BorderSides& is_on_b : divisions(loops.size()))
    if (auto domain = domain_between(patch, loops, is_on_b))
      if (!best || difference(*domain) < difference(*best)) best = std::move(domain);
  return best;
}

}  // namespace skinforge
