#include "render/subject.h"

#include <gmock/gmock.h>

#include "render/shapes.h"

namespace skinforge {
namespace {

using testing::add_face;
using testing::add_square;
using testing::empty_mesh;
using testing::torus;

constexpr double kRounding = 1e-9;  // sums of a few cross products

// A quad becomes two triangles; four of their six sides are edges of the quad, the diagonal is none.
TEST(Subject, DiagonalsAreNoPolygonEdges) {
  PolygonMesh mesh = empty_mesh();
  add_square(mesh, 1, 0);
  const Subject subject(mesh, {});
  ASSERT_EQ(subject.triangles().size(), 2U);
  int edges = 0;
  for (std::size_t t = 0; t < 2; ++t) {
    int here = 0;
    for (int i = 0; i < 3; ++i) here += subject.is_polygon_edge(t, i) ? 1 : 0;
    EXPECT_EQ(here, 2);
    edges += here;
  }
  EXPECT_EQ(edges, 4);
}

TEST(Subject, AllSidesOfATriangleAreEdges) {
  PolygonMesh mesh = empty_mesh();
  const std::array<Vec3, 3> corners{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  add_face(mesh, corners);
  const Subject subject(mesh, {});
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(subject.is_polygon_edge(0, i));
}

// Turning a smooth shape turns its normals; at rest they come out close to the true ones of the torus.
TEST(Subject, NormalsFollowARotation) {
  const PolygonMesh mesh = torus();
  const Subject subject(mesh, {});
  const Quat turn = quaternion_xyzw(0.1, 0.7, -0.3, 0.6).normalized();
  std::vector<Vec3> turned;
  for (const Vec3& p : mesh.positions) turned.push_back(turn * p + Vec3(3, 4, 5));
  const auto rest = subject.normals_at(mesh.positions), moved = subject.normals_at(turned);
  for (std::size_t c = 0; c < rest.size(); ++c) {
    EXPECT_TRUE(moved[c].isApprox(turn * rest[c], kRounding));
    EXPECT_GT(rest[c].dot(mesh.normals[c]), 0.99);
  }
}

// Two squares that share an edge at a right angle, with a normal each: the edge stays hard.
TEST(Subject, HardEdgesStayHard) {
  PolygonMesh mesh = empty_mesh();
  add_square(mesh, 1, 0);
  const std::array<Vec3, 4> side{Vec3(1, -1, 0), Vec3(1, -1, -2), Vec3(1, 1, -2), Vec3(1, 1, 0)};
  add_face(mesh, side);
  mesh.corners[4] = mesh.corners[1];  // weld the common edge
  mesh.corners[7] = mesh.corners[2];
  const auto normals = Subject(mesh, {}).normals_at(mesh.positions);
  EXPECT_TRUE(normals[1].isApprox(Vec3(0, 0, 1)));
  EXPECT_TRUE(normals[4].isApprox(Vec3(1, 0, 0)));
}

TEST(Subject, FacesWithoutMaterialGetADullWhite) {
  PolygonMesh mesh = empty_mesh();
  add_square(mesh, 1, 0, MaterialId());
  const Subject subject(mesh, {});
  EXPECT_EQ(subject.material_of(FaceId(0)).base_color, Vec4(1, 1, 1, 1));
  EXPECT_EQ(subject.material_of(FaceId(0)).metallic, 0);
}

}  // namespace
}  // namespace skinforge
