#include "surface/half_tube.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace skinforge {
namespace {

// Cuts the part of a patch above the plane off. Border vertices stay what they are: those that are their own
// images are on the plane. New vertices are on it, too.
class HalfCutter {
 public:
  HalfCutter(const TrianglePatch& patch, const PatchMirror& borders) : patch_(patch), half_(patch) {
    half_.triangles.clear();
    for (std::size_t v = 0; v < patch.positions.size(); ++v) {
      height_.push_back(borders.plane.height(patch.positions[v]));
      const bool is_on_plane = v < patch.fixed && borders.image[v] == static_cast<std::int32_t>(v);
      if (is_on_plane)
        height_[v] = 0;
      else if (height_[v] == 0)
        height_[v] = std::numeric_limits<double>::min();  // above, to belong to a side
    }
    plane_ = borders.plane;
  }

  // None when an edge between border vertices would be cut.
  std::optional<TrianglePatch> run() {
    for (const Triangle& t : patch_.triangles)
      if (!add(t)) return std::nullopt;
    return std::move(half_);
  }

 private:
  bool add(const Triangle& t) {
    std::vector<std::int32_t> above;  // the corners of what is above
    bool any = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t v = t[k], next = t[(k + 1) % 3];
      if (height_[v] >= 0) above.push_back(v);
      any |= height_[v] > 0;
      if (!(std::min(height_[v], height_[next]) < 0 && std::max(height_[v], height_[next]) > 0)) continue;
      if (static_cast<std::size_t>(std::max(v, next)) < patch_.fixed) return false;
      above.push_back(cut(v, next));
    }
    for (std::size_t k = 2; any && k < above.size(); ++k)
      half_.triangles.push_back({above[0], above[k - 1], above[k]});
    return true;
  }

  std::int32_t cut(std::int32_t a, std::int32_t b) {
    const auto key = std::minmax(a, b);
    const auto [entry, is_new] = cuts_.try_emplace(key, static_cast<std::int32_t>(half_.positions.size()));
    if (is_new) {
      constexpr double kLeast = 0.05;  // ours: cuts stay away from the ends, so that no slivers appear
      const double from = height_[key.first], to = height_[key.second];
      const double part = std::clamp(from / (from - to), kLeast, 1 - kLeast);
      half_.positions.push_back(plane_.onto(
          patch_.positions[key.first] + part * (patch_.positions[key.second] - patch_.positions[key.first])));
    }
    return entry->second;
  }

  const TrianglePatch& patch_;
  TrianglePatch half_;
  MirrorPlane plane_;
  std::vector<double> height_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> cuts_;
};

// A run of cut vertices along a boundary loop, between two border vertices.
struct Run {
  std::size_t begin = 0, edges = 0;  // of the loop
  double length = 0;
  int pieces = 1;
};

std::vector<Run> runs_of(const TrianglePatch& half, const IndexLoop& loop) {
  std::vector<Run> runs;
  const auto is_cut = [&](std::size_t k) {
    return static_cast<std::size_t>(loop[k % loop.size()]) >= half.fixed;
  };
  for (std::size_t k = 0; k < loop.size(); ++k) {
    if (is_cut(k) || !is_cut(k + 1)) continue;
    Run run{k, 1, 0, 1};
    while (is_cut(k + run.edges)) ++run.edges;
    for (std::size_t e = 0; e < run.edges; ++e)
      run.length +=
          (half.positions[loop[(k + e) % loop.size()]] - half.positions[loop[(k + e + 1) % loop.size()]])
              .norm();
    runs.push_back(run);
  }
  return runs;
}

// Names the points of a boundary loop: border vertices, and on each run as many new ones as it has pieces.
TubeBorder border_along(TubeDomain& domain, const IndexLoop& loop, const std::vector<Run>& runs,
                        const MirrorPlane& plane) {
  TubeBorder border{loop, {}, 0};
  for (std::size_t k = 0; k < loop.size(); ++k) {
    if (static_cast<std::size_t>(loop[k]) >= domain.fixed) continue;
    border.points.push_back({static_cast<double>(k), loop[k]});
    for (const Run& run : runs) {
      if (run.begin != k) continue;
      for (const double place : spaced_places(domain.patch, loop, k, run.edges, run.pieces)) {
        const auto i = static_cast<std::size_t>(place);
        const Vec3 &p = domain.patch.positions[loop[i % loop.size()]],
                   &q = domain.patch.positions[loop[(i + 1) % loop.size()]];
        border.points.push_back({place, static_cast<std::int32_t>(domain.fixed + domain.seams.size())});
        domain.seams.push_back(plane.onto(p + (place - static_cast<double>(i)) * (q - p)));
      }
    }
  }
  return border;
}

