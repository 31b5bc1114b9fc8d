#include "geometry/quad_pairing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "testing/assets.h"
#include "testing/gltf_mesh.h"
#include "testing/shapes.h"

namespace skinforge {
namespace {

// n x n unit quads in the plane, each split into two triangles along its rising diagonal.
PolygonMesh split_grid(int n) {
  std::vector<Vec3> positions;
  std::vector<std::vector<int>> faces;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) positions.emplace_back(x, y, 0);
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const int a = y * (n + 1) + x, b = a + 1, d = a + n + 1, c = d + 1;
      faces.push_back({a, b, c});
      faces.push_back({a, c, d});
    }
  return testing::polygon_mesh(positions, faces);
}

std::size_t quads(const PolygonMesh& mesh) {
  std::size_t count = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) count += mesh.face(FaceId(f)).size() == 4;
  return count;
}

std::vector<VertexId> vertices(const PolygonMesh& mesh, std::size_t f) {
  const auto face = mesh.face(FaceId(f));
  return {face.begin(), face.end()};
}

// The quad begins at an end of the diagonal 0-3 (positions 0,0 and 1,1) and turns as its triangles did.
TEST(RecoverQuads, OneSquareByHand) {
  const PolygonMesh result = recover_quads(split_grid(1));
  ASSERT_EQ(result.face_count(), 1u);
  const std::vector<VertexId> quad = vertices(result, 0);
  const std::vector<VertexId> from_first = {VertexId(0), VertexId(1), VertexId(3), VertexId(2)};
  const std::vector<VertexId> from_third = {VertexId(3), VertexId(2), VertexId(0), VertexId(1)};
  EXPECT_TRUE(quad == from_first || quad == from_third);
}

// Flat shading: the two triangles keep their own normals beside the mean that the quad's corners get.
TEST(RecoverQuads, SplitNormalsAreTheTriangles) {
  PolygonMesh folded = split_grid(1);
  const Vec3 up(0, 0, 1), tilted = Vec3(0, 0.6, 0.8);
  for (std::size_t c = 0; c < 6; ++c) folded.normals[c] = c < 3 ? up : tilted;
  const PolygonMesh result = recover_quads(folded);
  ASSERT_EQ(quads(result), 1u);
  const SplitNormals* split = result.split_of(FaceId(0));
  ASSERT_NE(split, nullptr);
  const bool first_is_up = vertices(result, 0)[1] == VertexId(1);  // only the first triangle has vertex 1
  EXPECT_EQ(split->first[0], first_is_up ? up : tilted);
  EXPECT_EQ(split->first[1], first_is_up ? up : tilted);
  EXPECT_EQ(split->second[0], first_is_up ? tilted : up);
  EXPECT_EQ(split->second[1], first_is_up ? tilted : up);
  EXPECT_TRUE(recover_quads(split_grid(1)).split.empty());
}

TEST(RecoverQuads, GridComesBackWhole) {
  const PolygonMesh result = recover_quads(split_grid(6));
  EXPECT_EQ(result.face_count(), 36u);
  EXPECT_EQ(quads(result), 36u);
  EXPECT_EQ(result.normals.size(), result.corner_count());
}

TEST(RecoverQuads, SeamsMaterialsAndPartsForbid) {
  PolygonMesh uv = split_grid(1);
  uv.uvs.push_back(std::vector<Vec2>(6, Vec2(0.5, 0.5)));
  EXPECT_EQ(quads(recover_quads(uv)), 1u);
  uv.uvs[0][3] = Vec2(0.6, 0.5);  // vertex 0 in the second triangle
  EXPECT_EQ(quads(recover_quads(uv)), 0u);
  PolygonMesh color = split_grid(1);
  color.colors.assign(6, Vec4::Ones());
  EXPECT_EQ(quads(recover_quads(color)), 1u);
  color.colors[4] = Vec4(1, 1, 0.9, 1);  // vertex 3 in the second triangle
  EXPECT_EQ(quads(recover_quads(color)), 0u);
  PolygonMesh material = split_grid(1);
  material.face_material[1] = MaterialId(0);
  EXPECT_EQ(quads(recover_quads(material)), 0u);
  PolygonMesh part = split_grid(1);
  part.parts.resize(2);
  part.face_part[1] = PartId(1);
  EXPECT_EQ(quads(recover_quads(part)), 0u);
}

