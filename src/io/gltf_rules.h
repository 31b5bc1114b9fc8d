#pragma once

#include <string>
#include <vector>

#include "base/issue.h"
#include "io/import.h"

namespace skinforge {

/// One rule of glTF 2.0 that a file breaks, by the code that the Khronos validator has for it.
struct GltfFinding {
  enum class Level { Error, Warning };
  Level level = Level::Error;
  std::string code;     ///< "ACCESSOR_WEIGHTS_NON_NORMALIZED"
  std::string pointer;  ///< "/accessors/3", into the file's JSON
  std::string message;
};

/// Checks a glTF or GLB file (`files` as from `read_input_files`) against the rules that skinned, animated
/// characters break in practice: node tree and skins, contents of accessors, weights, animation (gltf.md
/// lists them). The Khronos validator knows more, none of what is found here is unknown to it. A file that
/// cannot be taken apart at all gives one finding, GLTF_UNREADABLE. In the order of the file: nodes, skins,
/// meshes, animations.
std::vector<GltfFinding> check_gltf(const std::vector<InputFile>& files);

}  // namespace skinforge
