#include "surface/junction.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <set>

#include "surface/remesh.h"
#include "surface/ring_zip.h"
#include "surface/trim.h"

namespace skinforge {
namespace {

using IndexLoop = std::vector<std::int32_t>;

// The fixed vertices of a patch are those of the loops, loop after loop.
struct Borders {
  std::vector<IndexLoop> loops;  // indices into the patch
  TrianglePatch patch;           // fixed vertices, no triangles yet
};

Borders lay_borders(const std::vector<JunctionLoop>& loops) {
  Borders borders;
  for (const JunctionLoop& loop : loops) {
    IndexLoop indices;
    for (const Vec3& p : loop.positions) {
      indices.push_back(static_cast<std::int32_t>(borders.patch.positions.size()));
      borders.patch.positions.push_back(p);
    }
    borders.loops.push_back(std::move(indices));
  }
  borders.patch.fixed = borders.patch.positions.size();
  return borders;
}

std::vector<Vec3> positions_of(const TrianglePatch& patch, const IndexLoop& loop) {
  std::vector<Vec3> positions;
  for (const std::int32_t v : loop) positions.push_back(patch.positions[v]);
  return positions;
}

double mean_border_edge(const std::vector<JunctionLoop>& loops) {
  double length = 0, edges = 0;
  for (const JunctionLoop& loop : loops)
    length += loop_length(loop.positions), edges += static_cast<double>(loop.positions.size());
  return length / edges;
}

void add_zip(TrianglePatch& patch, const IndexLoop& border, const IndexLoop& ring,
             const OutwardDirection& outward) {
  for (const Triangle& t : zip_rings(positions_of(patch, border), positions_of(patch, ring), outward)) {
    const auto vertex = [&](std::int32_t i) {
      const auto n = static_cast<std::int32_t>(border.size());
      return i < n ? border[i] : ring[i - n];
    };
    patch.triangles.push_back({vertex(t[0]), vertex(t[1]), vertex(t[2])});
  }
}

void add_fill(TrianglePatch& patch, const IndexLoop& loop) {
  for (const Triangle& t : fill_loop(positions_of(patch, loop)))
    patch.triangles.push_back({loop[t[0]], loop[t[1]], loop[t[2]]});
}

std::vector<Support> supports_of(const std::vector<JunctionLoop>& loops) {
  std::vector<Support> supports;
  std::int32_t fixed = 0;
  for (const JunctionLoop& loop : loops) {
    for (const auto& inward : loop.inward) {
      for (const Vec3& p : inward) supports.push_back({fixed, p});
      ++fixed;
    }
  }
  return supports;
}

// Free vertices onto delta_R = 0 by Newton steps, each at most half a voxel; far off ones stay.
Projection onto_field(const DistanceField& field) {
  return [&field](const Vec3& start) {
    Vec3 p = start;
    for (int step = 0; step < 3; ++step) {
      const double value = field.at(p);
      const Vec3 gradient = field.gradient(p);
      const double squared = gradient.squaredNorm();
      if (!(squared > 1e-4)) break;  // the gradient of a distance has length 1; near 0 lies a medial sheet
      Vec3 move = -value / squared * gradient;
      const double longest = 0.5 * field.lattice.voxel;
      if (move.norm() > longest) move *= longest / move.norm();
      p += move;
    }
    return p;
  };
}

// Which border a boundary loop of the trimmed surface faces: the one nearest to most of its vertices, if it
// runs close along it.
struct Facing {
  int border = -1;
  double length = 0;
};

Facing facing_border(const std::vector<Vec3>& ring, const std::vector<JunctionLoop>& loops, double reach) {
  std::vector<int> votes(loops.size(), 0);
  double sum = 0;
  for (const Vec3& p : ring) {
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t best = 0;
    for (std::size_t l = 0; l < loops.size(); ++l)
      for (const Vec3& q : loops[l].positions)
        if ((p - q).squaredNorm() < nearest) nearest = (p - q).squaredNorm(), best = l;
    ++votes[best];
    sum += std::sqrt(nearest);
  }
  if (sum > reach * static_cast<double>(ring.size())) return {};
  const auto most = std::max_element(votes.begin(), votes.end());
  return {static_cast<int>(most - votes.begin()), loop_length(ring)};
}

// The isosurface clear of the preserved faces by `clearance`.
TrianglePatch trimmed_surface(const IsoSurface& surface, const TriangleBvh& kept, double clearance) {
  std::vector<double> value;
  for (const Vec3& p : surface.positions) {
    const ClosestPoint closest = kept.closest(p, 2 * clearance);
    value.push_back((closest.triangle < 0 ? 2 * clearance : closest.distance) - clearance);
  }
  return trim_positive(surface, value);
}

// A trimmed isosurface whose boundary loops are told apart.
struct Trimmed {
  TrianglePatch surface;
  std::vector<IndexLoop> rings;     // all boundary loops
  std::vector<int> ring_of_border;  // per border: its ring, -1 when it has none
  std::vector<std::int32_t> component_of_triangle;
  std::vector<std::int32_t> component_of_ring;
};

Trimmed match_rings(TrianglePatch surface, const std::vector<JunctionLoop>& loops, double reach) {
  Trimmed t{std::move(surface), {}, std::vector<int>(loops.size(), -1), {}, {}};
  t.rings = boundary_loops(t.surface.triangles);
  t.component_of_triangle = triangle_components(t.surface.triangles, t.surface.positions.size()).first;
  std::vector<std::int32_t> component_of_vertex(t.surface.positions.size(), -1);
  for (std::size_t i = 0; i < t.surface.triangles.size(); ++i)
    for (const std::int32_t v : t.surface.triangles[i]) component_of_vertex[v] = t.component_of_triangle[i];
  std::vector<double> longest(loops.size(), 0);
  for (std::size_t r = 0; r < t.rings.size(); ++r) {
    t.component_of_ring.push_back(component_of_vertex[t.rings[r][0]]);
    const Facing facing = facing_border(positions_of(t.surface, t.rings[r]), loops, reach);
    if (facing.border < 0 || facing.length <= longest[facing.border] || t.rings[r].size() < 3) continue;
    longest[facing.border] = facing.length;
    t.ring_of_border[facing.border] = static_cast<int>(r);
  }
  return t;
}

// Why the trimmed surface cannot serve; empty when it can: every border has its ring, and a host is joined to
// a donor.
std::string fault_of(const Trimmed& t, const std::vector<JunctionLoop>& loops) {
  std::set<std::int32_t> host_components, donor_components;
  for (std::size_t l = 0; l < loops.size(); ++l) {
    if (t.ring_of_border[l] < 0)
      return fmt::format("the blended surface leaves border {} of {} without a ring", l + 1, loops.size());
    (loops[l].is_host ? host_components : donor_components).insert(t.component_of_ring[t.ring_of_border[l]]);
  }
  for (const std::int32_t c : host_components)
    if (donor_components.contains(c)) return {};
  return "the blended surface does not join the two sides";
}

TrianglePatch zip_to_borders(const Trimmed& t, Borders borders, const DistanceField& field) {
  TrianglePatch patch = std::move(borders.patch);
  const auto offset = static_cast<std::int32_t>(patch.positions.size());
  patch.positions.insert(patch.positions.end(), t.surface.positions.begin(), t.surface.positions.end());
  std::set<std::int32_t> components, used;
  for (const int r : t.ring_of_border) components.insert(t.component_of_ring[r]), used.insert(r);
  for (std::size_t i = 0; i < t.surface.triangles.size(); ++i) {
    const Triangle& s = t.surface.triangles[i];
    if (components.contains(t.component_of_triangle[i]))
      patch.triangles.push_back({s[0] + offset, s[1] + offset, s[2] + offset});
  }
  const auto shifted = [&](std::size_t r) {
    IndexLoop ring = t.rings[r];
    for (std::int32_t& v : ring) v += offset;
    return ring;
  };
  const OutwardDirection outward = [&](const Vec3& p) { return field.gradient(p); };
  for (std::size_t l = 0; l < borders.loops.size(); ++l)
    add_zip(patch, borders.loops[l], shifted(t.ring_of_border[l]), outward);
  for (std::size_t r = 0; r < t.rings.size(); ++r) {
    if (used.contains(static_cast<std::int32_t>(r)) || !components.contains(t.component_of_ring[r])) continue;
    IndexLoop ring = shifted(r);
    std::reverse(ring.begin(), ring.end());
    add_fill(patch, ring);
  }
  return without_unused_vertices(patch);
}

std::optional<TrianglePatch> patch_from_field(const std::vector<JunctionLoop>& loops, const SiteField& field,
                                              const TriangleBvh& kept, std::string& fault) {
  const IsoSurface surface = extract_iso_surface(field.distance);
  const double widest = std::max(0.75 * field.voxel(), 0.5 * mean_border_edge(loops));  // junction.md b.1
  for (const double share : {1.0, 0.5, 0.25}) {
    const double clearance = share * widest;
    const Trimmed trimmed = match_rings(trimmed_surface(surface, kept, clearance), loops, 3 * widest);
    const std::string found = fault_of(trimmed, loops);
    if (fault.empty()) fault = found;
    if (!found.empty()) continue;
    fault.clear();
    return remesh(zip_to_borders(trimmed, lay_borders(loops), field.distance), onto_field(field.distance));
  }
  return std::nullopt;
}

Vec3 centre_of(const JunctionLoop& loop) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : loop.positions) sum += p;
  return sum / static_cast<double>(loop.positions.size());
}

