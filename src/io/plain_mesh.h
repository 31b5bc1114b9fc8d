#pragma once

#include "io/import.h"

namespace skinforge {

/// Positions and polygons of an .obj or .off file just as the file counts them, one part, no other attribute:
/// what files that are indexed by vertex (handles, weights, examples) refer to. Nothing is welded. Metres and
/// Y up are taken for granted. Throws Error (BadInput), one line with the place.
PolygonMesh read_plain_mesh(const InputFile& file);

}  // namespace skinforge
