#include "surface/assemble.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "surface/two_cubes.h"

namespace skinforge {
namespace {

using ::testing::ElementsAre;
using testing::TwoCubes;

// Attributes that tell each corner apart; source 0 alone has UVs and colours.
void mark(TwoCubes& cubes) {
  PolygonMesh& lower = cubes.meshes[0];
  lower.uvs.resize(1);
  for (std::size_t c = 0; c < lower.corner_count(); ++c) {
    lower.uvs[0].emplace_back(0.1 * double(c), 1 - 0.1 * double(c));
    lower.colors.emplace_back(0.01 * double(c), 0.5, 0, 1);
  }
  for (std::size_t f = 0; f < 6; ++f) lower.face_material[f] = MaterialId(f);
}

// Two cubes of five faces and four walls: 16 vertices, closed like a ball, so the border is shared by index.
TEST(AssembleSurface, ClosedByIndex) {
  const TwoCubes cubes;
  const JoinedSurface joined = cubes.joined(cubes.walls());
  const MeshTopology topology = measure_topology(joined.mesh);
  EXPECT_EQ(topology.vertices, 16u);
  EXPECT_EQ(joined.mesh.vertex_count(), 16u);
  EXPECT_EQ(topology.quads, 14u);  // the walls' triangles are paired
  EXPECT_EQ(topology.boundary_edges + topology.non_manifold_edges, 0u);
  EXPECT_EQ(topology.euler, 2);
}

TEST(AssembleSurface, PreservedCornersAreExact) {
  TwoCubes cubes;
  mark(cubes);
  const JoinedSurface joined = cubes.joined(cubes.walls());
  const PolygonMesh& mesh = joined.mesh;
  ASSERT_EQ(joined.faces.size(), mesh.face_count());
  std::size_t preserved = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const ResultFace& origin = joined.faces[f];
    if (!origin.source.is_valid()) continue;
    ++preserved;
    EXPECT_EQ(origin.site, -1);
    const PolygonMesh& from = *cubes.sources[origin.source.index()].mesh;
    EXPECT_EQ(mesh.face_material[f], from.face_material[origin.face.index()]);
    const std::size_t first = mesh.first_corner(FaceId(f)), first_from = from.first_corner(origin.face);
    for (std::size_t k = 0; k < mesh.face(FaceId(f)).size(); ++k) {
      const VertexId v = mesh.corners[first + k];
      EXPECT_EQ(joined.vertices[v.index()].source, origin.source);
      EXPECT_EQ(joined.vertices[v.index()].vertex, from.corners[first_from + k]);
      EXPECT_EQ(mesh.positions[v.index()], from.positions[from.corners[first_from + k].index()]);
      EXPECT_EQ(mesh.normals[first + k], from.normals[first_from + k]);
      EXPECT_EQ(mesh.uvs[0][first + k], from.uvs.empty() ? Vec2(0, 0) : from.uvs[0][first_from + k]);
      EXPECT_EQ(mesh.colors[first + k], from.colors.empty() ? Vec4(1, 1, 1, 1) : from.colors[first_from + k]);
    }
  }
  EXPECT_EQ(preserved, 10u);
}

// The four vertices of either border and the four new ones belong to junction 0, the others to none.
TEST(AssembleSurface, HistoryOfTheJunction) {
  const TwoCubes cubes;
  const JoinedSurface joined = cubes.joined(cubes.halved_walls());
  std::size_t border = 0, made = 0;
  for (const ResultVertex& v : joined.vertices) {
    border += v.source.is_valid() && v.site == 0;
    made += !v.source.is_valid() && v.site == 0 && !v.vertex.is_valid();
  }
  EXPECT_EQ(joined.vertices.size(), 20u);
  EXPECT_EQ(border, 8u);
  EXPECT_EQ(made, 4u);
  EXPECT_THAT(joined.first_part, ElementsAre(PartId(0), PartId(1)));
  EXPECT_THAT(joined.junction_part, ElementsAre(PartId(2)));
  EXPECT_EQ(joined.mesh.parts[2].name, "junction1");
  for (std::size_t f = 0; f < joined.faces.size(); ++f) {
    if (joined.faces[f].site < 0) continue;
    EXPECT_FALSE(joined.faces[f].source.is_valid() || joined.faces[f].face.is_valid());
    EXPECT_FALSE(joined.mesh.face_material[f].is_valid());
    EXPECT_EQ(joined.mesh.face_part[f], PartId(2));
  }
}

// The cubes are flat shaded, so the walls are: their normals point straight out.
TEST(AssembleSurface, FlatNeighboursMakeAFlatJunction) {
  const TwoCubes cubes;
  const JoinedSurface joined = cubes.joined(cubes.walls());
  for (std::size_t f = 0; f < joined.faces.size(); ++f)
    for (std::size_t c = joined.mesh.first_corner(FaceId(f)); joined.faces[f].site == 0 && c < 4 * (f + 1);
         ++c)
      EXPECT_LT((joined.mesh.normals[c] - area_normal(joined.mesh, FaceId(f)).normalized()).norm(), 1e-12);
}

// With normals that point away from the box's axis the walls take them over: no step of shading at the
// border.
TEST(AssembleSurface, SmoothNeighboursGiveTheirNormals) {
  TwoCubes cubes;
  const auto outward = [](const Vec3& p) { return Vec3(p.x() - 0.5, p.y() - 0.5, 0).normalized(); };
  for (PolygonMesh& mesh : cubes.meshes)
    for (std::size_t c = 0; c < mesh.corner_count(); ++c)
      mesh.normals[c] = outward(mesh.positions[mesh.corners[c].index()]);
  const JoinedSurface joined = cubes.joined(cubes.walls());
  for (std::size_t f = 0; f < joined.faces.size(); ++f)
    for (std::size_t c = joined.mesh.first_corner(FaceId(f)); joined.faces[f].site == 0 && c < 4 * (f + 1);
         ++c)
      EXPECT_LT(
          (joined.mesh.normals[c] - outward(joined.mesh.positions[joined.mesh.corners[c].index()])).norm(),
          1e-12);
}

// As triangles: eight of the four walls, halved as they were judged.
TEST(AssembleSurface, Triangles) {
  const TwoCubes cubes;
  Junction junction;
  junction.loops = cubes.loops;
  junction.patch = cubes.walls();
  junction.quads = 4;
  const std::vector<JunctionElements> wanted = {JunctionElements::Triangles};
  const JoinedSurface joined = assemble_surface(cubes.sources, std::vector<Junction>{junction}, wanted);
  const MeshTopology topology = measure_topology(joined.mesh);
  EXPECT_EQ(topology.quads, 10u);  // of the cubes
  EXPECT_EQ(joined.mesh.face_count(), 18u);
  EXPECT_EQ(topology.boundary_edges + topology.non_manifold_edges, 0u);
  EXPECT_EQ(topology.euler, 2);
}

TEST(AssembleSurface, WithoutAJunctionOnlyPreservedFaces) {
  const TwoCubes cubes;
  const JoinedSurface joined = cubes.joined({});
  EXPECT_EQ(joined.mesh.face_count(), 10u);
  EXPECT_EQ(joined.mesh.parts.size(), 2u);
  EXPECT_FALSE(joined.junction_part[0].is_valid());
}

}  // namespace
}  // namespace skinforge
