#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

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
  EXPECT_THAT(refusal({"bind", "bar.obj", "--out", "out"}, 3), HasSubstr("has no skeleton of its own"));
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

/// A broken file, and what the verbs say of it. `in_bind`: the option of bind that takes the file; empty: the
/// model.
struct BadFile {
  std::string name, text, in_bind, message;
};

// One clear line, the right status, nothing written.
TEST_F(SkinningVerbs, BrokenFilesAreToldInOneLine) {
  const std::string head = "0.2 0 0\n0 0.2 0\n0 0 0.2\n";
  const std::vector<BadFile> table{
      {"empty.off", "", "", "the file ends too early"},
      {"count.off", "OFF 3 1 0\n" + head + "3 0 1 7\n", "", "vertex 7 of 3"},
      {"nan.off", "OFF 3 1 0\nnan 0 0\n" + head + "3 0 1 2\n", "", "a coordinate is not finite"},
      {"points.off", "OFF 3 0 0\n" + head, "", "face"},
      {"cycle.tgf", "1 0 0 0\n2 1 0 0\n#\n1 2\n2 1\n", "--skeleton", "bones form a cycle"},
      {"parents.tgf", "1 0 0 0\n2 1 0 0\n3 2 0 0\n#\n1 2\n3 2\n", "--skeleton", "joint 2 has two parents"},
      {"gap.tgf", "1 0 0 0\n3 1 0 0\n#\n1 3\n", "--skeleton", "joint 2 is missing"},
      {"self.tgf", "1 0 0 0\n2 1 0 0\n#\n1 1\n", "--skeleton", "to itself"},
      {"none.tgf", "1 0 0 0\n#\n", "--skeleton", "without bones"},
      {"nan.tgf", "1 0 0 nan\n2 1 0 0\n#\n1 2\n", "--skeleton", "not finite"},
      {"label.dmat", "1 3\n0 1 2\n", "--handles", "the mesh has 68 vertices"},
      {"words.dmat", "1 2\nred blue\n", "--handles", "a value is missing, found \"red\""},
      {"huge.dmat", "4 99999999999\n1\n", "--handles", "columns of"},
      {"list.json", "[1, 2]", "--handles", "expected an object"},
      {"who.json", "{\"bone9\": [1]}", "--handles", "no joint \"bone9\""},
      {"far.json", "{\"bone0\": [68]}", "--handles", "from 0 to 67"},
      {"image.png", "not an image", "--handles", "image.png: "},
      {"frames.dmat", "4 3\n0 0 0\n0 0 0\n0 0 0\n1 1 1\n", "--poses", "no whole frames of 2 bones"},
      {"columns.dmat", "5 2\n0 0\n0 0\n0 0\n1 1\n1 1\n", "--poses", "5 columns"},
      {"zero.dmat", "4 2\n0 0\n0 0\n0 0\n0 1\n", "--poses", "quaternion of length zero"},
      {"shear.dmat", "9 2\n1 1\n5 0\n0 0\n0 0\n1 1\n0 0\n0 0\n0 0\n1 1\n", "--poses", "no rotation"},
      {"infinite.dmat", "4 2\n0 0\n0 0\n0 0\ninf 1\n", "--poses", "not finite"}};
  write("colors.json", "{\"bone0\": \"#ff0000\"}");
  for (const BadFile& bad : table) {
    write(bad.name, bad.text);
    std::vector<std::string> arguments{"bind", bad.in_bind.empty() ? bad.name : "bar.obj", "--out", "out"};
    if (bad.in_bind != "--skeleton") arguments.insert(arguments.end(), {"--skeleton", "bar.tgf"});
    if (!bad.in_bind.empty()) arguments.insert(arguments.end(), {bad.in_bind, bad.name});
    if (bad.name.ends_with(".png")) arguments.insert(arguments.end(), {"--label-colors", "colors.json"});
    const ProgramResult result = run(arguments);
    EXPECT_EQ(result.status, 3) << bad.name;
    EXPECT_THAT(result.err, HasSubstr(bad.message)) << bad.name;
    EXPECT_THAT(result.err, HasSubstr(bad.name)) << bad.name;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_FALSE(fs::exists(folder_ / "out")) << bad.name;
  }
}

