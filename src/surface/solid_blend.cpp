#include "surface/solid_blend.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "surface/fading.h"

namespace skinforge {
namespace {

// Where a part is cut off. Departure from junction.md d.2 (0.35): there an elbow of 90 degrees lost a third
// of its radius on the outside; here parts go on past the joint until they fill it.
constexpr double kTrimPresence = 0.15;
constexpr double kNearlyWhole = 0.8;  // ours: of presence; from here on a part comes to decide alone
constexpr double kTrimGrowth =
    3;  // ours: the trim grows the faster the less is present, so that absent parts are far
constexpr double kTrimRounding = 0.5;   // junction.md d.2: kappa, of the limb's radius
constexpr double kReplaceRadius = 1.2;  // junction.md d.2: k0, of the thinner limb's radius
const double kAligned = radians(20),
             kBent = radians(70);  // junction.md d.2: where auto begins and ends to change

double bend_of(const std::vector<FusionSolid>& solids) {
  Vec3 host = Vec3::Zero(), donor = Vec3::Zero();
  for (const FusionSolid& solid : solids)
    if (!solid.is_added) (solid.is_host ? host : donor) += fading_of(solid).axis;
  return bend_between(host, donor);
}

double squared(double x) {
  return x * x;
}

double smoothstep(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// Share of the trimmed parts in a replacement, where the more present of them has `presence`; the rest is Eq.
// 1, by which what is wholly present decides alone.
double trimmed_share(const SiteBlend& blend, double presence) {
  if (blend.op == BlendOperator::Paper || !(blend.replace_radius > 0)) return 0;
  const double bent = blend.op == BlendOperator::Auto ? smoothstep(kAligned, kBent, blend.bend) : 1;
  return bent * (1 - smoothstep(kNearlyWhole, 1, presence));
}

// Stands for the distance to the line where a part is cut off, in widths of its fading; C1 in presence.
double trim_distance(double presence) {
  const double missing = kTrimPresence - presence;
  return missing + kTrimGrowth * squared(std::max(missing, 0.0)) / kTrimPresence;
}

double trimmed(const SolidTrim& trim, const SolidSample& sample) {
  return smooth_max(sample.distance, trim_distance(sample.presence) * trim.width, trim.rounding);
}

double radius_at(const SiteBlend& blend, double radius, std::size_t first, std::size_t second,
                 const DirectionOf& direction) {
  if (blend.op == BlendOperator::Smin) return radius;
  return radius * fillet_share(direction(first), direction(second));
}

double replaced(const SiteBlend& blend, std::span<const SolidSample> samples, std::size_t first,
                std::size_t second, const DirectionOf& direction) {
  const SolidSample &a = samples[first], &b = samples[second];
  const double paper = blend_replace(a.distance, a.presence, b.distance, b.presence);
  const double share = trimmed_share(blend, a.presence);
  if (!(share > 0)) return paper;
  const double cut_a = trimmed(blend.trims[first], a), cut_b = trimmed(blend.trims[second], b);
  double radius = blend.replace_radius;
  if (std::abs(cut_a - cut_b) < radius) radius = radius_at(blend, radius, first, second, direction);
  return (1 - share) * paper + share * smooth_min(cut_a, cut_b, radius);
}

}  // namespace

SiteBlend site_blend(const std::vector<FusionSolid>& solids, const BlendOptions& options,
                     double union_radius) {
  SiteBlend blend{options.op, {}, bend_of(solids), 0, options.radius > 0 ? options.radius : union_radius};
  if (options.op == BlendOperator::Paper) blend.union_radius = 0;
  double thinnest = std::numeric_limits<double>::infinity(), narrowest = thinnest;
  for (const FusionSolid& solid : solids) {
    const double width = fading_of(solid).width(), radius = cut_girth(solid) / (2 * std::numbers::pi);
    // Where all is present the trim is that far inside: more rounding would move the surface.
    blend.trims.push_back(
        {solid.is_added, width, std::min(kTrimRounding * radius, -trim_distance(1) * width)});
    if (solid.is_added || !(width > 0) || !(radius > 0)) continue;
    thinnest = std::min(thinnest, radius);
    narrowest = std::min(narrowest, width);
  }
  if (std::isfinite(
          thinnest))  // where nothing is present the trim is that far outside: a wider fillet would reach it
    blend.replace_radius = std::min(options.radius > 0 ? options.radius : kReplaceRadius * thinnest,
                                    trim_distance(0) * narrowest);
  return blend;
}

double blend_samples(const SiteBlend& blend, std::span<const SolidSample> samples,
                     const DirectionOf& direction) {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::size_t first = kNone, second = kNone;
  for (std::size_t s = 0; s < samples.size(); ++s) {
    if (blend.trims[s].is_added) continue;
    if (first == kNone || samples[s].presence > samples[first].presence)
      second = first, first = s;
    else if (second == kNone || samples[s].presence > samples[second].presence)
      second = s;
  }
  double result = std::numeric_limits<double>::infinity();
  if (first != kNone)
    result = second != kNone ? replaced(blend, samples, first, second, direction) : samples[first].distance;
  std::size_t nearest = first;  // the solid whose surface `result` is
  for (std::size_t s = 0; s < samples.size(); ++s) {
    if (!blend.trims[s].is_added) continue;
    const double distance = samples[s].distance;
    double radius = blend.union_radius;
    if (nearest != kNone && std::abs(result - distance) < radius)
      radius = radius_at(blend, radius, nearest, s, direction);
    if (!(result < distance)) nearest = s;
    result = std::isinf(result) ? distance : smooth_min(result, distance, radius);
  }
  return result;
}

}  // namespace skinforge
