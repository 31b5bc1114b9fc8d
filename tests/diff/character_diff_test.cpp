#include "diff/character_diff.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "diff/correspondence.h"
#include "diff/diff_text.h"
#include "testing/shapes.h"
#include "testing/toy_character.h"

namespace skinforge {
namespace {
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::ToyCharacter;
constexpr double kRounding = 1e-9;

// One bone along x with a triangle at its end, a clip that turns it by `angle` in one second.
Character flag(double angle) {
  Character c;
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(4, 3, 0)}) c.mesh.positions.push_back(p);
  c.mesh.corners = {VertexId(0), VertexId(1), VertexId(2)};
  c.mesh.face_begin = {0, 3};
  c.mesh.face_material = {MaterialId()};
  c.mesh.face_part = {PartId(0)};
  c.mesh.normals.assign(3, Vec3::UnitZ());
  c.mesh.parts = {{"flag", 0, true, false}};
  Joint root;
  root.name = "root";
  c.skeleton.joints = {root};
  for (int v = 0; v < 3; ++v) c.weights.push_row(std::vector<Influence>{{JointId(0), 1}});
  Clip clip{"Turn", 1, {JointTracks{JointId(0), {}, {}, {}}}, {}};
  clip.joints[0].rotation.times = {0, 1};
  clip.joints[0].rotation.values = {Quat::Identity(), Quat(Eigen::AngleAxisd(angle, Vec3::UnitZ()))};
  c.clips = {clip};
  validate(c);
  return c;
}

TEST(CharacterDiff, OfACharacterAndItselfIsNothing) {
  for (const Character& c : {ToyCharacter::make(), flag(1)}) {
    const CharacterDiff diff = compare_characters(c, c);
    EXPECT_THAT(diff.structure.edits, IsEmpty());
    EXPECT_LT(diff.geometry.max, kRounding);
    EXPECT_EQ(diff.geometry.unmatched_a + diff.geometry.unmatched_b, 0U);
    EXPECT_EQ(diff.skin.max, 0);
    ASSERT_EQ(diff.clips.size(), c.clips.size());
    for (const ClipDiff& clip : diff.clips) EXPECT_EQ(clip.max, 0) << clip.clip;
    EXPECT_FALSE(is_over(judge(diff, {})));
  }
}

// By hand: diagonal 5; the far corner is 5 from the axis, so turns that differ by 0.1 at the end put it
// 2 * 5 * sin(0.05) apart, which is 2 sin(0.05) of the diagonal.
TEST(CharacterDiff, FindsTheWorstMomentOfAClip) {
  const CharacterDiff diff = compare_characters(flag(1), flag(1.1));
  EXPECT_NEAR(diff.diagonal, 5, kRounding);
  ASSERT_EQ(diff.clips.size(), 1U);
  const ClipDiff& clip = diff.clips.front();
  EXPECT_NEAR(clip.max, 2 * std::sin(0.05), kRounding);
  EXPECT_EQ(clip.time, 1);
  EXPECT_EQ(clip.joint, "root");
  EXPECT_NEAR(clip.joint_angle_deg, degrees(0.1), 1e-6);
  EXPECT_EQ(clip.joint_max, 0);
  // keys at 0 and 1, the middle between: 0, 2 sin(0.025), 2 sin(0.05) of 0, 4 and 5 metres
  const double squares = (16 + 25) * 4 * (std::pow(std::sin(0.025), 2) + std::pow(std::sin(0.05), 2));
  EXPECT_NEAR(clip.rms, std::sqrt(squares / 9) / 5, kRounding);
  const auto findings = judge(diff, {});
  EXPECT_TRUE(is_over(findings));
  EXPECT_THAT(findings.back().text, HasSubstr("at 1 s on \"root\""));
  EXPECT_FALSE(is_over(judge(diff, {.animation = 0.11})));
}

// A middle key that a local tolerance thought to be needless is missed at its time, not at the ends.
// Moved as a whole no vertex finds its counterpart: that is told, and is a difference whatever the limit.
TEST(CharacterDiff, WhatCannotBeComparedIsNotTheSame) {
  Character moved = flag(1);
  for (Vec3& p : moved.mesh.positions) p += Vec3(0, 100, 0);
  const CharacterDiff diff = compare_characters(flag(1), moved);
  ASSERT_EQ(diff.clips.size(), 1U);
  EXPECT_FALSE(diff.clips[0].is_compared);
  DiffThresholds loose;
  loose.geometry = loose.animation = 1000;
  const auto findings = judge(diff, loose);
  EXPECT_TRUE(findings.back().is_over);
  EXPECT_THAT(findings.back().text, HasSubstr("no vertex of A has a counterpart"));
}

