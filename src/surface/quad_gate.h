#pragma once

#include <string>

#include "field/signed_distance.h"
#include "surface/quad_patch.h"

namespace skinforge {

inline constexpr double kLeastJacobian = 0.2;  ///< junction.md c: the gate of rung 2

/// Why a patch of quads is not good enough for its rung, by the gates of junction.md (c) that need no
/// neighbours: least scaled Jacobian, faces against the field, deviation from it. Empty when it is.
std::string fault_of(const QuadPatch& patch, const DistanceField& field);

}  // namespace skinforge