struct Pace {
  double edge = 0, depth = 0;
};

// Means over the loops that a boundary loop passes.
Pace pace_along(const IndexLoop& loop, const std::vector<JunctionLoop>& loops) {
  Pace sum;
  double edges = 0;
  std::int32_t first = 0;
  for (const JunctionLoop& l : loops) {
    const auto count = static_cast<std::int32_t>(l.positions.size());
    const bool is_passed = std::any_of(loop.begin(), loop.end(),
                                       [&](std::int32_t v) { return v >= first && v < first + count; });
    first += count;
    if (!is_passed) continue;
    sum.edge += loop_length(l.positions);
    sum.depth += count * row_depth(l);
    edges += count;
  }
  return {sum.edge / edges, sum.depth / edges};
}

// Starts a loop at a border vertex.
void rotate_to_border(IndexLoop& loop, std::size_t fixed) {
  const auto first = std::find_if(loop.begin(), loop.end(),
                                  [&](std::int32_t v) { return static_cast<std::size_t>(v) < fixed; });
  std::rotate(loop.begin(), first, loop.end());
}

}  // namespace

std::vector<TubeDomain> half_domains(const TrianglePatch& patch, const std::vector<JunctionLoop>& loops,
                                     const PatchMirror& borders) {
  const auto half = HalfCutter(patch, borders).run();
  if (!half) return {};
  auto boundary = boundary_loops(half->triangles);
  const auto [component, components] = triangle_components(half->triangles, half->positions.size());
  if (boundary.size() != 2 || components != 1) return {};
  const auto has_cut = [&](const IndexLoop& loop) { return !runs_of(*half, loop).empty(); };
  if (has_cut(boundary[0])) std::swap(boundary[0], boundary[1]);
  if (has_cut(boundary[0]) || !has_cut(boundary[1])) return {};
  rotate_to_border(boundary[1], half->fixed);
  std::vector<Run> runs = runs_of(*half, boundary[1]);
  const Pace pace = pace_along(boundary[1], loops);
  std::size_t edges = boundary[0].size() + boundary[1].size();
  for (Run& run : runs) {
    run.pieces = std::max(1, static_cast<int>(std::lround(run.length / pace.edge)));
    edges = edges - run.edges + static_cast<std::size_t>(run.pieces);
  }
  const auto longest = std::max_element(runs.begin(), runs.end(),
                                        [](const Run& p, const Run& q) { return p.length < q.length; });
  const int odd = static_cast<int>(edges % 2);
  std::vector<TubeDomain> domains;
  for (const int more : {odd, odd - 2, odd + 2}) {
    if (longest->pieces + more < 1) continue;
    std::vector<Run> tried = runs;
    tried[static_cast<std::size_t>(longest - runs.begin())].pieces += more;
    TubeDomain domain{*half, {}, {}, {}, patch.fixed};
    domain.a = border_along(domain, boundary[0], {}, borders.plane);
    domain.b = border_along(domain, boundary[1], tried, borders.plane);
    domain.a.depth = pace_along(boundary[0], loops).depth;
    domain.b.depth = pace.depth;
    turn_round(domain.b);
    domains.push_back(std::move(domain));
  }
  return domains;
}

Unfolded unfolded(const QuadPatch& half, std::size_t on_plane, const PatchMirror& borders) {
  Unfolded whole{half, borders};
  const std::size_t own = half.fixed + on_plane, count = half.positions.size();
  whole.mirror.image.resize(half.fixed);
  for (std::size_t v = half.fixed; v < own; ++v) whole.mirror.image.push_back(static_cast<std::int32_t>(v));
  for (std::size_t v = own; v < count; ++v)
    whole.mirror.image.push_back(static_cast<std::int32_t>(v + count - own));
  for (std::size_t v = own; v < count; ++v) {
    whole.mirror.image.push_back(static_cast<std::int32_t>(v));
    whole.patch.positions.push_back(borders.plane.mirrored(half.positions[v]));
  }
  const auto name = [&](std::int32_t v) { return whole.mirror.image[static_cast<std::size_t>(v)]; };
  for (const Quad& q : half.quads)
    whole.patch.quads.push_back({name(q[0]), name(q[3]), name(q[2]), name(q[1])});
  for (const Triangle& t : half.triangles)
    whole.patch.triangles.push_back({name(t[0]), name(t[2]), name(t[1])});
  return whole;
}

}  // namespace skinforge
