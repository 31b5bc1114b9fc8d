#pragma once

#include <span>
#include <vector>

#include "animation/completion.h"

namespace skinforge {

/// The feet of an input and what they do in its clips. None for an input without clips or skin.
std::vector<Foot> find_feet(const Character& input, const MotionSet& set);

/// How much worse feet do in a clip of the result than in any clip of their input. 0 = no worse.
struct FootFaults {
  double sink = 0;   ///< farther down, metres
  double slide = 0;  ///< faster along the ground while they stand, m/s
};
/// Over all sources that stand upright in the result; `motions`: one per source.
FootFaults foot_faults(const Graft& graft, std::span<const MotionSet* const> motions, const Clip& clip);

}  // namespace skinforge
