#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "finished_character.h"
#include "testing/assets.h"
#include "testing/posed_points.h"
#include "testing/scaled_glb.h"
#include "testing/temporary_folder.h"

// No length is absolute: inputs of any size give the same character of that size.
namespace skinforge {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using testing::FinishedCharacter;

constexpr double kSamePlace = 1e-6;  // of the diagonal; the inputs are floats that were rounded once more

// A recipe of this repository with all lengths multiplied; inputs that it takes as FBX are read as GLB.
fs::path scaled_recipe(const std::string& name, double factor, const fs::path& folder) {
  const fs::path original = testing::repository_file("recipes/" + name + ".json");
  json recipe = json::parse(std::ifstream(original));
  for (auto& [input, file] : recipe.at("inputs").items()) {
    const fs::path source = (original.parent_path() / file.get<std::string>()).replace_extension(".glb");
    testing::ScaledGlb::write(source, folder / (input + ".glb"), factor);
    file = input + ".glb";
  }
  for (json& operation : recipe.at("ops"))
    for (json& x : operation.at("place").at("offset")) x = x.get<double>() * factor;
  // Whether a key is left out at a tolerance may hang on the last bit of the inputs.
  recipe["animation"]["key_tolerance"] = 0;
  std::ofstream(folder / (name + ".json")) << recipe;
  return folder / (name + ".json");
}

// What is counted, not measured.
json counts(const json& report) {
  json found;
  for (const char* key : {"vertices", "faces", "quads", "triangles", "kept_faces", "components"})
    found["mesh"][key] = report.at("mesh").at(key);
  for (const json& junction : report.at("junctions"))
    for (const char* key : {"rung", "border_loops", "faces", "quads", "boundary_edges", "non_manifold_edges"})
      found["junctions"].push_back(junction.at(key));
  for (const json& clip : report.at("clips"))
    for (const char* key : {"name", "keys"}) found["clips"].push_back(clip.at(key));
  found["joint_maps"] = report.at("joint_maps");
  for (json& map : found["joint_maps"])
    for (json& joint : map.at("joints")) joint.erase("confidence");
  return found;
}

double diagonal(const std::vector<Vec3>& points) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : points) box.extend(p);
  return box.diagonal().norm();
}

// As sets: which of two equal charts of a junction's texture comes first, and so the order of vertices, is
// free.
void expect_same_points(const std::vector<Vec3>& points, const std::vector<Vec3>& scaled, double factor) {
  ASSERT_EQ(points.size(), scaled.size());
  std::vector<Vec3> back;
  for (const Vec3& p : scaled) back.push_back(p / factor);
  const double worst = testing::set_distance(points, back);
  EXPECT_LE(worst, kSamePlace * diagonal(points));
}

using Parameters = std::tuple<std::string, double>;

class ScaleLaw : public ::testing::TestWithParam<Parameters> {};

TEST_P(ScaleLaw, ResultsAreAlikeButForTheFactor) {
  const auto& [name, factor] = GetParam();
  const testing::TemporaryFolder here, there;
  const FinishedCharacter plain(scaled_recipe(name, 1, here.path()), here.path());
  const FinishedCharacter scaled(scaled_recipe(name, factor, there.path()), there.path());
  ASSERT_EQ(plain.run().status, 0) << plain.run().err;
  ASSERT_EQ(scaled.run().status, 0) << scaled.run().err;
  EXPECT_EQ(counts(scaled.report()), counts(plain.report()));
  expect_same_points(plain.glb().bind_pose(), scaled.glb().bind_pose(), factor);
  ASSERT_EQ(plain.glb().animation_count(), scaled.glb().animation_count());
  for (int a = 0; a < plain.glb().animation_count(); ++a) {
    SCOPED_TRACE(plain.glb().animation_name(a));
    const double time = plain.glb().duration(a) / 3;
    expect_same_points(plain.glb().pose(a, time), scaled.glb().pose(a, time), factor);
  }
}

std::string test_name(const ::testing::TestParamInfo<Parameters>& info) {
  const double factor = std::get<1>(info.param);
  const std::string size = factor > 1 ? "times_" + std::to_string(std::lround(factor))
                                      : "divided_by_" + std::to_string(std::lround(1 / factor));
  return std::get<0>(info.param) + "_" + size;
}

// Powers of two change no digit: only an absolute length could make a difference.
INSTANTIATE_TEST_SUITE_P(ExactFactors, ScaleLaw,
                         ::testing::Combine(::testing::Values("tail", "centaur"),
                                            ::testing::Values(128.0, 1.0 / 128)),
                         test_name);

// 100 and 0.01 round the inputs once more: no choice may hang on the last bit, and no step may enlarge it.
INSTANTIATE_TEST_SUITE_P(RoundedFactors, ScaleLaw,
                         ::testing::Combine(::testing::Values("tail", "centaur", "head_swap", "winged_horse",
                                                              "composite", "mermaid", "four_armed"),
                                            ::testing::Values(100.0, 0.01)),
                         test_name);

}  // namespace
}  // namespace skinforge
