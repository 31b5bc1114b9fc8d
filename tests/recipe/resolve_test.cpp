#include "recipe/resolve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "testing/temporary_folder.h"

namespace skinforge {
namespace {
namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Resolve : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder / name).parent_path());
    std::ofstream(folder / name) << text;
  }
  std::vector<ResolvedRecipe> resolve(const std::string& name, const RecipeChoice& choice = {}) const {
    return resolve_recipes(folder / name, choice);
  }
  Recipe one(const std::string& name, const RecipeChoice& choice = {}) const {
    const auto recipes = resolve(name, choice);
    EXPECT_EQ(recipes.size(), 1U);
    return read_resolved(recipes.front());
  }
  std::string failure(const std::string& name, const RecipeChoice& choice = {}) const {
    try {
      for (const ResolvedRecipe& recipe : resolve(name, choice)) read_resolved(recipe);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::Usage);
      return error.what();
    }
    return "no error";
  }
  std::string path(const std::string& name) const { return (folder / name).string(); }

  testing::TemporaryFolder folder;
};

// A merge patch (RFC 7396): objects member by member, lists whole, null takes away. Paths stay relative to
// the file that they stand in.
TEST_F(Resolve, ExtendsLaysOneFileOverAnother) {
  write("base/base.json", R"({
  "recipe_version": 1, "name": "base", "base": "a",
  "inputs": { "a": "a.glb", "b": "b.glb" },
  "animation": { "rate_hz": 24, "complete": false },
  "output": { "obj": "base.obj" } })");
  write("mine.yaml",
        "extends: base/base.json\nname: mine\ninputs: {b: c.glb}\nanimation: {rate_hz: 60}\noutput: null\n");
  const Recipe recipe = one("mine.yaml");
  EXPECT_EQ(recipe.name, "mine");
  EXPECT_EQ(recipe.inputs[0].file.resolved, folder / "base/a.glb");
  EXPECT_EQ(recipe.inputs[1].file.resolved, folder / "c.glb");
  EXPECT_EQ(recipe.animation.rate_hz, 60);
  EXPECT_FALSE(recipe.animation.complete);
  EXPECT_EQ(recipe.output.obj, "");
  EXPECT_EQ(recipe.where("/animation/rate_hz"), path("mine.yaml") + ":4:22");
  EXPECT_EQ(recipe.where("/animation/complete"), path("base/base.json") + ":4:45");
}

TEST_F(Resolve, LaterBasesWin) {
  write("one.json", R"({"recipe_version": 1, "name": "x", "base": "a", "inputs": {"a": "one.glb"}})");
  write("two.json", R"({"inputs": {"a": "two.glb"}})");
  write("both.json", R"({"extends": ["one.json", "two.json"]})");
  EXPECT_EQ(one("both.json").inputs[0].file.text, "two.glb");
}

TEST_F(Resolve, IncludesTakeTheirPlace) {
  write("parts/limbs.json", R"({ "arms": [ {"op": "remove", "at": "Arm.L"}, {"op": "remove", "at": "Arm.R"} ],
                                 "fine": { "voxel_factor": 0.4, "smoothing": 2 } })");
  write("x.json", R"({"recipe_version": 1, "name": "x", "base": "a", "inputs": {"a": "a.glb"},
    "surface": { "include": "parts/limbs.json#/fine", "smoothing": 5 },
    "ops": [ {"op": "remove", "at": "Tail"}, {"include": "parts/limbs.json#/arms"},
             {"include": "parts/limbs.json#/arms/0", "at": "Leg"} ]})");
  const Recipe recipe = one("x.json");
  EXPECT_EQ(recipe.surface.voxel_factor, 0.4);
  EXPECT_EQ(recipe.surface.smoothing, 5);
  std::vector<std::string> joints;
  for (const RecipeOperation& operation : recipe.operations) joints.push_back(operation.at.front());
  EXPECT_THAT(joints, ElementsAre("Tail", "Arm.L", "Arm.R", "Leg"));
}

