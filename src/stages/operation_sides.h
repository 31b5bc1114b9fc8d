#pragma once

#include <span>
#include <vector>

#include "model/character.h"
#include "skeleton/graft.h"

/// What an operation cuts, before any face is selected.
namespace skinforge {

/// The `at` joints of an operation as the operations before it left them.
struct HostSide {
  SourceId source;              ///< of the first of them; invalid when none is known
  std::vector<JointId> joints;  ///< those of that source, as its input's joints
  Vec3 centre = Vec3::Zero();   ///< mean position of all of them, model space
};
HostSide host_side(const Graft& before, const GraftOperation& operation);

/// Presence of what stays when `joints` and all below them go; #V of the character.
std::vector<double> presence_without(const Character& character, std::span<const JointId> joints);

}  // namespace skinforge