// Host and donor borders in pairs, nearest centres first; what stays single is capped.
std::vector<std::pair<std::size_t, std::size_t>> nearest_pairs(const std::vector<JunctionLoop>& loops) {
  std::vector<std::pair<double, std::pair<std::size_t, std::size_t>>> candidates;
  for (std::size_t i = 0; i < loops.size(); ++i)
    for (std::size_t j = 0; j < loops.size(); ++j)
      if (loops[i].is_host && !loops[j].is_host)
        candidates.push_back({(centre_of(loops[i]) - centre_of(loops[j])).norm(), {i, j}});
  std::stable_sort(candidates.begin(), candidates.end());
  std::set<std::size_t> taken;
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const auto& [distance, pair] : candidates) {
    if (taken.contains(pair.first) || taken.contains(pair.second)) continue;
    taken.insert({pair.first, pair.second});
    pairs.push_back(pair);
  }
  return pairs;
}

TrianglePatch bridge_or_cap(const std::vector<JunctionLoop>& loops) {
  Borders borders = lay_borders(loops);
  TrianglePatch patch = std::move(borders.patch);
  std::set<std::size_t> joined;
  for (const auto& [host, donor] : nearest_pairs(loops)) {
    IndexLoop ring = borders.loops[donor];
    std::reverse(ring.begin(),
                 ring.end());  // new faces run along a border; a zip wants its second ring the other way
    add_zip(patch, borders.loops[host], ring, nullptr);
    joined.insert({host, donor});
  }
  for (std::size_t l = 0; l < loops.size(); ++l)
    if (!joined.contains(l)) add_fill(patch, borders.loops[l]);
  return fair(remesh(patch, nullptr), supports_of(loops));
}

}  // namespace

Junction build_junction(std::vector<JunctionLoop> loops, const SiteField& field, const TriangleBvh& kept) {
  Junction junction;
  junction.loops = std::move(loops);
  junction.voxel = field.is_empty() ? 0 : field.voxel();
  if (junction.loops.empty()) {
    junction.reason = "no cut loop: the parts are joined rigidly";
    return junction;
  }
  const auto is_host = [](const JunctionLoop& l) { return l.is_host; };
  const bool has_host = std::any_of(junction.loops.begin(), junction.loops.end(), is_host);
  const bool has_donor = !std::all_of(junction.loops.begin(), junction.loops.end(), is_host);
  if (has_host && has_donor && !field.is_empty()) {
    if (auto patch = patch_from_field(junction.loops, field, kept, junction.reason)) {
      junction.patch = std::move(*patch);
      junction.rung = JunctionRung::Field;
      return junction;
    }
  }
  junction.patch = bridge_or_cap(junction.loops);
  junction.rung = has_host && has_donor ? JunctionRung::Bridge : JunctionRung::Cap;
  return junction;
}

}  // namespace skinforge
