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

// What one solid says about one point.
struct Sample {
  double distance = 0, presence = 0;
  bool is_added = false;
};

// Eq. 1 at one point: replacement by the two of highest presence, then addition.
double blend_samples(std::span<const Sample> samples, double fillet) {
  const Sample *first = nullptr, *second = nullptr;
  for (const Sample& s : samples) {
    if (s.is_added) continue;
    if (!first || s.presence > first->presence)
      second = first, first = &s;
    else if (!second || s.presence > second->presence)
      second = &s;
  }
  double result = std::numeric_limits<double>::infinity();
  if (first)
    result = second ? blend_replace(first->distance, first->presence, second->distance, second->presence)
                    : first->distance;
  for (const Sample& s : samples)
    if (s.is_added) result = std::isinf(result) ? s.distance : blend_union(result, s.distance, fillet);
  return result;
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
  return make_lattice(box, voxel, options);
}

SiteField build_site_field(const std::vector<FusionSolid>& solids, const FieldOptions& options) {
  SiteField field;
  field.distance.lattice = field_lattice(solids, options);
  const Lattice& lattice = field.distance.lattice;
  if (lattice.count() == 0) return field;
  field.fillet = options.fillet_voxels * lattice.voxel;
  field.band = options.band_voxels * lattice.voxel;
  std::vector<SourceSamples> sources;
  for (const FusionSolid& solid : solids)
    sources.push_back(sample_source(lattice, solid.bvh, solid.triangles, solid.presence, field.band));
  field.distance.values.resize(lattice.count());
  parallel_chunks(lattice.count(), 4096, [&](std::size_t begin, std::size_t end) {
    std::vector<Sample> samples(solids.size());
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t s = 0; s < solids.size(); ++s)
        samples[s] = {sources[s].distance[i], sources[s].presence[i], solids[s].is_added};
      field.distance.values[i] = static_cast<float>(blend_samples(samples, field.fillet));
    }
  });
  return field;
}

double blended_distance(const std::vector<FusionSolid>& solids, const SiteField& field, const Vec3& point) {
  std::vector<Sample> samples;
  for (const FusionSolid& solid : solids) {
    const ClosestPoint closest = solid.bvh.closest(point, field.band);
    double presence = 0;
    if (closest.triangle >= 0)
      for (int k = 0; k < 3; ++k)
        presence += closest.barycentric[k] * solid.presence[solid.triangles[closest.triangle][k]];
    const double distance = closest.triangle < 0 ? field.band : closest.distance;
    samples.push_back(
        {solid.bvh.winding_number(point) > 0.5 ? -distance : distance, presence, solid.is_added});
  }
  return blend_samples(samples, field.fillet);
}

}  // namespace skinforge
