#pragma once

#include <vector>

#include "model/skeleton.h"

namespace skinforge {

/// Per joint: how far a local translation of length 1 moves it in the bind pose, as a share of the skeleton's
/// extent (diagonal of the box round its joints). Makes translations of joints comparable whatever the units
/// and the scale of their parents. All 0 for a skeleton without extent.
std::vector<double> shift_scales(const Skeleton& skeleton);

}  // namespace skinforge
