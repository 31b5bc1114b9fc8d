#pragma once

#include "model/skin_weights.h"

namespace skinforge {

/// A row as the GLB writer stores it: cut to `limit` influences whose float weights sum to 1 to half a
/// rounding of the largest.
std::vector<Influence> written_row(std::span<const Influence> row, std::size_t limit);

/// All rows as they will be played: what is computed against an exported skin must read these.
SkinWeights written_weights(const SkinWeights& weights, std::size_t limit);

}  // namespace skinforge
