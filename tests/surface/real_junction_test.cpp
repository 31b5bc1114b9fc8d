// Junctions on the body of a real character, cut through the left forearm (along x, the arms hang outwards).
#include <gtest/gtest.h>

#include "surface/junction_measures.h"
#include "surface/junction_scene.h"
#include "testing/assets.h"
#include "testing/gltf_mesh.h"

namespace skinforge {
namespace {

constexpr double kCut = 0.35;        // metres, half way down the forearm
constexpr double kHalfWidth = 0.03;  // metres, about two of its edges

PolygonMesh human() {
  return testing::GlbMesh::read(testing::repository_file("data/human.glb"));
}

double body_weight(double x) {
  return testing::falling((x - kCut) / kHalfWidth);
}

// The human's own forearm, a tenth thinner, in the place of the old one.
testing::JunctionScene replaced_forearm() {
  testing::SceneInput host{human(), body_weight, true, true};
  testing::SceneInput donor{human(), [](double x) { return 1 - body_weight(x); }};
  const Vec3 centre(kCut, 1.04, -0.005);
  for (Vec3& p : donor.mesh.positions) p = centre + 0.9 * (p - centre);
  return testing::junction_scene({host, donor});
}

double largest(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

TEST(RealJunction, ForearmReplaced) {
  const auto scene = replaced_forearm();
  ASSERT_EQ(scene.loops.size(), 2u);
  EXPECT_TRUE(scene.arcs.empty());
  const Junction junction = scene.junction();
  EXPECT_EQ(junction.rung, JunctionRung::Tube) << junction.reason;
  EXPECT_FALSE(junction.faults.any()) << describe(junction.faults);
  EXPECT_EQ(testing::topology_of(junction.patch).euler, 0);
  EXPECT_EQ(testing::chord_count(junction.patch), 0);
  const JoinedSurface joined = assemble_surface(scene.sources, std::vector<Junction>{junction});
  const JunctionMeasures m = measure_junction(joined, 0, &scene.field.distance);
  EXPECT_EQ(m.components, 1u);
  EXPECT_EQ(m.boundary_edges + m.non_manifold_edges + m.degenerate_faces + m.self_intersections, 0u);
  EXPECT_EQ(m.folded_faces, 0u);
  EXPECT_EQ(m.border_dihedral.size(), scene.loops[0].vertices.size() + scene.loops[1].vertices.size());
  // Measured: 6 and 20 degrees, 0.22 voxels, 0.81 and 0.92; bounds about half as much again.
  EXPECT_LT(mean(m.border_dihedral), radians(10));
  EXPECT_LT(largest(m.border_dihedral), radians(35));
  EXPECT_LT(largest(m.deviation), 0.35);  // voxels
  EXPECT_GT(mean(m.scaled_jacobian), 0.7);
  EXPECT_NEAR(mean(m.edge_length_ratio), 1, 0.2);
}

// Every preserved face comes through with its corners untouched, and only the junction's surroundings went.
TEST(RealJunction, PreservedFacesStayExact) {
  const auto scene = replaced_forearm();
  const JoinedSurface joined = assemble_surface(scene.sources, std::vector<Junction>{scene.junction()});
  std::vector<std::size_t> preserved(2, 0);
  for (std::size_t f = 0; f < joined.faces.size(); ++f) {
    const ResultFace& origin = joined.faces[f];
    if (!origin.source.is_valid()) continue;
    ++preserved[origin.source.index()];
    const PolygonMesh& from = scene.meshes[origin.source.index()];
    const auto face = joined.mesh.face(FaceId(f)), old = from.face(origin.face);
    for (std::size_t k = 0; k < face.size(); ++k) {
      EXPECT_EQ(joined.mesh.positions[face[k].index()], from.positions[old[k].index()]);
      EXPECT_EQ(joined.mesh.normals[joined.mesh.first_corner(FaceId(f)) + k],
                from.normals[from.first_corner(origin.face) + k]);
    }
  }
  std::size_t wanted = 0;
  for (std::size_t f = 0; f < scene.meshes[0].face_count(); ++f) {
    const auto face = scene.meshes[0].face(FaceId(f));
    wanted += std::all_of(face.begin(), face.end(), [&](VertexId v) {
      return scene.meshes[0].positions[v.index()].x() < kCut - 3 * kHalfWidth;
    });
  }
  EXPECT_GE(preserved[0], wanted);
  EXPECT_LT(preserved[0], scene.meshes[0].face_count());
  EXPECT_GT(preserved[1], 0u);
}

TEST(RealJunction, ForearmRemoved) {
  const auto scene = testing::junction_scene({{human(), body_weight, true, true}});
  ASSERT_EQ(scene.loops.size(), 1u);
  const Junction junction = scene.junction();
  EXPECT_EQ(junction.rung, JunctionRung::Cap);
  EXPECT_FALSE(junction.faults.any()) << describe(junction.faults);
  EXPECT_EQ(testing::topology_of(junction.patch).euler, 1);
  const JoinedSurface joined = assemble_surface(scene.sources, std::vector<Junction>{junction});
  const JunctionMeasures m = measure_junction(joined, 0, nullptr);
  EXPECT_EQ(m.boundary_edges + m.non_manifold_edges + m.self_intersections, 0u);
}

}  // namespace
}  // namespace skinforge
