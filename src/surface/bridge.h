#pragma once

#include "surface/junction_loop.h"
#include "surface/kept_surface.h"
#include "surface/triangle_patch.h"

namespace skinforge {

/// Whether `bridge_or_cap` joins every piece of the preserved faces that has a border here to the other side.
bool bridge_joins_all(const std::vector<JunctionLoop>& loops, const KeptSurface& kept);

/// Host and donor borders in pairs, those that run nearest to each other first, zipped directly; what stays
/// single is filled. The inside is remeshed to the borders' edge lengths, and if `is_fair`, it leaves the
/// borders along the slope of the preserved faces; else it is the tightest membrane.
TrianglePatch bridge_or_cap(const std::vector<JunctionLoop>& loops, bool is_fair);

}  // namespace skinforge
