#pragma once

#include <string>
#include <vector>

#include "base/issue.h"
#include "io/build_character_joints.h"
#include "io/raw_scene.h"
#include "model/polygon_mesh.h"
#include "model/skin_weights.h"

namespace skinforge {

using WeightRow = std::vector<Influence>;

/// The row of each vertex of a primitive in normal form; empty where nothing usable is stored. `joints`: the
/// joint behind each index of the skin. Counts what it had to change into one issue per kind.
std::vector<WeightRow> weight_rows(const RawScene::Primitive& primitive, const std::vector<JointId>& joints,
                                   const std::string& place, IssueSink& issues);

/// Whether two rows say the same up to the rounding of 8-bit weights; an empty row says nothing against any.
bool is_same_row(const WeightRow& a, const WeightRow& b);

/// Rows for the vertices without one: that of the nearest vertex that has one, in the same connected piece,
/// else in the mesh, else the root alone. Position decides, then the lower index. Quadratic in the worst
/// case: empty rows times others.
void fill_empty_rows(const PolygonMesh& mesh, std::vector<WeightRow>& rows, const std::string& place,
                     IssueSink& issues);

}  // namespace skinforge