TEST(CharacterDiff, LooksAtKeysOfBothSides) {
  Character b = flag(1);
  auto& rotation = b.clips[0].joints[0].rotation;
  rotation.times = {0, 0.5, 1};
  rotation.values.insert(rotation.values.begin() + 1, Quat(Eigen::AngleAxisd(0.7, Vec3::UnitZ())));
  const CharacterDiff diff = compare_characters(flag(1), b), back = compare_characters(b, flag(1));
  EXPECT_EQ(diff.clips[0].time, 0.5);
  EXPECT_NEAR(diff.clips[0].max, 2 * std::sin(0.1), kRounding);
  EXPECT_NEAR(back.clips[0].max, diff.clips[0].max, kRounding);
}

// By hand: the corner (4, 3, 0) lifted by 1 is 1 from the plane of A, of a diagonal of 5.
TEST(CharacterDiff, MeasuresTheSurface) {
  Character b = flag(1);
  b.mesh.positions[2].z() = 1;
  const CharacterDiff diff = compare_characters(flag(1), b);
  EXPECT_NEAR(diff.geometry.max, 1.0 / 5, kRounding);
  EXPECT_EQ(diff.geometry.unmatched_a, 1U);
  EXPECT_EQ(diff.geometry.unmatched_b, 1U);
  EXPECT_NEAR(diff.geometry.area_a, 6, kRounding);
}

// A solid of three right angles at the origin with edges of 6 and, upwards, `height`; no bones.
Character corner_piece(double height) {
  Character c;
  c.mesh.positions = {Vec3(0, 0, 0), Vec3(6, 0, 0), Vec3(0, 6, 0), Vec3(0, 0, height)};
  for (const int v : {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}) c.mesh.corners.push_back(VertexId(v));
  c.mesh.face_begin = {0, 3, 6, 9, 12};
  c.mesh.face_material.assign(4, MaterialId());
  c.mesh.face_part.assign(4, PartId(0));
  c.mesh.normals.assign(12, Vec3::Zero());
  c.mesh.parts = {{"solid", 0, false, false}};
  for (int v = 0; v < 4; ++v) c.weights.push_row(std::vector<Influence>{});
  return c;
}

// By hand: a sixth of the box, 36 m3 and 42 m3; three sides of half a square and, slanted, sqrt(3) / 4 * 72;
// of four vertices one has moved.
TEST(CharacterDiff, MeasuresAreaAndVolume) {
  const Character a = corner_piece(6), b = corner_piece(7);
  const GeometryDiff found = compare_characters(a, b).geometry;
  EXPECT_NEAR(found.volume_a, 36, kRounding);
  EXPECT_NEAR(found.volume_b, 42, kRounding);
  EXPECT_NEAR(found.area_a, 3 * 18 + 18 * std::sqrt(3), kRounding);
  EXPECT_EQ(found.unchanged, 0.75);
  EXPECT_EQ(found.unmatched_a, 1U);
  EXPECT_EQ(found.normals_deg.compared, 0U);  // there are none
}

// A face that is gone leaves every vertex on the surface: only counting finds the hole.
TEST(CharacterDiff, CountsWhatDistancesDoNotShow) {
  const Character a = corner_piece(6);
  Character b = a;
  b.mesh.corners.resize(9);
  b.mesh.normals.resize(9);
  b.mesh.face_begin.pop_back();
  b.mesh.face_material.pop_back();
  b.mesh.face_part.pop_back();
  const CharacterDiff diff = compare_characters(a, b);
  EXPECT_EQ(diff.geometry.max, 0);
  EXPECT_THAT(diff.structure.edits, ElementsAre("3 triangles, there were 4", "3 open edges, there were 0",
                                                "1 boundary loops, there were 0"));
  EXPECT_TRUE(is_over(judge(diff, {})));
}

