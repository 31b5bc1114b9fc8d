#pragma once

namespace skinforge {

/// Weight of a presence in a replacement, in [0, 1]: 0 up to 0.001, 1 from 0.999, smoothstep between
/// (junction.md d.2), so that the blended field has no step where a source begins to be fully present.
double presence_weight(double presence);

/// delta_R of Eq. 1 for replacements, metres: the mean of the two distances weighted by presence, with three
/// cases that the formula leaves open, each reached without a step (w = `presence_weight`):
///  - weights are w / (1 - w), so that a source that is wholly present decides alone where the other is not:
///  its preserved
///    surface is met exactly;
///  - where both become wholly present, the nearer surface (a union): two preserved parts must not pull at
///  each other from afar;
///  - where neither is present, the plain mean.
double blend_replace(double distance0, double presence0, double distance1, double presence1);

/// delta_R of Eq. 1 for additions, metres: the lesser distance, with a cubic smooth minimum of radius
/// `fillet` (metres, 0 or more; junction.md d.2): exact where the distances differ by `fillet` or more, lower
/// by fillet / 6 at most.
double blend_union(double distance0, double distance1, double fillet);

}  // namespace skinforge
