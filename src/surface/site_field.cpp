#include "surface/site_field.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/parallel.h"
#include "field/blend.h"
#include "field/source_distance.h"

namespace skinforge {
namespace {

using Box = Eigen::AlignedBox3d;

bool crosses(const FusionSolid& solid, const Triangle& t) {
  double low = 1, high = 0;
  for (const std::int32_t v : t)
    low = std::min(low, solid.presence[v]), high = std::max(high, solid.presence[v]);
  return low < 1 && high > 0;
}

// Triangles whose presence is neither wholly 1 nor wholly 0: where the cut runs.
Box cut_region(const FusionSolid& solid) {
  Box box;
  for (const Triangle& t : solid.triangles)
    if (crosses(solid, t))
      for (const std::int32_t v : t) box.extend(solid.positions[v]);
  return box;
}

double signed_distance(const FusionSolid& solid, const Vec3& p, double limit) {
  const ClosestPoint closest = solid.bvh.closest(p, limit);
  const double distance = closest.triangle < 0 ? limit : closest.distance;
  return solid.bvh.winding_number(p) > 0.5 ? -distance : distance;
}

// Where the surfaces of two solids come near each other.
void extend_by_contact(Box& box, const FusionSolid& of, const FusionSolid& other, double reach) {
  for (const Vec3& p : of.positions)
    if (signed_distance(other, p, reach) < reach) box.extend(p);
}

double mean_edge_in(const FusionSolid& solid, const Box& box) {
  double sum = 0, count = 0;
  for (const Triangle& t : solid.triangles) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 &a = solid.positions[t[k]], &b = solid.positions[t[(k + 1) % 3]];
      if (!box.contains(a) && !box.contains(b)) continue;
      sum += (b - a).norm();
      count += 1;
    }
  }
  return count > 0 ? sum / count : 0;
}

// Length of the line of presence 1/2: how far it is around the cut.
double cut_girth(const FusionSolid& solid) {
  double length = 0;
  for (const Triangle& t : solid.triangles) {
    std::array<Vec3, 3> crossing;
    int found = 0;
    for (int k = 0; k < 3; ++k) {
      const double a = solid.presence[t[k]] - 0.5, b = solid.presence[t[(k + 1) % 3]] - 0.5;
      if ((a < 0) == (b < 0)) continue;
      crossing[found++] =
          solid.positions[t[k]] + a / (a - b) * (solid.positions[t[(k + 1) % 3]] - solid.positions[t[k]]);
    }
    if (found == 2) length += (crossing[1] - crossing[0]).norm();
  }
  return length;
}

double choose_voxel(const std::vector<FusionSolid>& solids, const Box& box, const FieldOptions& options) {
  double edge = std::numeric_limits<double>::infinity(), girth = edge;
  for (const FusionSolid& solid : solids) {
    const double mean = mean_edge_in(solid, box), around = cut_girth(solid);
    if (mean > 0) edge = std::min(edge, mean);
    if (around > 0) girth = std::min(girth, around);
  }
  const double wanted =
      std::min(options.voxel_factor * edge, girth / (options.girth_voxels * std::numbers::pi));
  constexpr double kFinest = 0.25;  // ours: a tiny stray loop must not make the whole lattice fine
  return std::max(wanted, kFinest * options.voxel_factor * edge);
}

Lattice make_lattice(Box box, double voxel, const FieldOptions& options) {
  const double volume = (box.sizes().array() + 2 * options.margin_voxels * voxel).prod();
  const double least = std::cbrt(volume / static_cast<double>(options.max_points));
  Lattice lattice;
  lattice.voxel = std::max(voxel, least);
  const Vec3 margin = Vec3::Constant(options.margin_voxels * lattice.voxel);
  // Lattice planes at multiples of the voxel, so that a plane of symmetry through the origin is one of them.
  const Vec3 low = ((box.min() - margin) / lattice.voxel).array().floor();
  const Vec3 high = ((box.max() + margin) / lattice.voxel).array().ceil();
  lattice.origin = low * lattice.voxel;
  for (int axis = 0; axis < 3; ++axis)
    lattice.size[axis] = static_cast<std::int32_t>(high[axis] - low[axis]) + 1;
  return lattice;
}