TEST_F(Resolve, FilesThatLeadNowhere) {
  const std::string head = R"("recipe_version": 1, "name": "x", "base": "a", "inputs": {"a": "a.glb"})";
  write("none.json", "{" + head + R"(, "extends": "other.json"})");
  EXPECT_EQ(failure("none.json").find(path("none.json") + ":1:"), 0U) << failure("none.json");
  EXPECT_THAT(failure("none.json"), HasSubstr("other.json: no such file"));
  write("one.json", R"({"extends": "two.json"})");
  write("two.json", R"({"extends": "one.json"})");
  EXPECT_THAT(failure("one.json"), HasSubstr("leads back to itself"));
  write("list.json", "[1]");
  write("hole.json", "{" + head + R"(, "surface": {"include": "list.json#/7"}})");
  EXPECT_THAT(failure("hole.json"), HasSubstr("has nothing at /7"));
}

TEST_F(Resolve, VariablesHaveTypes) {
  write("x.json",
        R"({"recipe_version": 1, "name": "x_${side}", "base": "a", "inputs": {"a": "${folder}/a.glb"},
    "vars": { "side": { "default": "L", "choices": ["L", "R"] }, "folder": "models", "rate": 24,
              "passes": { "type": "integer", "default": 3, "min": 0, "max": 9 }, "at": ["Arm", "Leg"],
              "joint": "Arm.${side}" },
    "ops": [ {"op": "remove", "at": "${joint}"}, {"op": "remove", "at": "${at}"}, {"op": "remove", "at": "$${at}"} ],
    "animation": { "rate_hz": "${rate}" }, "surface": { "presence_smoothing": "${passes}" }})");
  const Recipe plain = one("x.json");
  EXPECT_EQ(plain.name, "x_L");
  EXPECT_EQ(plain.inputs[0].file.text, "models/a.glb");
  EXPECT_EQ(plain.animation.rate_hz, 24);
  EXPECT_EQ(plain.surface.presence_smoothing, 3);
  EXPECT_THAT(plain.operations[0].at, ElementsAre("Arm.L"));
  EXPECT_THAT(plain.operations[1].at, ElementsAre("Arm", "Leg"));
  EXPECT_THAT(plain.operations[2].at, ElementsAre("${at}"));
  const Recipe other = one("x.json", {{"side=R", "rate=60", "/output/influences=8"}, {}});
  EXPECT_EQ(other.name, "x_R");
  EXPECT_THAT(other.operations[0].at, ElementsAre("Arm.R"));
  EXPECT_EQ(other.animation.rate_hz, 60);
  EXPECT_EQ(other.output.influences, 8);
  EXPECT_EQ(other.where("/output/influences"), "--set /output/influences=8");
  EXPECT_THAT(failure("x.json", {{"side=B"}, {}}),
              HasSubstr(R"(expected one of "L", "R", found the string "B")"));
  EXPECT_THAT(failure("x.json", {{"passes=1.5"}, {}}), HasSubstr("expected an integer"));
  EXPECT_THAT(failure("x.json", {{"passes=10"}, {}}), HasSubstr("up to 9"));
  EXPECT_THAT(failure("x.json", {{"rate=fast"}, {}}), HasSubstr("expected a number"));
  EXPECT_THAT(failure("x.json", {{"sid=L"}, {}}), HasSubstr("(nearest: \"side\""));
  EXPECT_THAT(failure("x.json", {{"/output/influences=5"}, {}}),
              HasSubstr("--set /output/influences=5: /output"));
}

TEST_F(Resolve, ReferencesThatLeadNowhere) {
  const auto with = [&](const std::string& name, const std::string& more) {
    write(name,
          R"({"recipe_version": 1, "name": "x", "base": "a", "inputs": {"a": "${fil}"}, )" + more + "}");
    return failure(name);
  };
  EXPECT_THAT(with("unknown.json", R"("vars": {"file": "a.glb"})"),
              HasSubstr(R"(no variable "fil" (nearest: "file"))"));
  EXPECT_THAT(with("circle.json", R"("vars": {"fil": "${two}", "two": "${fil}"})"),
              HasSubstr("back to itself"));
  EXPECT_THAT(with("type.json", R"("vars": {"fil": {"default": 1, "type": "string"}})"),
              HasSubstr("expected a string"));
}

// Doubling sixteen times over would be a text of gigabytes; files that include each other's lists likewise.
TEST_F(Resolve, NothingMultipliesWithoutBound) {
  std::string vars = R"("v0": "0123456789012345678901234567890123456789")";
  for (int i = 1; i < 15; ++i) {
    vars += ", \"v" + std::to_string(i) + "\": \"";
    for (int k = 0; k < 8; ++k) vars += "${v" + std::to_string(i - 1) + "}";
    vars += "\"";
  }
  write("x.json", R"({"recipe_version": 1, "name": "${v14}", "base": "a", "inputs": {"a": "a"}, "vars": {)" +
                      vars + "}}");
  EXPECT_THAT(failure("x.json"), HasSubstr("more than a recipe can be"));
  write("0.json", "[1]");
  for (int i = 1; i < 12; ++i) {
    const std::string inner = "{\"include\": \"" + std::to_string(i - 1) + ".json\"}";
    write(std::to_string(i) + ".json", "[" + inner + "," + inner + "," + inner + "]");
  }
  write(
      "y.json",
      R"({"recipe_version": 1, "name": "x", "base": "a", "inputs": {"a": "a"}, "ops": [{"include": "11.json"}]})");
  EXPECT_THAT(failure("y.json"), HasSubstr("more than 1000 files"));
}

