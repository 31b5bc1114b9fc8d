#pragma once

#include "io/gltf_document.h"
#include "io/raw_scene.h"

namespace skinforge {

/// Fills `scene.meshes` (same indices as the file); `scene.nodes` and `scene.skins` must be there. Triangle
/// lists, strips and fans become polygons of three corners; where a primitive carries FB_ngon_encoding, fans
/// become the polygons they stand for and `scene.triangles_only` is cleared. Points and lines are skipped
/// with a warning. Influences of weight 0 are left out, all others are kept as stored (NaN and negative ones
/// too), up to 16 a vertex. Normals, UVs and colours that are not finite become zero with a warning. Of morph
/// targets only the positions are kept. Throws Error (BadInput): counts that differ, indices out of range, a
/// used joint that the skin does not have, more than 10 million vertices, those of morph targets included.
void read_meshes(const GltfDocument& document, RawScene& scene, IssueSink& issues);

}  // namespace skinforge
