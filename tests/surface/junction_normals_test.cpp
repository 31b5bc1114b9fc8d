#include "surface/junction_normals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "surface/junction_measures.h"
#include "surface/junction_scene.h"
#include "surface/two_cubes.h"
#include "testing/assets.h"
#include "testing/gltf_mesh.h"

namespace skinforge {
namespace {

using testing::TwoCubes;
constexpr double kRounding = 1e-7;  // radians; acos-free, but normals are of float files

double largest(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

// Normals that point away from the axis of the box; `side`: those of the walls -x and +x are kept hard.
void shade(TwoCubes& cubes, bool hard_sides) {
  for (PolygonMesh& mesh : cubes.meshes)
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
      for (std::size_t c = 4 * f; c < 4 * (f + 1); ++c) {
        const Vec3& p = mesh.positions[mesh.corners[c].index()];
        const bool is_side = std::abs(area_normal(mesh, FaceId(f)).normalized().x()) > 0.5;
        const Vec3 round = Vec3(0.3 * (p.x() - 0.5), p.y() - 0.5, 0).normalized();
        mesh.normals[c] = hard_sides && is_side ? Vec3(p.x() > 0.5 ? 1 : -1, 0, 0) : round;
      }
}

TEST(JunctionNormals, NoStepAtASmoothBorder) {
  TwoCubes cubes;
  shade(cubes, false);
  const auto steps = border_normal_steps(cubes.joined(cubes.halved_walls()), 0);
  EXPECT_EQ(steps.size(), 16u);  // two ends of eight border edges
  EXPECT_LT(largest(steps), kRounding);
}

// The edges along z are hard, and the walls went on beyond the border as they were: every wall of the
// junction has the normals of the wall below it and above it.
TEST(JunctionNormals, HardEdgesRunOnIntoTheJunction) {
  std::vector<PolygonMesh> tubes;
  for (const double z : {0.0, 3.0}) {
    std::vector<Vec3> positions;
    for (int level = 0; level < 3; ++level)
      for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
        positions.emplace_back(x, y, z + level);
    std::vector<std::vector<int>> faces;
    for (int level = 0; level < 2; ++level)
      for (int k = 0; k < 4; ++k)
        faces.push_back(
            {4 * level + k, 4 * level + (k + 1) % 4, 4 * level + 4 + (k + 1) % 4, 4 * level + 4 + k});
    tubes.push_back(testing::polygon_mesh(positions, faces));
    for (std::size_t f = 0; f < 8; ++f)  // leaning, so that no face is flat
      for (std::size_t c = 4 * f; c < 4 * (f + 1); ++c)
        tubes.back().normals[c] =
            (area_normal(tubes.back(), FaceId(f)).normalized() + Vec3(0, 0, 0.3)).normalized();
  }
  std::vector<PreservedSource> sources;
  Junction junction;
  for (std::size_t s = 0; s < 2; ++s) {
    sources.push_back({&tubes[s], {}});
    for (std::size_t f = 0; f < 8; ++f) {
      const bool stays = (f < 4) == (s == 0);
      sources[s].selection.kept.push_back(stays);
      sources[s].selection.face_site.push_back(stays ? -1 : 0);
    }
    std::vector<JunctionLoop> arcs;
    for (JunctionLoop& loop :
         loops_of_sites(sources[s], SourceId(s), std::vector<std::size_t>{0}, s == 0, arcs))
      if (loop.positions[0].z() > 0.5 && loop.positions[0].z() < 4.5)
        junction.loops.push_back(std::move(loop));
  }
  ASSERT_EQ(junction.loops.size(), 2u);
  for (const JunctionLoop& loop : junction.loops)
    junction.patch.positions.insert(junction.patch.positions.end(), loop.positions.begin(),
                                    loop.positions.end());
  junction.patch.fixed = 8;
  for (int i = 0; i < 4; ++i) {
    const auto above = [&](int k) {
      for (int v = 4; v < 8; ++v)
        if ((junction.patch.positions[v] - junction.patch.positions[k]).head<2>().norm() < 0.1) return v;
      return -1;
    };
    const int j = (i + 1) % 4;
    TwoCubes::add_quad(junction.patch, i, j, above(j), above(i));
  }
  junction.quads = 4;
  const JoinedSurface joined = assemble_surface(sources, std::vector<Junction>{junction});
  const auto steps = border_normal_steps(joined, 0);
  EXPECT_EQ(steps.size(), 16u);
  EXPECT_LT(largest(steps), kRounding);
  for (std::size_t f = 0; f < joined.faces.size(); ++f) {  // four different walls, each even
    if (joined.faces[f].site != 0) continue;
    for (std::size_t c = joined.mesh.first_corner(FaceId(f)); c < joined.mesh.first_corner(FaceId(f)) + 4;
         ++c)
      EXPECT_EQ(joined.mesh.normals[c], joined.mesh.normals[joined.mesh.first_corner(FaceId(f))]);
  }
}

// A border that was a hard edge of the input stays hard: the junction has its own normals there.
TEST(JunctionNormals, AHardBorderStaysHard) {
  TwoCubes cubes;
  shade(cubes, false);
  for (PolygonMesh& mesh : cubes.meshes)
    for (std::size_t c = 0; c < 8; ++c) mesh.normals[c] = area_normal(mesh, FaceId(c / 4)).normalized();
  const JoinedSurface joined = cubes.joined(cubes.walls());
  EXPECT_GT(largest(border_normal_steps(joined, 0)), 0.1);
}

// Of a quad that was two triangles each side shows the normals of its own triangle.
TEST(JunctionNormals, SplitQuadsShowTheirTriangles) {
  PolygonMesh mesh = testing::quad_cube();
  const Vec3 a(1, 0, 0), b(0, 1, 0);
  mesh.split.push_back({FaceId(2), {a, a}, {b, b}});
  EXPECT_EQ(normal_along(mesh, FaceId(2), 0, 0), a);
  EXPECT_EQ(normal_along(mesh, FaceId(2), 2, 1), a);
  EXPECT_EQ(normal_along(mesh, FaceId(2), 2, 2), b);
  EXPECT_EQ(normal_along(mesh, FaceId(2), 0, 3), b);
  EXPECT_EQ(normal_along(mesh, FaceId(2), 1, 1), mesh.normals[9]);
}

// A real smooth body, cut through the forearm.
TEST(JunctionNormals, NoStepOnARealBody) {
  const auto body = [](double x) { return testing::falling((x - 0.35) / 0.03); };
  const PolygonMesh human = testing::GlbMesh::read(testing::repository_file("data/human.glb"));
  testing::SceneInput host{human, body, true, true};
  testing::SceneInput donor{human, [&](double x) { return 1 - body(x); }};
  const auto scene = testing::junction_scene({host, donor});
  const JoinedSurface joined = assemble_surface(scene.sources, std::vector<Junction>{scene.junction()});
  const auto steps = border_normal_steps(joined, 0);
  EXPECT_EQ(steps.size(), 2 * (scene.loops[0].vertices.size() + scene.loops[1].vertices.size()));
  EXPECT_LT(largest(steps), kRounding);
}

}  // namespace
}  // namespace skinforge
