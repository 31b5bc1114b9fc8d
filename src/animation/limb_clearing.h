#pragma once

#include <span>
#include <vector>

#include "animation/seam.h"

namespace skinforge {

/// A turn of one joint of a completed part that holds for a whole clip: an arm carried wider.
struct LimbTurn {
  SourceId source;
  JointId joint;                 ///< of the source's input
  Quat turn = Quat::Identity();  ///< in the frame of its parent in the result, after its own rotation
};

/// What a part shows while the driving clip runs: per row the frame of the driver's set, and of the part's.
struct ShownFrames {
  std::size_t first = 0;           ///< of the driver's set, in row 0
  std::vector<std::size_t> shown;  ///< per row, in the part's set
};

/// Turns limbs of a completed part, each as a whole and by one turn for the whole clip, so that they no
/// longer cut the driving part; ours, as an artist carries arms wider (completion.md). A limb turns about the
/// joint that moves most with a long lever and little hanging on it; never about one that carries another
/// source. `most`: radians that a turn may have; a turn that does not help by half is left out.
std::vector<LimbTurn> clear_limbs(std::span<const Character* const> characters, const Graft& graft,
                                  std::span<const Seam> seams, const ShownFrames& frames, double most);

}  // namespace skinforge
