#pragma once

#include "report/report.h"

namespace skinforge::testing {

/// A report with something in every place.
inline Report sample_report() {
  Report r;
  r.tool.version = "9.9.9";
  r.recipe = {"centaur", std::string(64, 'a')};
  r.inputs.push_back({"horse",
                      "horse.glb",
                      "glTF 2.0 binary",
                      {{"horse.glb", 91000, std::string(64, 'b')}},
                      1100,
                      1091,
                      1080,
                      34,
                      12,
                      3,
                      1,
                      2,
                      {0.8, 2.1, 2.4},
                      {{"vertices-welded", Severity::Note, "horse.glb", "410 vertices welded"}}});
  r.inputs.push_back({"man",
                      "man.fbx",
                      "FBX 7.4 binary",
                      {{"man.fbx", 650000, std::string(64, 'c')}, {"walk.fbx", 12000, std::string(64, 'e')}},
                      800,
                      789,
                      700,
                      62,
                      10,
                      4,
                      0,
                      0,
                      {1.7, 1.8, 0.4},
                      {}});
  r.operations.push_back(
      {"replace", {"Neck1"}, "man", "Spine", "Spine", 1.25, {0, 0.6, 0, 0.8}, {0.1, 1.2, -0.3}});
  r.ledger = {{LedgerKind::Clip, "horse", "Walk", LedgerState::Changed, {"horse_Walk"}, "renamed"},
              {LedgerKind::Joint, "horse", "Neck1", LedgerState::Dropped, {}, "replaced by operation 0"},
              {LedgerKind::Material, "man", "Skin", LedgerState::Kept, {"Skin"}, ""}};
  r.joint_maps = {{0, "horse", {{"Neck1", "Spine", 0.75}}}};
  r.joints = {{"Root", 0, "horse", "Root"}, {"Spine", 1, "man", "Spine"}};
  JunctionReport j;
  j.operation = 1;
  j.rung = "ring zip";
  j.reason = "24 and 18 border edges are no tube of quads";
  j.voxel = 0.021;
  j.components = 1;
  j.border_loops = {24, 18};
  j.faces = 60;
  j.quads = 51;
  j.triangles = 9;
  j.self_intersections = 0;
  j.scaled_jacobian = distribution_of({0.5, 0.75, 1.0});
  j.deviation = distribution_of({0.1, 0.2, 0.4});
  j.border_color_step = {42, 0.5, 2, 3.25};
  j.symmetry = {1, "", {1, 0, 0}, 0.25, 0.98, true, 0.0, 0.0, 0.001};
  r.junctions.push_back(j);
  r.mesh = {1500, 1490, 1400, 90, 1430, 1430.0 / 1490, 1, 12, 0, {1.7, 2.9, 2.4}};
  r.weights = {4, 12, 0.125, 1.0, 1.0, 0, {"Helper"}, 0.5, 0.75, 0.625, 1};
  r.clips.push_back({"horse_Walk",
                     "horse",
                     "Walk",
                     1.04,
                     1200,
                     34,
                     {{1, "Idle", 0, 0.2, 1.2, 31}},
                     {{"human_UpperArm.L", 12.5}},
                     0.4,
                     2,
                     "loop",
                     {6, 0.26, 3, 1, 1.75, 0.01, 0.125},
                     8.5,
                     "Hand.L",
                     7.0,
                     8.5 / 7.0});
  r.outputs.push_back({"centaur.glb", 1234567, std::string(64, 'd')});
  r.issues.push_back({"placement-far", Severity::Warning, "op 0", "the loops are 0.4 m apart"});
  return r;
}

}  // namespace skinforge::testing
