#pragma once

#include "io/gltf_document.h"
#include "io/raw_scene.h"

namespace skinforge {

/// Fills `scene.animations`; `scene.nodes` and `scene.meshes` must be there. All three interpolations are
/// kept with their keys as stored. Repaired with a warning: quaternions off unit length, equal key times (the
/// last key of a run stays), a second channel for the same property (left out), one CUBICSPLINE key. Channels
/// without a node are left out with a note. Throws Error (BadInput): counts that do not match, times that are
/// negative, fall or exceed 24 hours, unknown paths and modes.
void read_animations(const GltfDocument& document, RawScene& scene, IssueSink& issues);

}  // namespace skinforge
