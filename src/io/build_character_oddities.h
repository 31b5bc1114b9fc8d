#pragma once

#include <string>

#include "base/issue.h"
#include "io/build_character_joints.h"
#include "model/character.h"

namespace skinforge {

/// Warns of what is sound but hardly meant: faces that are there twice, joints whose file gives them a scale
/// of zero or a mirrored one, a skeleton without extent. Changes nothing. n log n in the faces.
void report_oddities(const PolygonMesh& mesh, const JointTable& joints, const std::string& place,
                     IssueSink& issues);

}  // namespace skinforge
