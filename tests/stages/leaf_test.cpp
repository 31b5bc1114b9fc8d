// A build of sheets: what is cut from hem to hem is joined, skinned, shaded and written like any other part.
#include <gtest/gtest.h>

#include <fstream>

#include "io/export.h"
#include "stages/built_recipe.h"
#include "surface/shapes.h"
#include "testing/temporary_folder.h"

namespace skinforge {
namespace {

// A leaf along x that bends about its middle.
Character leaf(int across) {
  Character c;
  c.name = "leaf";
  c.mesh = testing::sheet_along_x(24, across, -3, 0.25);
  c.mesh.normals.assign(c.mesh.corner_count(), -Vec3::UnitY());
  for (const char* name : {"stalk", "blade"}) {
    Joint joint;
    joint.name = name;
    joint.parent = c.skeleton.joints.empty() ? JointId() : JointId(0);
    joint.bind.translation = joint.parent.is_valid() ? Vec3(3, 0, 0) : Vec3(-3, 0, 0);
    joint.joint_from_model = Affine3(Eigen::Translation3d(-(joint.parent.is_valid() ? 0.0 : -3.0), 0, 0));
    c.skeleton.joints.push_back(joint);
  }
  for (const Vec3& p : c.mesh.positions) {
    const double blade = std::clamp(0.5 + p.x(), 0.0, 1.0);
    c.weights.push_row(normalised_row({{JointId(0), 1 - blade}, {JointId(1), blade}}));
  }
  return c;
}

TEST(Leaf, HalfOfOneGoesOnInHalfOfAnother) {
  const testing::TemporaryFolder folder;
  for (const auto& [name, across] : {std::pair("narrow.glb", 4), {"wide.glb", 6}}) {
    const Bytes glb = write_glb(leaf(across));
    std::ofstream(folder / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(glb.data()), static_cast<std::streamsize>(glb.size()));
  }
  const nlohmann::json recipe = {
      {"recipe_version", 1},
      {"name", "leaf"},
      {"base", "narrow"},
      {"inputs", {{"narrow", "narrow.glb"}, {"wide", "wide.glb"}}},
      {"ops", {{{"op", "replace"}, {"at", "blade"}, {"from", "wide"}, {"joint", "blade"}}}}};
  testing::BuiltRecipe built(recipe, (folder / "leaf.json").string());
  ASSERT_TRUE(built.is_ok());
  const ArtifactNames names;
  const auto surface = built.get<SurfaceResult>(names.surface());
  EXPECT_EQ(surface.junctions[0].rung, JunctionRung::Strip) << surface.junctions[0].reason;
  EXPECT_FALSE(surface.junctions[0].faults.any());
  EXPECT_EQ(surface.arcs[0], 0);
  const auto result = built.get<Character>(names.result());
  const MeshTopology topology = measure_topology(result.mesh);
  EXPECT_EQ(topology.components, 1u);
  EXPECT_EQ(topology.euler, 1);
  for (const Vec3& n : result.mesh.normals) EXPECT_NEAR(n.y(), -1, 1e-3);
}

}  // namespace
}  // namespace skinforge
