#include "field/blend.h"

#include <algorithm>
#include <cmath>

namespace skinforge {
namespace {
constexpr double kAbsent = 0.001, kPresent = 0.999;  // the reference's branch limits, here the ends of a ramp
}

double presence_weight(double presence) {
  const double t = std::clamp((presence - kAbsent) / (kPresent - kAbsent), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

double blend_replace(double distance0, double presence0, double distance1, double presence1) {
  const double w0 = presence_weight(presence0), w1 = presence_weight(presence1);
  if (w0 + w1 == 0) return (distance0 + distance1) / 2;
  return (w0 * distance0 + w1 * distance1) / (w0 + w1);  // Eq. 1, replacement
}

double blend_union(double distance0, double distance1, double fillet) {
  const double least = std::min(distance0, distance1);  // Eq. 1, addition
  if (!(fillet > 0)) return least;
  const double x = std::max(fillet - std::abs(distance0 - distance1), 0.0) / fillet;
  return least - fillet * x * x * x / 6;
}

}  // namespace skinforge
