#pragma once

namespace skinforge {

/// Weight of a presence in a replacement, in [0, 1]: 0 up to 0.001, 1 from 0.999, smoothstep between
/// (junction.md d.2), so that the blended field has no step where a source begins to be fully present.
double presence_weight(double presence);

/// delta_R of Eq. 1 for replacements, metres: the mean of the two distances weighted by `presence_weight`.
/// Where both weights vanish the plain mean. A source that is absent beyond its band has presence 0 and
/// leaves the other one alone.
double blend_replace(double distance0, double presence0, double distance1, double presence1);

/// delta_R of Eq. 1 for additions, metres: the lesser distance, with a cubic smooth minimum of radius
/// `fillet` (metres, 0 or more; junction.md d.2): exact where the distances differ by `fillet` or more, lower
/// by fillet / 6 at most.
double blend_union(double distance0, double distance1, double fillet);

}  // namespace skinforge
