#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "surface/junction_loop.h"

namespace skinforge {

/// Host and donor borders in pairs, as indices, the two that run nearest to each other first; each border is
/// in one pair at most.
std::vector<std::pair<std::size_t, std::size_t>> nearest_pairs(std::span<const JunctionLoop> borders);

}  // namespace skinforge
