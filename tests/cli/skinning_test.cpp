#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "testing/assets.h"
#include "testing/gltf_evaluator.h"
#include "testing/program.h"
#include "testing/temporary_folder.h"

// bind, deform and compare-skinning as a person runs them, on a small model written here.
namespace skinforge {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using testing::Program;
using testing::ProgramResult;

/// A square bar along x in 16 rings with a chain of two bones, and a clip that bends the second.
class SkinningVerbs : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string obj;
    for (int i = 0; i <= 16; ++i)
      for (const char* corner : {"-0.2 -0.2", "0.2 -0.2", "0.2 0.2", "-0.2 0.2"})
        obj += "v " + std::to_string(i / 8.0) + " " + corner + "\n";
    const auto at = [](int v) { return " " + std::to_string(v + 1); };
    for (int i = 0; i < 16; ++i)
      for (int j = 0; j < 4; ++j) {
        const int a = 4 * i + j, b = 4 * i + (j + 1) % 4;
        obj += "f" + at(a) + at(b) + at(b + 4) + at(a + 4) + "\n";
      }
    obj += "f 1 4 3 2\nf 65 66 67 68\n";
    write("bar.obj", obj);
    write("bar.tgf", "1 0 0 0\n2 1 0 0\n3 2 0 0\n#\n1 2\n2 3\n");
    write("bend.dmat", "4 4\n0 0 0 0\n0 0 0 0\n0 0 0 0.70710678\n1 1 1 0.70710678\n");
  }
  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }

  ProgramResult run(std::vector<std::string> arguments) {
    return Program(SKINFORGE_BINARY, std::move(arguments), folder_.path()).finish();
  }

  testing::TemporaryFolder folder_;
};

TEST_F(SkinningVerbs, BindWritesACharacterThatMoves) {
  const ProgramResult result =
      run({"bind", "bar.obj", "--skeleton", "bar.tgf", "--poses", "bend.dmat", "--out", "out", "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const json table = json::parse(result.out);
  EXPECT_EQ(table["vertices"], 68);
  EXPECT_EQ(table["joints"][0]["joint"], "bone0");
  for (const char* file :
       {"bar.glb", "bar_handles.dmat", "bar_weights.dmat", "bar_handles.png", "bar_weights.png"})
    EXPECT_TRUE(fs::exists(folder_ / "out" / file)) << file;
  const testing::GltfEvaluator glb((folder_ / "out/bar.glb").string());
  ASSERT_EQ(glb.animation_count(), 1);
  double highest = 0;  // the second bone turns up about z
  for (const auto& p : glb.pose(0, glb.duration(0))) highest = std::max(highest, p.y());
  EXPECT_NEAR(highest, 1, 0.25);
}

TEST_F(SkinningVerbs, WrittenWeightsAndHandlesAreReadAgain) {
  ASSERT_EQ(run({"bind", "bar.obj", "--skeleton", "bar.tgf", "--out", "out"}).status, 0);
  const ProgramResult again = run(
      {"bind", "bar.obj", "--skeleton", "bar.tgf", "--handles", "out/bar_handles.dmat", "--out", "again"});
  ASSERT_EQ(again.status, 0) << again.err;
  std::ifstream a(folder_ / "out/bar_weights.dmat"), b(folder_ / "again/bar_weights.dmat");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(a), {}),
            std::string(std::istreambuf_iterator<char>(b), {}));
}