// Another program may weld less: two triangles that shared an edge have one each at the same place. That is
// no edit; a gap between them is.
TEST(CharacterDiff, WeldingIsNoEdit) {
  const Character a = corner_piece(6);
  Character b = a;
  for (const std::size_t corner : {9, 10, 11}) {  // the slanted face on vertices of its own
    b.mesh.positions.push_back(a.mesh.positions[a.mesh.corners[corner].index()]);
    b.mesh.corners[corner] = VertexId(b.mesh.positions.size() - 1);
    b.weights.push_row(std::vector<Influence>{});
  }
  EXPECT_EQ(compare_characters(a, b).structure.b.open_edges, 6U);
  EXPECT_THAT(compare_characters(a, b).structure.edits, IsEmpty());
  EXPECT_THAT(compare_characters(b, a).structure.edits, IsEmpty());
  for (std::size_t v = 4; v < 7; ++v) b.mesh.positions[v] += Vec3(1, 1, 1);
  EXPECT_THAT(compare_characters(a, b).structure.edits,
              ElementsAre("2 components, there were 1", "6 open edges, there were 0",
                          "2 boundary loops, there were 0"));
}

// A ring in the place of a box: both are closed, what differs is the genus.
TEST(CharacterDiff, CountsHandles) {
  Character a;
  a.mesh = testing::polygon_mesh(testing::cube_soup());
  for (int v = 0; v < 8; ++v) a.weights.push_row(std::vector<Influence>{});
  Character b = a;
  b.mesh = testing::polygon_mesh(testing::torus_knot_soup(12, 5));
  b.weights = {};
  for (std::size_t v = 0; v < b.mesh.vertex_count(); ++v) b.weights.push_row(std::vector<Influence>{});
  EXPECT_THAT(compare_characters(a, b).structure.edits, Contains("genus 1, it was 0"));
  EXPECT_EQ(compare_characters(b, b).structure.a.genus, 1U);
  EXPECT_THAT(compare_characters(b, b).structure.edits, IsEmpty());
}

// By hand: each face of the toy's body has the whole texture, so all of it is used more than once.
TEST(CharacterDiff, MeasuresUvs) {
  const Character a = ToyCharacter::make();
  Character b = a;
  for (Vec2& uv : b.mesh.uvs[0]) uv /= 4;
  const CharacterDiff diff = compare_characters(a, b);
  EXPECT_EQ(diff.geometry.uv_a.overlap, 1);
  EXPECT_GT(diff.geometry.uv_a.stretch, 1);
  EXPECT_NEAR(diff.geometry.uv_b.stretch, diff.geometry.uv_a.stretch, kRounding);
  EXPECT_THAT(to_text(diff, {}), HasSubstr("100 % -> 100 % of their area used more than once"));
  EXPECT_EQ(to_json(diff, {}).at("geometry").at("uv_b").at("overlap"), 1);
}

// Law: between characters of one box it does not matter which is A.
TEST(CharacterDiff, IsSymmetric) {
  const Character a = ToyCharacter::make();
  Character b = a;
  b.mesh.positions[7] += Vec3(-0.001, 0.001, 0);
  b.mesh.normals[3] = Vec3(0.6, 0, 0.8);
  b.mesh.uvs[0][11] += Vec2(0.25, 0);
  std::swap(b.weights.influences[0].weight, b.weights.influences[1].weight);
  const CharacterDiff there = compare_characters(a, b), back = compare_characters(b, a);
  EXPECT_GT(there.geometry.max, 0);
  EXPECT_NEAR(there.geometry.max, back.geometry.max, kRounding);
  EXPECT_NEAR(there.geometry.mean, back.geometry.mean, kRounding);
  EXPECT_NEAR(there.geometry.unchanged, back.geometry.unchanged, kRounding);
  EXPECT_GT(there.geometry.normals_deg.max, 0);
  EXPECT_NEAR(there.geometry.normals_deg.max, back.geometry.normals_deg.max, kRounding);
  EXPECT_NEAR(there.geometry.normals_deg.mean, back.geometry.normals_deg.mean, kRounding);
  EXPECT_NEAR(there.geometry.uvs.max, 0.25, kRounding);
  EXPECT_NEAR(there.geometry.uvs.max, back.geometry.uvs.max, kRounding);
  EXPECT_GT(there.skin.max, 0);
  EXPECT_NEAR(there.skin.max, back.skin.max, kRounding);
  for (std::size_t c = 0; c < there.clips.size(); ++c)
    EXPECT_NEAR(there.clips[c].max, back.clips[c].max, kRounding) << there.clips[c].clip;
}

