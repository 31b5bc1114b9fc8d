#pragma once

#include <string>

#include "field/signed_distance.h"
#include "surface/fusion_solid.h"

namespace skinforge {

/// How two distances become one (Eq. 1).
enum class BlendOperator : std::uint8_t {
  Blend,  ///< weighted by presence: replacements
  Union,  ///< the nearer solid, with a small fillet: additions
};

struct FieldOptions {
  double voxel_factor = 0.8;  ///< Sec. 6.1: times the lesser mean edge length
  double girth_voxels = 8;    ///< junction.md b.0: a loop is at least pi times this many voxels around
  double fillet_voxels = 3;   ///< junction.md d.2: radius of the smooth minimum in a union; 0 = sharp
  double margin_voxels = 5;   ///< ours: the lattice reaches this far beyond the affected region
  double band_voxels = 30;    ///< distances are cut at this many voxels
  std::size_t max_points = 4'000'000;  ///< ours: a larger lattice gets a larger voxel

  template <class Archive>
  friend void fields(Archive& a, FieldOptions& o) {
    a(o.voxel_factor, o.girth_voxels, o.fillet_voxels, o.margin_voxels, o.band_voxels, o.max_points);
  }
};

/// The field of one site with the operator it was made by.
struct SiteField {
  DistanceField distance;  ///< delta_R; empty lattice when there is nothing to blend
  BlendOperator blend = BlendOperator::Blend;
  double fillet = 0;  ///< metres
  double band = 0;    ///< metres

  bool is_empty() const { return distance.values.empty(); }
  double voxel() const { return distance.lattice.voxel; }

  template <class Archive>
  friend void fields(Archive& a, SiteField& f) {
    a(f.distance, f.blend, f.fillet, f.band);
  }
};

/// Samples the solids of one site in the region that the operation affects (SkinMixer Sec. 6.1) and blends
/// them by Eq. 1; with more than two solids each point follows the two of highest presence. Region: all
/// vertices that are neither wholly present nor wholly absent and the faces between 0 and 1; for a union also
/// where the solids meet. Empty when no solid has anything there.
SiteField build_site_field(const std::vector<FusionSolid>& solids, BlendOperator blend,
                           const FieldOptions& options);

/// delta_R at one point by exact queries, as `build_site_field` samples it.
double blended_distance(const std::vector<FusionSolid>& solids, const SiteField& field, const Vec3& point);

}  // namespace skinforge
