#pragma once

#include "surface/junction_loop.h"
#include "surface/triangle_patch.h"

namespace skinforge {

/// Whether every border has a partner on the other side, so that a bridge leaves nothing apart.
bool can_bridge_all(const std::vector<JunctionLoop>& loops);

/// Host and donor borders in pairs, nearest centres first, zipped directly; what stays single is filled. The
/// inside is remeshed to the borders' edge lengths, and if `is_fair`, it leaves the borders along the slope
/// of the preserved faces; else it is the tightest membrane.
TrianglePatch bridge_or_cap(const std::vector<JunctionLoop>& loops, bool is_fair);

}  // namespace skinforge
