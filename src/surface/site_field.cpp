#include "surface/site_field.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/parallel.h"
#include "field/source_distance.h"
#include "surface/fading.h"

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

// Faces of the hosts of an added part in the region, and one ring of faces around them: what may be given up
// for it (`PreserveOptions::added_rings`).
Box given_up_region(const std::vector<FusionSolid>& solids, const Box& region) {
  Box box = region;
  if (std::none_of(solids.begin(), solids.end(), [](const FusionSolid& s) { return s.is_added; })) return box;
  for (const FusionSolid& host : solids) {
    if (!host.is_host) continue;
    std::vector<char> reached(host.positions.size(), 0);
    for (std::size_t v = 0; v < reached.size(); ++v) reached[v] = region.contains(host.positions[v]);
    for (int ring = 0; ring < 2; ++ring) {
      const std::vector<char> before = reached;
      for (const Triangle& t : host.triangles)
        if (std::any_of(t.begin(), t.end(), [&](std::int32_t v) { return before[v] != 0; }))
          for (const std::int32_t v : t) reached[v] = 1;
    }
    for (std::size_t v = 0; v < reached.size(); ++v)
      if (reached[v]) box.extend(host.positions[v]);
  }
  return box;
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

double choose_voxel(const std::vector<FusionSolid>& solids, const Box& box, const FieldOptions& options) {
  if (options.voxel > 0) return options.voxel;
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

// Unit direction in which a sampled distance grows at a lattice point; zero where it does not.
Vec3 direction_at(const Lattice& lattice, const std::vector<float>& distance, std::size_t i) {
  const std::array<std::size_t, 3> stride = {1, static_cast<std::size_t>(lattice.size[0]),
                                             static_cast<std::size_t>(lattice.size[0]) * lattice.size[1]};
  Vec3 gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t place = i / stride[axis] % static_cast<std::size_t>(lattice.size[axis]);
    const std::size_t low = place > 0 ? i - stride[axis] : i;
    const std::size_t high = place + 1 < static_cast<std::size_t>(lattice.size[axis]) ? i + stride[axis] : i;
    gradient[axis] = static_cast<double>(distance[high]) - static_cast<double>(distance[low]);
  }
  const double norm = gradient.norm();
  return norm > 0 ? Vec3(gradient / norm) : Vec3(Vec3::Zero());
}

// The same by exact queries, a voxel to either side as on the lattice.
Vec3 direction_at(const FusionSolid& solid, const Vec3& point, const SiteField& field) {
  Vec3 gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 step = field.voxel() * Vec3::Unit(axis);
    gradient[axis] =
        signed_distance(solid, point + step, field.band) - signed_distance(solid, point - step, field.band);
  }
  const double norm = gradient.norm();
  return norm > 0 ? Vec3(gradient / norm) : Vec3(Vec3::Zero());
}

}  // namespace

Eigen::AlignedBox3d affected_region(const std::vector<FusionSolid>& solids) {
  Box box;
  for (const FusionSolid& solid : solids) {
    const Box cut = cut_region(solid);
    box.extend(cut);
    if (!solid.is_added || cut.isEmpty()) continue;
    const double reach =
        0.25 * cut.diagonal().norm();  // ours: a limb enters its host within a quarter of its own root's size
    for (const FusionSolid& host : solids)
      if (host.is_host) extend_by_contact(box, solid, host, reach);
  }
  return box;
}

Lattice field_lattice(const std::vector<FusionSolid>& solids, const FieldOptions& options) {
  const Box box = affected_region(solids);
  if (box.isEmpty()) return {};
  const double voxel = choose_voxel(solids, box, options);
  if (!(voxel > 0) || !std::isfinite(voxel)) return {};
  return make_lattice(given_up_region(solids, box), voxel, options);
}

LatticeCost lattice_cost(const std::vector<FusionSolid>& solids, const FieldOptions& options) {
  const Box region = affected_region(solids);
  if (region.isEmpty()) return {};
  const double voxel = choose_voxel(solids, region, options);
  if (!(voxel > 0) || !std::isfinite(voxel)) return {};
  const Box box = given_up_region(solids, region);
  const double points = (box.sizes().array() / voxel + 2 * options.margin_voxels + 2).prod();
  constexpr double kSample = 8, kResult = 4;  // distance and presence of each solid; what the blend gives
  constexpr double kSampling = 9;             // cubes and corners of one solid at a time
  constexpr double kGrid = 12;                // ours: the tree that OpenVDB makes of it, and its file
  return {points, points * (kSample * static_cast<double>(solids.size()) + kSampling + kResult + kGrid)};
}

namespace {

// Where parts are only added, the surface of their union never runs inside of one of them, and another
// matters only where it is nearer than the fillet is wide; so little is asked beyond that. Elsewhere parts
// are weighed against each other, and the surface may run far from one of them.
SamplingReach reach_of(const SiteField& field) {
  const auto& trims = field.blend.trims;
  if (std::count_if(trims.begin(), trims.end(), [](const SolidTrim& t) { return !t.is_added; }) > 1)
    return {};
  constexpr double kGradient = 2;  // ours: voxels; where the fillet ends directions are still asked for
  constexpr double kPairs = 4, kFours = 8;  // ours: voxels; the surface and its gradient need two
  const double fillet = field.blend.union_radius / field.voxel() + kGradient;
  return {.pairs_outside = std::max(kPairs, fillet),
          .pairs_inside = kPairs,
          .fours_outside = std::max(kFours, fillet),
          .fours_inside = kFours};
}

}  // namespace

SiteField build_site_field(const std::vector<FusionSolid>& solids, const FieldOptions& options) {
  SiteField field;
  field.distance.lattice = field_lattice(solids, options);
  const Lattice& lattice = field.distance.lattice;
  if (lattice.count() == 0) return field;
  field.blend = site_blend(solids, options.blend, options.fillet_voxels * lattice.voxel);
  field.band = options.band_voxels * lattice.voxel;
  std::vector<SourceSamples> sources;
  for (const FusionSolid& solid : solids)
    sources.push_back(sample_source(lattice, solid.bvh, solid.triangles, solid.presence, options.band_voxels,
                                    reach_of(field)));
  field.distance.values.resize(lattice.count());
  parallel_chunks(lattice.count(), 4096, [&](std::size_t begin, std::size_t end) {
    std::vector<SolidSample> samples(solids.size());
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t s = 0; s < solids.size(); ++s)
        samples[s] = {lattice.voxel * sources[s].distance[i], sources[s].presence[i]};
      const auto direction = [&](std::size_t s) { return direction_at(lattice, sources[s].distance, i); };
      field.distance.values[i] =
          static_cast<float>(blend_samples(field.blend, samples, direction) / lattice.voxel);
    }
  });
  return field;
}

double blended_distance(const std::vector<FusionSolid>& solids, const SiteField& field, const Vec3& point) {
  std::vector<SolidSample> samples;
  for (const FusionSolid& solid : solids) {
    const ClosestPoint closest = solid.bvh.closest(point, field.band);
    double presence = 0;
    if (closest.triangle >= 0)
      for (int k = 0; k < 3; ++k)
        presence += closest.barycentric[k] * solid.presence[solid.triangles[closest.triangle][k]];
    const double distance = closest.triangle < 0 ? field.band : closest.distance;
    samples.push_back({solid.bvh.winding_number(point) > 0.5 ? -distance : distance, presence});
  }
  return blend_samples(field.blend, samples,
                       [&](std::size_t s) { return direction_at(solids[s], point, field); });
}

}  // namespace skinforge
