#pragma once

#include "io/gltf_document.h"
#include "io/raw_scene.h"

namespace skinforge {

/// Fills `scene.images` with the encoded bytes as they are and `scene.materials` with the glTF materials
/// (metallic-roughness; KHR_texture_transform, KHR_materials_unlit, KHR_materials_emissive_strength;
/// KHR_materials_pbrSpecularGlossiness where there is no metallic-roughness: diffuse becomes base colour,
/// roughness is 1 - glossiness, metallic 0). An image that is missing, damaged or of another kind than PNG
/// and JPEG is left out with a warning, as are its uses. Throws Error (BadInput) for broken references.
void read_materials(const GltfDocument& document, RawScene& scene, IssueSink& issues);

}  // namespace skinforge
