#pragma once

#include <array>
#include <string>
#include <vector>

#include "pipeline/stage.h"
#include "recipe/recipe.h"
#include "stages/artifacts.h"

/// Small helpers that several stages share.
namespace skinforge {

/// Names of the recipe's inputs, in its order: the index into this list is "input" everywhere behind the
/// recipe.
std::vector<std::string> input_names(const Recipe& recipe);

/// Artifact names of what all inputs hold, and of all input characters.
std::vector<std::string> contents_names(const ArtifactNames& names, const std::vector<std::string>& inputs);
std::vector<std::string> character_names(const ArtifactNames& names, const std::vector<std::string>& inputs);

/// The input characters themselves.
std::vector<const Character*> get_characters(const StageInput& in, const ArtifactNames& names,
                                             const std::vector<std::string>& inputs);

std::vector<const Skeleton*> skeletons_of(const std::vector<const Character*>& characters);

/// The joint, or Error (Usage) with the nearest names.
JointId require_joint(const Skeleton& skeleton, const std::string& joint, const std::string& input);

/// R = Ry(y) Rx(x) Rz(z), as recipes give rotations.
Quat rotation_yxz(const std::array<double, 3>& degrees);

/// Both lists, one after the other.
std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b);

}  // namespace skinforge
