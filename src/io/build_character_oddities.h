#pragma once

#include <string>
#include <string_view>

#include "base/issue.h"
#include "io/build_character_joints.h"
#include "model/character.h"

namespace skinforge {

/// Warns of what is sound but hardly meant: faces that are there twice, joints whose file gives them a scale
/// of zero or a mirrored one, a skeleton without extent. Changes nothing. n log n in the faces.
void report_oddities(const PolygonMesh& mesh, const JointTable& joints, const std::string& place,
                     IssueSink& issues);

/// Whether an issue is one of those: told, and left as it is, so that it is in what is made of the model,
/// too.
bool is_oddity(std::string_view code);

}  // namespace skinforge