TEST_F(SkinningVerbs, DeformWritesOneShapeAFrame) {
  for (const char* format : {"obj", "ply"}) {
    const ProgramResult result =
        run({"deform", "bar.obj", "--skeleton", "bar.tgf", "--poses", "bend.dmat", "--deform", "poisson",
             "--frames", "3", "--format", format, "--out", "out"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(fs::exists(folder_ / "out" / (std::string("bar_poisson_0002.") + format)));
  }
  EXPECT_TRUE(fs::exists(folder_ / "out/bar_joints.dmat"));
}

TEST_F(SkinningVerbs, CompareMeasuresEveryMethod) {
  const ProgramResult result = run({"compare-skinning", "bar.obj", "--skeleton", "bar.tgf", "--poses",
                                    "bend.dmat", "--frames", "2", "--out", "out", "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const json table = json::parse(result.out);
  ASSERT_EQ(table["methods"].size(), 3u);
  EXPECT_EQ(table["methods"][0]["largest_from_lbs"], 0);
  EXPECT_GT(table["methods"][1]["largest_from_lbs"], 0);
  EXPECT_TRUE(fs::exists(folder_ / "out/bar_methods.png"));
}

TEST_F(SkinningVerbs, MistakesAreTold) {
  const auto refusal = [&](std::vector<std::string> arguments, int status) {
    const ProgramResult result = run(std::move(arguments));
    EXPECT_EQ(result.status, status);
    EXPECT_FALSE(fs::exists(folder_ / "out"));
    return result.err;
  };
  EXPECT_THAT(refusal({"bind", "bar.obj", "--out", "out"}, 2), HasSubstr("bind needs --skeleton"));
  EXPECT_THAT(refusal({"deform", "bar.obj", "--out", "out"}, 2), HasSubstr("has no skeleton"));
  EXPECT_THAT(refusal({"deform", "bar.obj", "--skeleton", "bar.tgf", "--out", "out"}, 2),
              HasSubstr("has no clip"));
  EXPECT_THAT(refusal({"deform", "bar.obj", "--skeleton", "bar.tgf", "--poses", "bend.dmat", "--clip", "bent",
                       "--out", "out"},
                      2),
              HasSubstr("no clip \"bent\" (nearest: \"bend\")"));
  EXPECT_THAT(refusal({"deform", "bar.obj", "--skeleton", "bar.tgf", "--poses", "bend.dmat", "--deform",
                       "context", "--out", "out"},
                      2),
              HasSubstr("needs examples"));
  EXPECT_THAT(refusal({"bind", "bar.obj", "--skeleton", "none.tgf", "--out", "out"}, 3),
              HasSubstr("none.tgf"));
  EXPECT_THAT(refusal({"bind", "bar.obj", "--skeleton", "bar.tgf", "--method", "heat", "--handles", "groups",
                       "--out", "out"},
                      2),
              HasSubstr("takes no handles"));
}

// Inputs by these formats, like any other: bound, corrected and exported in one recipe, twice the same bytes.
TEST_F(SkinningVerbs, RecipeBindsCorrectsAndExports) {
  write("bar.json", R"({ "recipe_version": 1, "name": "bar",
    "inputs": { "bar": { "file": "bar.obj", "clips": ["bend.dmat"], "bind": { "skeleton": "bar.tgf" } } },
    "base": "bar", "correctives": { "method": "dqs", "targets": 4, "enough": 0 } })");
  const ProgramResult result = run({"build", "bar.json", "--out", "out", "--cache", "cache", "-q"});
  ASSERT_EQ(result.status, 0) << result.err;
  const testing::GltfEvaluator glb((folder_ / "out/bar.glb").string());
  EXPECT_FALSE(glb.json()["meshes"][0]["primitives"][0]["targets"].empty());
  const ProgramResult again =
      run({"build", "bar.json", "--out", "again", "--cache", "other", "-j", "1", "-q"});
  ASSERT_EQ(again.status, 0) << again.err;
  std::ifstream a(folder_ / "out/bar.glb"), b(folder_ / "again/bar.glb");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(a), {}),
            std::string(std::istreambuf_iterator<char>(b), {}));
}

TEST_F(SkinningVerbs, RecipeMistakesAreTold) {
  const auto refusal = [&](const std::string& input, const std::string& more) {
    write("bar.json", R"({ "recipe_version": 1, "name": "bar", "inputs": { "bar": )" + input +
                          R"( }, "base": "bar")" + more + " }");
    const ProgramResult result = run({"check", "bar.json", "--cache", "cache"});
    EXPECT_EQ(result.status, 2) << result.out;
    return result.err;
  };
  const std::string bound = R"({ "file": "bar.obj", "bind": { "skeleton": "bar.tgf" } })";
  EXPECT_THAT(refusal(R"({ "file": "bar.obj", "bind": {} })", ""), HasSubstr("skeleton"));
  EXPECT_THAT(refusal(bound, R"(, "correctives": { "method": "context" })"), HasSubstr("examples"));
  EXPECT_THAT(refusal(bound, R"(, "correctives": { "method": "dq" })"), HasSubstr("dqs"));
  EXPECT_THAT(refusal(bound, R"(, "correctives": { "method": "dqs", "targets": 0 })"), HasSubstr("targets"));
  EXPECT_THAT(refusal(R"({ "file": "bar.obj", "bind": { "skeleton": "bar.tgf", "handles": "h.txt" } })", ""),
              HasSubstr(".dmat or .json"));
}

}  // namespace
}  // namespace skinforge