// What is over its limit is told as such, and nothing else.
TEST(CharacterDiff, JudgesNormalsAndUvs) {
  const Character a = ToyCharacter::make();
  Character b = a;
  b.mesh.normals[5] = -b.mesh.normals[5];
  const auto over = [&](const DiffThresholds& thresholds) {
    std::vector<std::string> names;
    for (const DiffFinding& f : judge(compare_characters(a, b), thresholds))
      if (f.is_over) names.push_back(f.name);
    return names;
  };
  EXPECT_THAT(over({}), ElementsAre("normals"));
  EXPECT_THAT(over({.normals = 180}), IsEmpty());
  b.mesh.uvs[0][7].x() += 0.01;
  EXPECT_THAT(over({}), ElementsAre("normals", "UVs"));
  EXPECT_THAT(over({.normals = 180, .uv = 0.02}), IsEmpty());
}

TEST(CharacterDiff, MeasuresWeights) {
  const Character a = ToyCharacter::make();
  Character b = a;
  std::size_t v = 0;
  while (b.weights.of(VertexId(v)).size() < 2) ++v;
  auto& first = b.weights.influences[static_cast<std::size_t>(b.weights.row_begin[v])];
  first.weight -= 0.05;
  (&first)[1].weight += 0.05;
  const CharacterDiff diff = compare_characters(a, b);
  EXPECT_NEAR(diff.skin.max, 0.1, kRounding);
  EXPECT_EQ(diff.skin.changed, 1U);
}

TEST(CharacterDiff, ListsWhatOneSideLacks) {
  const Character a = ToyCharacter::make();
  Character b = a;
  b.skeleton.joints[1].name = "centre";
  b.clips[0].name = "Other";
  b.materials[0].base_color.x() += 0.5;
  b.images.pop_back();
  const CharacterDiff diff = compare_characters(a, b);
  EXPECT_THAT(diff.structure.edits, Contains("joint \"middle\" is called \"centre\""));  // found by its place
  EXPECT_THAT(diff.structure.edits, Contains("clip \"" + a.clips[0].name + "\" is gone"));
  EXPECT_THAT(diff.structure.edits, Contains("clip \"Other\" is new"));
  EXPECT_THAT(diff.structure.edits, Contains("material \"" + a.materials[0].name + "\" changed"));
  EXPECT_THAT(diff.structure.edits, Contains(::testing::ContainsRegex("image \".*\" is gone")));
  EXPECT_EQ(diff.skin.max, 0);
  EXPECT_TRUE(is_over(judge(diff, {})));
  EXPECT_FALSE(is_over(judge(diff, {.structure = false})));
  EXPECT_THAT(to_text(diff, judge(diff, {})), HasSubstr("! structure"));
}

// Law: the order of vertices, joints' names and a few float steps change nothing that counts.
TEST(Correspondence, FindsVerticesInAnyOrder) {
  const Character a = flag(1);
  Character b = a;
  std::reverse(b.mesh.positions.begin(), b.mesh.positions.end());
  b.mesh.corners = {VertexId(2), VertexId(1), VertexId(0)};
  for (Vec3& p : b.mesh.positions) p += Vec3(1e-6, -1e-6, 1e-6);
  const Correspondence same = correspond(a, b);
  EXPECT_THAT(same.vertices, ElementsAre(VertexId(2), VertexId(1), VertexId(0)));
  EXPECT_LT(compare_characters(a, b).clips[0].max, 1e-6);
}

TEST(Correspondence, WeightDistanceIsASumOverJoints) {
  const std::vector<JointId> same = {JointId(0), JointId(1), JointId()};
  const std::vector<Influence> a = {{JointId(0), 0.75}, {JointId(1), 0.25}},
                               b = {{JointId(0), 0.5}, {JointId(1), 0.5}};
  EXPECT_NEAR(weight_distance(a, b, same), 0.5, kRounding);
  EXPECT_NEAR(weight_distance(a, a, same), 0, kRounding);
  const std::vector<Influence> lost = {{JointId(2), 1}};
  EXPECT_NEAR(weight_distance(lost, b, same), 2, kRounding);
}

TEST(CharacterDiff, EmptyCharacters) {
  const Character nothing;
  const CharacterDiff diff = compare_characters(nothing, nothing);
  EXPECT_EQ(diff.geometry.max, 0);
  EXPECT_EQ(diff.worst_clip(), nullptr);
  EXPECT_NO_THROW(to_json(diff, judge(diff, {})).dump());
}

}  // namespace
}  // namespace skinforge
