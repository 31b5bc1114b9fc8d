#pragma once

#include <string>
#include <vector>

#include "base/issue.h"
#include "model/polygon_mesh.h"
#include "skinning/bone_heat.h"
#include "skinning/handles.h"

namespace skinforge {

enum class BindMethod : std::uint8_t {
  Harmonic,  ///< from handles over the surface (`harmonic_weights`)
  Heat,      ///< from the bones through the inside (`bone_heat_weights`); takes no handles
};

struct BindOptions {
  BindMethod method = BindMethod::Harmonic;
  Handles handles = {};  ///< one a vertex; empty: `rule`
  HandleRule rule = {};
  BoneHeatOptions heat = {};
  std::size_t influences = 0;  ///< at most so many joints a vertex; 0 = all
};

struct BoundSkin {
  SkinWeights weights;  ///< one row a vertex, never empty, in [0, 1], sum 1, rows sorted as `normalised_row`
  Handles handles;      ///< what held the weights; all free for Heat
};

/// A skin for a mesh. Vertices at one place count as one (`weld_surface`), so parts that touch move together.
/// What the method leaves open is settled here and reported at `place`:
///  - parts that no handle reaches go rigidly with the bone nearest to them on average;
///  - weights outside [0, 1] are clamped and rows scaled to sum 1, before the cut to `influences`;
///  - joints from the root on that run outside the surface for more than half of their length only place the
///    character and hold nothing;
///  - joints without handle are named.
/// Throws Error (BadInput) for a mesh without faces, a skeleton without bones, or no handle at all.
BoundSkin bind_skin(const PolygonMesh& mesh, const Skeleton& skeleton, const BindOptions& options,
                    const std::string& place, IssueSink& issues);

}  // namespace skinforge
