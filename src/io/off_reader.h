#pragma once

#include "io/import.h"

namespace skinforge {

/// A mesh in the Object File Format: one vertex a line, then one face a line, comments behind `#`. What
/// stands behind the coordinates of a vertex or the corners of a face (colours) is left out with an issue.
/// Units and axes are taken as metres and Y up. Throws Error (BadInput), one line: "PATH: line 8: vertex 4000
/// of 4".
RawScene read_off(const InputFile& file);

}  // namespace skinforge
