#include "surface/field_junction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "surface/best_tube.h"
#include "surface/borders.h"
#include "surface/remesh.h"
#include "surface/trim.h"

namespace skinforge {
namespace {

double mean_border_edge(const std::vector<JunctionLoop>& loops) {
  double length = 0, edges = 0;
  for (const JunctionLoop& loop : loops)
    length += loop_length(loop.positions), edges += static_cast<double>(loop.positions.size());
  return length / edges;
}

// Free vertices onto delta_R = 0 by Newton steps, each at most half a voxel; far off ones stay. The gradient
// of a distance has length 1, and less near a medial sheet: there the steps are shorter than Newton's, which
// would throw a vertex farther the less its direction is known.
Projection onto_field(const DistanceField& field) {
  static constexpr double kLeastSquared = 0.5;     // ours: of the gradient
  const double near = 1e-5 * field.lattice.voxel;  // ours: where equal inputs at two scales still agree
  return [&field, near](const Vec3& start) {
    Vec3 p = start;
    for (int step = 0; step < 3; ++step) {
      const double value = field.at(p);
      if (std::abs(value) < near) break;
      const Vec3 gradient = field.gradient(p);
      Vec3 move = -value / std::max(gradient.squaredNorm(), kLeastSquared) * gradient;
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

double squared_distance(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - (a + t * along)).squaredNorm();
}

Facing facing_border(const std::vector<Vec3>& ring, const std::vector<JunctionLoop>& loops, double reach) {
  std::vector<int> votes(loops.size(), 0);
  double sum = 0;
  for (const Vec3& p : ring) {
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t best = 0;
    for (std::size_t l = 0; l < loops.size(); ++l) {
      const std::vector<Vec3>& q = loops[l].positions;
      for (std::size_t i = 0; i < q.size(); ++i) {
        const double distance = squared_distance(p, q[i], q[(i + 1) % q.size()]);
        if (distance < nearest) nearest = distance, best = l;
      }
    }
    ++votes[best];
    sum += std::sqrt(nearest);
  }
  if (sum > reach * static_cast<double>(ring.size())) return {};
  const auto most = std::max_element(votes.begin(), votes.end());
  return {static_cast<int>(most - votes.begin()), loop_length(ring)};
}

// The isosurface clear of the preserved faces by `clearance`.
TrianglePatch trimmed_surface(const IsoSurface& surface, const KeptSurface& kept, double clearance) {
  std::vector<double> value;
  for (const Vec3& p : surface.positions) {
    const ClosestPoint closest = kept.bvh.closest(p, 2 * clearance);
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

}  // namespace

FieldJunction::FieldJunction(const std::vector<JunctionLoop>& loops, const SiteField& field,
                             const KeptSurface& kept)
    : loops_(loops), field_(field), kept_(kept), surface_(extract_iso_surface(field.distance)) {}

std::optional<TrianglePatch> FieldJunction::zipped(double clearance, std::string& fault) const {
  const double widest = std::max(0.75 * field_.voxel(), 0.5 * mean_border_edge(loops_));  // junction.md b.1
  const Trimmed trimmed =
      match_rings(trimmed_surface(surface_, kept_, clearance * widest), loops_, 3 * widest);
  fault = fault_of(trimmed, loops_);
  if (!fault.empty()) return std::nullopt;
  return zip_to_borders(trimmed, lay_borders(loops_), field_.distance);
}

TrianglePatch FieldJunction::remeshed(const TrianglePatch& zipped, double length_scale) const {
  return remesh(zipped, onto_field(field_.distance), {.length_scale = length_scale});
}

std::optional<QuadPatch> FieldJunction::tube(const PatchPart& part, std::string& fault,
                                             const PatchMirror* borders) const {
  std::vector<JunctionLoop> loops;
  for (const std::size_t l : part.loops) loops.push_back(loops_[l]);
  const WantedSurface surface{onto_field(field_.distance),
                              [&](const Vec3& p) { return field_.distance.gradient(p); },
                              [&](const Vec3& p) { return field_.distance.at(p); }, field_.voxel()};
  return best_tube(part.patch, {loops, field_.distance, surface, kept_}, fault, borders);
}

}  // namespace skinforge
