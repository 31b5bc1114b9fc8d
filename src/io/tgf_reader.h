#pragma once

#include "io/import.h"
#include "model/bone_graph.h"

namespace skinforge {

/// A skeleton in the Trivial Graph Format: lines `index x y z`, a line with `#`, lines `source end`; indices
/// count from 1 and may come in any order. What stands behind on a line is left out, files in use
/// carry garbage there; so are further sections after a second `#`.
/// Throws Error (BadInput), one line, for an index that is missing or given twice, coordinates that are not
/// finite, a bone that names no joint or joins a joint to itself, and a file without bones. Whether the bones
/// form trees is for `make_bone_forest` to say.
BoneGraph read_tgf(const InputFile& file);

}  // namespace skinforge
