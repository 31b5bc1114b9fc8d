#pragma once

#include <span>
#include <string>
#include <vector>

#include "report/ledger.h"
#include "skeleton/graft.h"
#include "stages/stages.h"
#include "surface/assemble.h"

namespace skinforge {

/// Where each joint, clip, material, image, morph target and mesh part of the result comes from, for the
/// nothing-lost ledger.
ResultOrigins result_origins(const std::vector<const Character*>& inputs,
                             const std::vector<std::string>& input_names, const Graft& graft,
                             const JoinedSurface& joined, const Character& result,
                             std::span<const ClipRequest> clips);

}  // namespace skinforge