// By hand: 2 x 3 combinations, one left out, one added.
TEST_F(Resolve, AMatrixMakesARecipeOfEachCell) {
  write("x.json", R"({"recipe_version": 1, "name": "${matrix.body.name}_${matrix.torso}", "base": "body",
    "vars": {"size": 1},
    "matrix": { "body": [ {"name": "horse", "at": "Neck1"}, {"name": "wolf", "at": "Neck"} ],
                "torso": ["knight", "farmer", "elf"],
                "exclude": [ {"body": "wolf", "torso": "elf"} ],
                "include": [ {"body": {"name": "fox", "at": "Neck2"}, "torso": "elf", "size": 2} ] },
    "inputs": { "body": "${matrix.body.name}.glb", "torso": "${matrix.torso}.glb" },
    "ops": [ {"op": "replace", "at": "${matrix.body.at}", "from": "torso", "joint": "Spine",
              "place": {"scale": "${size}"}} ] })");
  std::vector<std::string> names, cells;
  for (const ResolvedRecipe& resolved : resolve("x.json")) {
    const Recipe recipe = read_resolved(resolved);
    names.push_back(recipe.name);
    cells.push_back(recipe.variant);
    EXPECT_EQ(recipe.operations[0].place.scale, recipe.name == "fox_elf" ? 2 : 1);
  }
  EXPECT_THAT(names, ElementsAre("horse_knight", "horse_farmer", "horse_elf", "wolf_knight", "wolf_farmer",
                                 "fox_elf"));
  EXPECT_EQ(cells.front(), "body=horse torso=knight");
  EXPECT_EQ(resolve("x.json", {{}, {"torso=elf"}}).size(), 2U);
  EXPECT_EQ(resolve("x.json", {{}, {"torso=elf", "body=fox"}}).size(), 1U);
  EXPECT_THAT(failure("x.json", {{}, {"torso=knigt"}}), HasSubstr("(nearest: \"knight\""));
  EXPECT_THAT(failure("x.json", {{}, {"legs=two"}}), HasSubstr("no axis \"legs\""));
  EXPECT_THROW(load_recipe(folder / "x.json"), Error);  // several where one is wanted
}

TEST_F(Resolve, CellsNeedNamesOfTheirOwn) {
  write("x.json", R"({"recipe_version": 1, "name": "x", "base": "a", "inputs": {"a": "${matrix.a}.glb"},
                      "matrix": {"a": ["one", "two"]}})");
  EXPECT_THAT(failure("x.json"),
              HasSubstr("/name: \"x\" is the name of two cells of the matrix (a=one and a=two)"));
  EXPECT_THAT(failure("x.json"), HasSubstr("${matrix.a}"));
}

TEST_F(Resolve, ExpandedTextSaysWhereEachValueComesFrom) {
  write("base.json",
        R"({"recipe_version": 1, "name": "x", "base": "a", "inputs": {"a": "a.glb"}, "vars": {"rate": 24}})");
  write("x.json",
        "{ \"extends\": \"base.json\",\n  \"animation\": { \"rate_hz\": \"${rate}\" },\n"
        "  \"ops\": [ { \"op\": \"remove\", \"at\": [\"A\", \"B\"] } ] }");
  const std::string text = expanded_text(resolve("x.json").front().root);
  EXPECT_THAT(text, HasSubstr("\"a\": \"a.glb\""));
  EXPECT_THAT(text, ::testing::ContainsRegex("\"rate_hz\": 24 +// .*base.json:1:"));
  EXPECT_THAT(text, ::testing::ContainsRegex("\"at\": \\[\"A\", \"B\"\\] +// .*x.json:3:"));
  const Recipe again = parse_recipe(text, "again.jsonc");  // and is a recipe itself
  EXPECT_EQ(again.animation.rate_hz, 24);
}

// Ten thousand cells with a list of a thousand each, in the recipe or in an axis: gigabytes out of kilobytes.
TEST_F(Resolve, AMatrixThatMultipliesARecipeBeyondMemoryIsRefused) {
  const auto list = [](int count) {
    std::string text = "[0";
    for (int i = 1; i < count; ++i) text += "," + std::to_string(i);
    return text + "]";
  };
  const std::string ten = list(10), head = R"({"recipe_version": 1, "name": "a", "matrix": {"a": )" + ten +
                                           R"(, "b": )" + ten + R"(, "c": )" + ten + R"(, "d": )";
  write("wide.json", head + ten + R"(}, "ops": )" + list(1000) + "}");
  EXPECT_EQ(failure("wide.json"),
            path("wide.json") + ":1:1: /matrix: its 10000 cells make more than 4000000 values");
  std::string axis = "[" + list(1000);
  for (int i = 1; i < 10; ++i) axis += "," + list(1000);
  write("axis.json", head + axis + "]}}");
  EXPECT_THAT(failure("axis.json"), HasSubstr("/matrix: its cells make more than 4000000 values"));
  write("fits.json", head + ten + R"(}, "ops": )" + list(100) + "}");
  EXPECT_THAT(failure("fits.json"), HasSubstr("is the name of two cells"));
}

}  // namespace
}  // namespace skinforge