// Flat shading gives every triangle its own normal; the quad keeps them at its tips and takes the mean on the
// diagonal.
TEST(RecoverQuads, FlatShadedTrianglesPair) {
  PolygonMesh mesh = split_grid(1);
  const Vec3 first = Vec3(0.1, 0, 1).normalized(), second = Vec3(-0.1, 0, 1).normalized();
  for (int c = 0; c < 6; ++c) mesh.normals[c] = c < 3 ? first : second;
  const PolygonMesh result = recover_quads(mesh);
  ASSERT_EQ(quads(result), 1u);
  for (std::size_t c = 0; c < 4; ++c) {
    const VertexId v = result.corners[c];
    const Vec3 expected = v == VertexId(1) ? first : v == VertexId(2) ? second : Vec3::UnitZ();
    EXPECT_TRUE(result.normals[c].isApprox(expected, 1e-12)) << v.value;
  }
}

TEST(RecoverQuads, BentFoldedAndOppositePairsStay) {
  // Two faces of a right angle, a dart, two triangles on one side that overlap, and two that turn different
  // ways.
  EXPECT_EQ(quads(recover_quads(
                testing::polygon_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {1, 0, 3}}))),
            0u);
  EXPECT_EQ(quads(recover_quads(testing::polygon_mesh({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, 0}},
                                                      {{0, 1, 3}, {0, 3, 2}}))),
            0u);
  EXPECT_EQ(quads(recover_quads(
                testing::polygon_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {1, 0, 3}}))),
            0u);
  EXPECT_EQ(quads(recover_quads(
                testing::polygon_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 3, 2}}))),
            0u);
}

TEST(RecoverQuads, OtherPolygonsAndOrderStay) {
  const PolygonMesh mesh = testing::polygon_mesh(
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}, {3, 0, 0}, {4, 1, 0}},
      {{0, 1, 2, 3}, {1, 4, 5}, {4, 6, 7, 5}, {1, 5, 2}});
  const PolygonMesh result = recover_quads(mesh);
  ASSERT_EQ(result.face_count(), 3u);
  EXPECT_EQ(vertices(result, 0), vertices(mesh, 0));
  EXPECT_EQ(vertices(result, 2), vertices(mesh, 2));
  EXPECT_EQ(result.face(FaceId(1)).size(), 4u);
}

// A strip of three triangles can pair two ways of equal score: those that follow each other in the file win.
TEST(RecoverQuads, FollowersComeFirst) {
  const std::vector<Vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}};
  const PolygonMesh first =
      recover_quads(testing::polygon_mesh(positions, {{0, 1, 2}, {1, 3, 2}, {0, 0, 0}, {2, 3, 4}}));
  const PolygonMesh last =
      recover_quads(testing::polygon_mesh(positions, {{0, 1, 2}, {0, 0, 0}, {1, 3, 2}, {2, 3, 4}}));
  EXPECT_EQ(first.face(FaceId(0)).size(), 4u);
  EXPECT_EQ(last.face(FaceId(0)).size(), 3u);
  EXPECT_EQ(quads(last), 1u);
}

TEST(RecoverQuads, EmptyMesh) {
  EXPECT_EQ(recover_quads(testing::polygon_mesh({}, {})).face_count(), 0u);
}

// A fan from the first corner of each quad gives the triangles of the input back.
std::vector<std::array<std::int32_t, 3>> fan_triangles(const PolygonMesh& mesh) {
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(FaceId(f));
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
      std::array<std::int32_t, 3> t = {face[0].value, face[i].value, face[i + 1].value};
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      triangles.push_back(t);
    }
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

struct Asset {
  const char* file;
  double least_share;  // of the triangles that end in quads: measured (quad_pairing.md), less two points
};

TEST(RecoverQuads, RealCharacters) {
  SKINFORGE_NEEDS_SHARED();
  const Asset assets[] = {{"quaternius_horse/horse.glb", 0.95},
                          {"quaternius_dolphin/dolphin.glb", 0.93},
                          {"quaternius_trex/trex.glb", 0.82},
                          {"kaykit_knight/knight.glb", 0.91},
                          {"quaternius_robot_expressive/robot_expressive.glb", 0.91}};
  for (const Asset& asset : assets) {
    const PolygonMesh mesh =
        testing::GlbMesh::read(testing::shared_file(std::string("assets/") + asset.file));
    const PolygonMesh result = recover_quads(mesh);
    const double share = 2.0 * static_cast<double>(quads(result)) / static_cast<double>(mesh.face_count());
    RecordProperty(asset.file, std::to_string(share));
    EXPECT_GE(share, asset.least_share) << asset.file;
    EXPECT_EQ(fan_triangles(result), fan_triangles(mesh)) << asset.file;
  }
}

}  // namespace
}  // namespace skinforge
