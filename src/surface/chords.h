#pragma once

#include "surface/triangle_patch.h"

namespace skinforge {

/// Splits every chord, that is an inner edge between two fixed vertices, at its middle. A chord may double an
/// edge of the preserved mesh, and nothing could be interpolated along it. Triangles must be edge-manifold.
TrianglePatch split_chords(TrianglePatch patch);

}  // namespace skinforge
