#include "stages/junction_report.h"

#include <numbers>

#include "report/distribution.h"
#include "surface/junction_measures.h"
#include "surface/symmetry_measures.h"

namespace skinforge {
namespace {

std::int64_t wide(std::size_t n) {
  return static_cast<std::int64_t>(n);
}

std::vector<double> in_degrees(std::vector<double> radians) {
  for (double& angle : radians) angle *= 180 / std::numbers::pi;
  return radians;
}

const char* name_of(JunctionRung rung) {
  switch (rung) {
    case JunctionRung::Tube:
      return "tube";
    case JunctionRung::Field:
      return "field";
    case JunctionRung::Bridge:
      return "bridge";
    case JunctionRung::Cap:
      return "cap";
    case JunctionRung::Strip:
      return "strip";
    case JunctionRung::None:
      return "none";
  }
  return "none";
}

SymmetryReport report_symmetry(const SurfaceResult& surface, std::size_t site) {
  const JunctionSymmetry& symmetry = surface.junctions[site].symmetry;
  SymmetryReport r;
  r.image_operation = symmetry.site + 1;
  r.reason = symmetry.reason;
  r.matched = symmetry.matched;
  const auto measures = measure_symmetry(surface.joined, surface.junctions, site);
  if (!measures) return r;
  const MirrorPlane& plane = symmetry.borders.plane;
  r.plane_normal = {plane.normal.x(), plane.normal.y(), plane.normal.z()};
  r.plane_offset = plane.offset;
  r.faces_symmetric = measures->faces_symmetric;
  r.mean_deviation = measures->mean;
  r.max_deviation = measures->max;
  r.border_deviation = measures->border_max;
  if (!r.faces_symmetric) r.reason = "this rung has no symmetric faces here";
  return r;
}

}  // namespace

JunctionReport report_junction(const SurfaceResult& surface, std::size_t site, const SiteField& field,
                               const ColorSteps& color) {
  const Junction& junction = surface.junctions[site];
  JunctionReport r;
  r.operation = wide(site + 1);
  r.rung = name_of(junction.rung);
  r.reason = junction.reason;
  r.voxel = junction.voxel;
  for (const JunctionLoop& loop : junction.loops) r.border_loops.push_back(wide(loop.vertices.size()));
  if (junction.is_empty()) return r;
  const bool on_field = junction.rung == JunctionRung::Tube || junction.rung == JunctionRung::Field;
  const JunctionMeasures m =
      measure_junction(surface.joined, static_cast<std::int32_t>(site), on_field ? &field.distance : nullptr);
  r.components = wide(m.components);
  r.faces = wide(m.faces);
  r.quads = wide(m.quads);
  r.triangles = wide(m.triangles);
  r.boundary_edges = wide(m.boundary_edges);
  for (const ArcStrip& strip : junction.strips) r.boundary_edges -= wide(strip.hem_edges);
  r.non_manifold_edges = wide(m.non_manifold_edges);
  r.degenerate_faces = wide(m.degenerate_faces);
  if (on_field) r.folded_faces = wide(m.folded_faces);
  r.self_intersections = wide(m.self_intersections);
  r.irregular_vertices = wide(m.irregular_vertices);
  r.scaled_jacobian = distribution_of(m.scaled_jacobian);
  r.deviation = distribution_of(m.deviation);
  r.edge_length_ratio = distribution_of(m.edge_length_ratio);
  if (color.edges > 0) r.border_color_step = {wide(color.edges), color.mean, color.p95, color.largest};
  r.border_dihedral = distribution_of(in_degrees(m.border_dihedral));
  r.border_normal_step = distribution_of(in_degrees(m.border_normal_step));
  r.symmetry = report_symmetry(surface, site);
  return r;
}

}  // namespace skinforge
