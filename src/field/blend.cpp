#include "field/blend.h"

#include <algorithm>
#include <cmath>

namespace skinforge {
namespace {
constexpr double kAbsent = 0.001, kPresent = 0.999;  // the reference's branch limits, here the ends of a ramp
constexpr double kBothPresent = 0.8;  // ours: from here on two present parts begin to count as a union
}  // namespace

double presence_weight(double presence) {
  const double t = std::clamp((presence - kAbsent) / (kPresent - kAbsent), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

double blend_replace(double distance0, double presence0, double distance1, double presence1) {
  const double w0 = presence_weight(presence0), w1 = presence_weight(presence1);
  // w / (1 - w) of both, over a common denominator: a source that is wholly present decides alone.
  const double share0 = w0 * (1 - w1), share1 = w1 * (1 - w0), sum = share0 + share1;
  const double nearer = std::min(distance0, distance1);
  const double mean = sum > 0 ? (share0 * distance0 + share1 * distance1) / sum : (distance0 + distance1) / 2;
  const double both = presence_weight((std::min(presence0, presence1) - kBothPresent) / (1 - kBothPresent));
  return (1 - both) * mean + both * nearer;  // Eq. 1, replacement, where at most one source is wholly present
}

double smooth_min(double distance0, double distance1, double radius) {
  const double least = std::min(distance0, distance1);
  if (!(radius > 0)) return least;
  const double x = std::max(radius - std::abs(distance0 - distance1), 0.0) / radius;
  return least - radius * x * x * x / 6;
}

double smooth_max(double distance0, double distance1, double radius) {
  return -smooth_min(-distance0, -distance1, radius);
}

double fillet_share(const Vec3& normal0, const Vec3& normal1) {
  constexpr double kLeast = 0.05;
  return std::clamp(1 - normal0.dot(normal1), kLeast, 1.0);
}

}  // namespace skinforge