// Eq. 1 at one point, from the distances and presences of all solids there.
double blend_values(BlendOperator blend, double fillet, std::span<const double> distance,
                    std::span<const double> presence) {
  if (distance.size() == 1) return distance[0];
  if (blend == BlendOperator::Union) {
    double result = distance[0];
    for (std::size_t s = 1; s < distance.size(); ++s) result = blend_union(result, distance[s], fillet);
    return result;
  }
  std::size_t first = 0, second = 1;
  if (presence[1] > presence[0]) std::swap(first, second);
  for (std::size_t s = 2; s < presence.size(); ++s) {
    if (presence[s] > presence[first])
      second = first, first = s;
    else if (presence[s] > presence[second])
      second = s;
  }
  return blend_replace(distance[first], presence[first], distance[second], presence[second]);
}

Box affected_region(const std::vector<FusionSolid>& solids, BlendOperator blend) {
  Box box;
  for (const FusionSolid& solid : solids) box.extend(cut_region(solid));
  if (blend != BlendOperator::Union || solids.size() < 2) return box;
  Box donor_box;
  for (const FusionSolid& solid : solids)
    if (!solid.is_host) donor_box.extend(cut_region(solid));
  const double reach = donor_box.isEmpty() ? 0 : 0.25 * donor_box.diagonal().norm();
  for (std::size_t i = 0; i < solids.size(); ++i)
    for (std::size_t j = 0; j < solids.size(); ++j)
      if (solids[i].is_host != solids[j].is_host && !solids[i].is_host)
        extend_by_contact(box, solids[i], solids[j], reach);
  return box;
}

}  // namespace

SiteField build_site_field(const std::vector<FusionSolid>& solids, BlendOperator blend,
                           const FieldOptions& options) {
  SiteField field;
  field.blend = blend;
  const Box box = affected_region(solids, blend);
  if (box.isEmpty()) return field;
  const double voxel = choose_voxel(solids, box, options);
  if (!(voxel > 0) || !std::isfinite(voxel)) return field;
  field.distance.lattice = make_lattice(box, voxel, options);
  const Lattice& lattice = field.distance.lattice;
  field.fillet = blend == BlendOperator::Union ? options.fillet_voxels * lattice.voxel : 0;
  field.band = options.band_voxels * lattice.voxel;
  std::vector<SourceSamples> samples;
  for (const FusionSolid& solid : solids)
    samples.push_back(sample_source(lattice, solid.bvh, solid.triangles, solid.presence, field.band));
  field.distance.values.resize(lattice.count());
  parallel_chunks(lattice.count(), 4096, [&](std::size_t begin, std::size_t end) {
    std::vector<double> distance(solids.size()), presence(solids.size());
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t s = 0; s < solids.size(); ++s)
        distance[s] = samples[s].distance[i], presence[s] = samples[s].presence[i];
      field.distance.values[i] = static_cast<float>(blend_values(blend, field.fillet, distance, presence));
    }
  });
  return field;
}

double blended_distance(const std::vector<FusionSolid>& solids, const SiteField& field, const Vec3& point) {
  std::vector<double> distance, presence;
  for (const FusionSolid& solid : solids) {
    const ClosestPoint closest = solid.bvh.closest(point, field.band);
    double p = 0;
    if (closest.triangle >= 0)
      for (int k = 0; k < 3; ++k)
        p += closest.barycentric[k] * solid.presence[solid.triangles[closest.triangle][k]];
    const double d = closest.triangle < 0 ? field.band : closest.distance;
    distance.push_back(solid.bvh.winding_number(point) > 0.5 ? -d : d);
    presence.push_back(p);
  }
  return blend_values(field.blend, field.fillet, distance, presence);
}

}  // namespace skinforge
