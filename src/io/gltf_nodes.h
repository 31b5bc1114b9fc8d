#pragma once

#include "io/gltf_document.h"
#include "io/raw_scene.h"

namespace skinforge {

/// Fills `scene.nodes` (same indices as the file) and `scene.skins`. Checks the tree: each node at most one
/// parent, no cycle, depth at most 1024, at most 65536 nodes; skins of at most 4096 joints, each joint once,
/// one finite and invertible inverse bind matrix per joint; the scene names roots only. A matrix that has a
/// TRS form becomes one. A node outside the default scene loses its mesh, with a warning. Oddities that glTF
/// says to ignore (transform of a skinned mesh node, wrong `skeleton`, several roots of one skin) are issues.
/// Throws Error (BadInput).
void read_nodes(const GltfDocument& document, RawScene& scene, IssueSink& issues);

}  // namespace skinforge
