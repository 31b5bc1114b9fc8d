#pragma once

#include <span>
#include <vector>

#include "animation/completion.h"

namespace skinforge {

/// Limbs that a body has more than once: sources that bring joints of the same names, such as the second pair
/// of arms of a four-armed man.
struct LimbRank {
  std::size_t family = 0;  ///< the first source of those alike; its own index for a source like no other
  std::size_t rank = 0;    ///< 0 for the first
  std::size_t count = 1;   ///< how many ranks the family has
};

/// One per source. A source is like an earlier one when more than half of the joints that it brings to the
/// result have the names, in their input, of joints that the earlier one brings. A pair (left, right) that
/// comes as two sources has no names in common, so both have the same rank.
std::vector<LimbRank> limb_ranks(std::span<const Character* const> characters, const Graft& graft);

/// How far, in steps, the limbs `part` follow the limbs `driver`: their ranks' difference times the phase, by
/// default 1 / count, so that all share the step evenly. 0 for limbs of different families.
double steps_behind(const LimbRank& part, const LimbRank& driver, const std::optional<double>& limb_phase);

/// Frames that one step (gait cycle) of a clip takes: in a loop the shortest period after which the poses
/// come again, a whole fraction of the clip; in other clips 0.4 s. Cost: frames^2 x joints.
double step_frames(const MotionSet& set, std::size_t clip, bool is_loop);

/// Where a limb that is `delay` frames behind is, in frames of the body's motion, at `frame` of `last`. In a
/// loop simply so much earlier (the caller wraps). Elsewhere it falls behind and catches up so smoothly that
/// its tempo stays between 0.6 and 1.4, and begins and ends with the body.
double delayed_frame(double frame, double delay, double last, bool is_loop);

}  // namespace skinforge
