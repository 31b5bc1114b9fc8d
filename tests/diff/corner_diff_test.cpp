#include "diff/corner_diff.h"

#include <gtest/gtest.h>

#include "testing/toy_character.h"

namespace skinforge {
namespace {
using testing::ToyCharacter;
constexpr double kRounding = 1e-9;

GeometryDiff compare(const Character& a, const Character& b) {
  GeometryDiff diff;
  compare_corners(a, b, correspond(a, b), diff);
  return diff;
}

TEST(CornerDiff, OfACharacterAndItselfIsNothing) {
  const Character toy = ToyCharacter::make();
  const GeometryDiff diff = compare(toy, toy);
  EXPECT_EQ(diff.normals_deg.max, 0);
  EXPECT_EQ(diff.uvs.max, 0);
  EXPECT_EQ(diff.normals_deg.compared, toy.mesh.corner_count());
  EXPECT_EQ(diff.uvs.compared, 24U);  // of the body; the face has none
}

// By hand: one corner of the 38 of the toy looks the other way. The other corners of its vertex have normals
// of other faces, which must not hide it.
TEST(CornerDiff, FindsAFlippedNormal) {
  const Character a = ToyCharacter::make();
  Character b = a;
  b.mesh.normals[5] = -b.mesh.normals[5];
  const CornerDiff found = compare(a, b).normals_deg;
  EXPECT_NEAR(found.max, 180, kRounding);
  EXPECT_NEAR(found.mean, 180.0 / double(a.mesh.corner_count()), kRounding);
  EXPECT_FALSE(found.joint.empty());
}

// By hand: one corner is shifted by (0.03, 0.04).
TEST(CornerDiff, FindsAShiftedUv) {
  const Character a = ToyCharacter::make();
  Character b = a;
  b.mesh.uvs[0][7] += Vec2(0.03, -0.04);
  const GeometryDiff found = compare(a, b);
  EXPECT_NEAR(found.uvs.max, 0.05, kRounding);
  EXPECT_NEAR(found.uvs.mean, 0.05 / 24, kRounding);
  EXPECT_EQ(found.normals_deg.max, 0);
}

// Law: the order of vertices and faces changes nothing.
TEST(CornerDiff, FindsCornersInAnyOrder) {
  const Character a = ToyCharacter::make();
  Character b = a;
  const PolygonMesh& from = a.mesh;
  PolygonMesh& to = b.mesh;
  to.corners.clear();
  to.normals.clear();
  to.uvs[0].clear();
  to.colors.clear();
  to.face_begin = {0};
  for (std::size_t f = from.face_count(); f-- > 0;) {
    for (std::size_t k = from.first_corner(FaceId(f)); k < from.first_corner(FaceId(f + 1)); ++k) {
      to.corners.push_back(from.corners[k]);
      to.normals.push_back(from.normals[k]);
      to.uvs[0].push_back(from.uvs[0][k]);
      to.colors.push_back(from.colors[k]);
    }
    to.face_begin.push_back(static_cast<std::int32_t>(to.corners.size()));
    to.face_material[from.face_count() - 1 - f] = from.face_material[f];
    to.face_part[from.face_count() - 1 - f] = from.face_part[f];
  }
  const GeometryDiff found = compare(a, b);
  EXPECT_EQ(found.normals_deg.max, 0);
  EXPECT_EQ(found.uvs.max, 0);
  EXPECT_EQ(found.uvs.compared, 24U);
}

// A quad as the two triangles that a file has for it: the same corners.
TEST(CornerDiff, FacesMayBeSplit) {
  Character a = ToyCharacter::make();
  a.mesh.corners.resize(4);  // the first quad alone
  a.mesh.normals.resize(4);
  a.mesh.uvs[0].resize(4);
  a.mesh.colors.clear();
  a.mesh.face_begin = {0, 4};
  a.mesh.face_material.resize(1);
  a.mesh.face_part.resize(1);
  Character b = a;
  PolygonMesh& mesh = b.mesh;
  const auto pick = [](const auto& of, const auto& items) {
    std::decay_t<decltype(items)> picked;
    for (const std::size_t i : of) picked.push_back(items[i]);
    return picked;
  };
  const std::array<std::size_t, 6> split = {0, 1, 2, 0, 2, 3};
  mesh.corners = pick(split, a.mesh.corners);
  mesh.normals = pick(split, a.mesh.normals);
  mesh.uvs[0] = pick(split, a.mesh.uvs[0]);
  mesh.face_begin = {0, 3, 6};
  mesh.face_material.assign(2, a.mesh.face_material[0]);
  mesh.face_part.assign(2, PartId(0));
  for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)}) {
    const GeometryDiff found = compare(one, other);
    EXPECT_EQ(found.normals_deg.max, 0);
    EXPECT_EQ(found.uvs.max, 0);
    EXPECT_EQ(found.uvs.compared, one.mesh.corner_count());
  }
}

}  // namespace
}  // namespace skinforge
