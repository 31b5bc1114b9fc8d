#pragma once

#include <optional>

#include "surface/fairing.h"
#include "surface/junction_loop.h"
#include "surface/patch_mirror.h"

namespace skinforge {

/// A cap of quads over one border (junction.md b.2, N = 1): a grid whose four corners lie where the border
/// turns most and whose opposite sides are alike; round borders get a ring of quads before the grid, and so
/// do odd ones, with one triangle in it. It leaves the border along the slope of the preserved faces
/// (`fair`). None
/// for fewer than four vertices, or when no grid reaches the least scaled Jacobian of the gate.
/// With `mirror` (what it does to the loop's vertices, where it maps onto itself) only symmetric caps are
/// made.
std::optional<QuadPatch> quad_cap(const JunctionLoop& loop, const PatchMirror* mirror = nullptr);

/// The faces of such a cap, without geometry. `start`: border vertex at the grid's first corner; `width`,
/// `height`: squares of the grid; with a ring, 2 (width + height) is #border or one less, otherwise #border.
/// Vertices: the border's, then the new ones.
QuadPatch cap_faces(int border, int start, int width, int height, bool has_ring);

}  // namespace skinforge