// What is odd but has an answer: no NaN comes out.
TEST_F(SkinningVerbs, OddInputsAreRepaired) {
  const auto run_with = [&](const std::string& poses, const std::string& method) {
    return run({"deform", "bar.obj", "--skeleton", "bar.tgf", "--poses", poses, "--deform", method,
                "--frames", "3", "--out", "out", "--example", "bar.obj", "turned.dmat"});
  };
  write("turned.dmat", "4 2\n0 0\n0 0\n0 1\n1 0\n");  // the second bone by half a turn: T is singular
  write("half.dmat", "4 4\n0 0 0 0\n0 0 0 0\n0 0 0 1\n1 1 1 0\n");
  for (const char* method : {"lbs", "dqs", "poisson", "context", "context-face", "context-polar"}) {
    const ProgramResult result = run_with("half.dmat", method);
    ASSERT_EQ(result.status, 0) << method << result.err;
    for (int i = 0; i < 3; ++i) {
      std::ifstream file(folder_ / "out" /
                         (std::string("bar_") + method + "_000" + std::to_string(i) + ".obj"));
      const std::string text(std::istreambuf_iterator<char>(file), {});
      EXPECT_EQ(text.find("nan"), std::string::npos) << method;
      EXPECT_EQ(text.find("inf"), std::string::npos) << method;
      EXPECT_GT(text.size(), 1000u);
    }
  }
  write("short.dmat", "4 2\n0 0\n0 0\n0 0\n2 1\n");
  EXPECT_THAT(run_with("short.dmat", "dqs").err, HasSubstr("rotations-normalised"));
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

// The recipe orders vertices by faces, the example by its file: at the end of the bend the GLB shows the
// example.
TEST_F(SkinningVerbs, RecipeBringsExamplesBack) {
  ASSERT_EQ(run({"deform", "bar.obj", "--skeleton", "bar.tgf", "--poses", "bend.dmat", "--deform", "dqs",
                 "--frames", "1", "--out", "shape"})
                .status,
            0);
  std::ifstream posed(folder_ / "shape/bar_dqs_0000.obj");
  std::vector<Eigen::Vector3d> shape;
  std::string example;
  for (std::string line; std::getline(posed, line);) {
    if (!line.starts_with("v ")) continue;
    double x = 0, y = 0, z = 0;
    std::istringstream(line.substr(2)) >> x >> y >> z;
    shape.emplace_back(x, y, z + 0.1 * std::sin(5 * x));
    example += "v " + std::to_string(shape.back().x()) + " " + std::to_string(shape.back().y()) + " " +
               std::to_string(shape.back().z()) + "\n";
  }
  ASSERT_EQ(shape.size(), 68u);
  write("example.obj", example + "f 1 2 3\n");
  write("bent.dmat", "4 2\n0 0\n0 0\n0 0.70710678\n1 0.70710678\n");
  write("bar.json", R"({ "recipe_version": 1, "name": "bar",
    "inputs": { "bar": { "file": "bar.obj", "bind": { "skeleton": "bar.tgf" }, "clips": ["bend.dmat"] } },
    "base": "bar", "correctives": { "method": "context", "joints": ["bone1"],
                                    "examples": [{ "shape": "example.obj", "pose": "bent.dmat" }] } })");
  const ProgramResult result = run({"build", "bar.json", "--out", "out", "--cache", "cache", "-q"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(fs::exists(folder_ / "out/bar_driver.json"));
  const testing::GltfEvaluator glb((folder_ / "out/bar.glb").string());
  for (const auto& p : glb.pose(0, glb.duration(0))) {
    double nearest = 1;
    for (const auto& q : shape) nearest = std::min(nearest, (p - q).norm());
    EXPECT_LT(nearest, 2e-6);  // six digits in the text
  }
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
  EXPECT_THAT(refusal(R"({ "file": "bar.obj", "bind": { "skeletn": "bar.tgf" } })", ""),
              HasSubstr("(nearest: \"skeleton\""));
  EXPECT_THAT(refusal(bound, R"(, "correctives": { "method": "context" })"), HasSubstr("examples"));
  EXPECT_THAT(refusal(bound, R"(, "correctives": { "method": "dq" })"), HasSubstr("dqs"));
  EXPECT_THAT(refusal(bound, R"(, "correctives": { "method": "dqs", "targets": 0 })"), HasSubstr("targets"));
  EXPECT_THAT(refusal(R"({ "file": "bar.obj", "bind": { "skeleton": "bar.tgf", "handles": "h.txt" } })", ""),
              HasSubstr(".dmat or .json"));
  const auto handles = [&](const std::string& value) {
    return refusal(R"({ "file": "bar.obj", "bind": { "skeleton": "bar.tgf", "handles": )" + value + " } }",
                   "");
  };
  EXPECT_THAT(handles(R"({ "image": "l.png" })"), HasSubstr("colors"));
  EXPECT_THAT(handles(R"({ "image": "l.png", "colors": {} })"), HasSubstr("at least one joint"));
  EXPECT_THAT(handles(R"({ "image": "l.png", "colors": { "bone0": "red" } })"), HasSubstr("#ff8000"));
  EXPECT_THAT(refusal(bound, R"(, "correctives": { "method": "dqs", "joints": ["bone0"] })"),
              HasSubstr("joints is for method \"context\""));
}

}  // namespace
}  // namespace skinforge
