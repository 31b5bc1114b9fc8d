#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/gltf_rules.h"

namespace skinforge {

/// What the Khronos validator (npm package gltf-validator, in $NODE_PATH or in build/node of this repository)
/// finds in a file: errors and warnings. None where node or the package is not there, or it does not answer
/// within a minute.
std::optional<std::vector<GltfFinding>> khronos_findings(const std::string& path);

}  // namespace skinforge
