#pragma once

#include <functional>
#include <span>
#include <vector>

#include "base/math.h"
#include "field/blend.h"
#include "surface/fusion_solid.h"

namespace skinforge {

struct BlendOptions {
  BlendOperator op = BlendOperator::Auto;
  double radius = 0;  ///< of the fillet, metres; 0: from the parts (replacement) or three voxels (union)

  auto operator<=>(const BlendOptions&) const = default;
  template <class Archive>
  friend void fields(Archive& a, BlendOptions& o) {
    a(o.op, o.radius);
  }
};

/// How one solid is cut off softly where little of it is present.
struct SolidTrim {
  bool is_added = false;
  double width = 0;  ///< metres over which its presence goes from 0 to 1
  double rounding =
      0;  ///< metres; of the smooth maximum with the trim, small enough to leave presence 1 as it is

  template <class Archive>
  friend void fields(Archive& a, SolidTrim& t) {
    a(t.is_added, t.width, t.rounding);
  }
};

/// All that is needed to blend what the solids of a site say about a point.
struct SiteBlend {
  BlendOperator op = BlendOperator::Auto;
  std::vector<SolidTrim> trims;  ///< per solid
  double bend = 0;               ///< radians between the axes along which the replaced parts fade
  double replace_radius = 0;     ///< metres; of the fillet between trimmed parts
  double union_radius = 0;       ///< metres

  template <class Archive>
  friend void fields(Archive& a, SiteBlend& b) {
    a(b.op, b.trims, b.bend, b.replace_radius, b.union_radius);
  }
};

/// Measures the solids: how wide each fades, how thick it is there, and at what angle the parts that replace
/// each other meet. `union_radius`: metres, where `options` leaves it open.
SiteBlend site_blend(const std::vector<FusionSolid>& solids, const BlendOptions& options,
                     double union_radius);

/// What one solid says about one point.
struct SolidSample {
  double distance = 0;  ///< delta_k, metres
  double presence = 0;  ///< p_k at the nearest point
};

/// Unit gradient of the distance of one solid at the point in question; zero where it has none.
using DirectionOf = std::function<Vec3(std::size_t solid)>;

/// delta_R at one point, metres: of those that fade by presence the two of highest presence are blended (Eq.
/// 1 and Sec. 6.1, last paragraph, or the operator of junction.md d.2), then the added ones are united with
/// that.
double blend_samples(const SiteBlend& blend, std::span<const SolidSample> samples,
                     const DirectionOf& direction);

}  // namespace skinforge
