#pragma once

#include <Eigen/Geometry>

#include "field/signed_distance.h"
#include "surface/solid_blend.h"

namespace skinforge {

struct FieldOptions {
  double voxel_factor = 0.8;  ///< Sec. 6.1: times the lesser mean edge length
  double voxel = 0;           ///< metres; taken as it is where above 0, without regard to edges and girths
  double girth_voxels = 8;    ///< junction.md b.0: a loop is at least pi times this many voxels around
  double fillet_voxels = 3;   ///< junction.md d.2: radius of the fillet in a union
  BlendOptions blend = {};
  double margin_voxels = 5;            ///< ours: the lattice reaches this far beyond the affected region
  double band_voxels = 30;             ///< distances are cut at this many voxels
  std::size_t max_points = 4'000'000;  ///< ours: a larger lattice gets a larger voxel

  template <class Archive>
  friend void fields(Archive& a, FieldOptions& o) {
    a(o.voxel_factor, o.voxel, o.girth_voxels, o.fillet_voxels, o.blend, o.margin_voxels, o.band_voxels,
      o.max_points);
  }
};

/// The field of one junction: of one site, or of several whose regions run into each other.
struct SiteField {
  DistanceField distance;  ///< delta_R; empty lattice when there is nothing to blend
  SiteBlend blend;
  double band = 0;  ///< metres

  bool is_empty() const { return distance.values.empty(); }
  double voxel() const { return distance.lattice.voxel; }

  template <class Archive>
  friend void fields(Archive& a, SiteField& f) {
    a(f.distance, f.blend, f.band);
  }
};

/// The region that the solids affect (SkinMixer Sec. 6.1): all faces between presence 0 and 1, and where an
/// added solid meets a host. Empty when nothing is affected.
Eigen::AlignedBox3d affected_region(const std::vector<FusionSolid>& solids);

/// The lattice on which `build_site_field` samples; without points when nothing is affected.
Lattice field_lattice(const std::vector<FusionSolid>& solids, const FieldOptions& options);

/// How many points the lattice would have without `max_points`, and how many bytes `build_site_field` takes
/// for them at its height. In doubles: a voxel may be as small as it likes.
struct LatticeCost {
  double points = 0, bytes = 0;
};
LatticeCost lattice_cost(const std::vector<FusionSolid>& solids, const FieldOptions& options);

/// Samples the solids in the affected region and blends them by Eq. 1: of those that fade by presence each
/// point follows the two of highest presence (Sec. 6.1, last paragraph), then the added ones are united with
/// that. Empty when nothing is affected.
SiteField build_site_field(const std::vector<FusionSolid>& solids, const FieldOptions& options);

/// delta_R at one point by exact queries, as `build_site_field` samples it.
double blended_distance(const std::vector<FusionSolid>& solids, const SiteField& field, const Vec3& point);

}  // namespace skinforge
