#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "recipe/recipe.h"
#include "testing/assets.h"
#include "testing/temporary_folder.h"

namespace skinforge {
namespace {
namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::StartsWith;

Recipe parse(const std::string& text) {
  return parse_recipe(text, "centaur.json");
}

std::string failure(const std::string& text, const fs::path& path = "centaur.json") {
  try {
    parse_recipe(text, path);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::Usage);
    return error.what();
  }
  return "no error";
}

// A recipe around one operation, which stands in line 2.
std::string with_operation(const std::string& operation) {
  return R"({"recipe_version": 1, "name": "x", "inputs": {"a": "a.glb", "b": "b.glb"}, "base": "a", "ops": [)"
         "\n" +
         operation + "]}";
}

// A recipe with one more top-level member, which stands in line 2.
std::string with_member(const std::string& member) {
  return R"({"recipe_version": 1, "name": "x", "inputs": {"a": "a.glb"}, "base": "a",)"
         "\n" +
         member + "}";
}

constexpr const char* kCentaur = R"({ // the recipe of the README, with every key
  "$schema": "../schemas/recipe.schema.json", "recipe_version": 1, "name": "centaur",
  "inputs": { "man": { "file": "../data/man.fbx", "clips": ["walk.fbx"],
                       "pose": { "Head": { "rotate_deg": [10,0,0] }, "a/b~c": { "translate": [0,1,0] } } },
              "horse": "horse.glb" },
  "base": "horse",
  "ops": [ { "op": "replace", "at": "Neck1", "from": "man", "joint": "Spine", "blend": "blend",
             "place": { "align": "loop", "scale": "loop", "rotate_deg": [0,-90,0], "offset": [0,0,0.5], "turn_limit_deg": 30 } },
           { "op": "attach", "at": "Torso", "from": "man", "joint": "Arm", "place": { "scale": 1.5, "align": "none" } },
           { "op": "remove", "at": ["Tail1", "Tail2"] },
           { "op": "detach", "at": "Hips" } ],
  "surface": { "voxel_factor": 0.8, "presence_smoothing": 1, "keep_or_drop": { "variance": 0.05, "mean": 0.6 } },
  "animation": { "clips": ["Walk", "Idle"], "complete": false, "rate_hz": 24 },
  "output": { "glb": "a/centaur.glb", "obj": "centaur.obj", "vdb": "centaur.vdb", "influences": 8 } })";

TEST(LoadRecipe, ReadsEveryKey) {
  const Recipe recipe = parse_recipe(kCentaur, "recipes/centaur.jsonc");
  EXPECT_EQ(recipe.name, "centaur");
  ASSERT_THAT(recipe.inputs, SizeIs(2));
  EXPECT_EQ(recipe.inputs[0].name, "horse");
  EXPECT_EQ(recipe.inputs[0].file.text, "horse.glb");
  EXPECT_EQ(recipe.inputs[0].file.resolved, "recipes/horse.glb");
  const RecipeInput& man = recipe.inputs[1];
  EXPECT_EQ(man.file.resolved, "data/man.fbx");
  ASSERT_THAT(man.clips, SizeIs(1));
  EXPECT_EQ(man.clips[0].resolved, "recipes/walk.fbx");
  EXPECT_EQ(man.pose.at("Head").rotate_deg[0], 10);
  EXPECT_EQ(man.pose.at("a/b~c").translate[1], 1);
  EXPECT_EQ(recipe.base, "horse");
  EXPECT_EQ(recipe.input_index("man"), 1U);

  ASSERT_THAT(recipe.operations, SizeIs(4));
  const RecipeOperation& replace = recipe.operations[0];
  EXPECT_EQ(replace.kind, OperationKind::Replace);
  EXPECT_THAT(replace.at, ElementsAre("Neck1"));
  EXPECT_EQ(replace.from, "man");
  EXPECT_EQ(replace.joint, "Spine");
  EXPECT_EQ(replace.blend, Blend());
  EXPECT_EQ(replace.place.align, Align::Loop);
  EXPECT_TRUE(replace.place.scale_by_loop);
  EXPECT_EQ(replace.place.scale, 1);
  EXPECT_EQ(replace.place.rotate_deg[1], -90);
  EXPECT_EQ(replace.place.offset[2], 0.5);
  EXPECT_EQ(replace.place.turn_limit_deg, 30);
  EXPECT_EQ(recipe.operations[1].place.turn_limit_deg, 90);
  EXPECT_EQ(recipe.operations[1].place.scale, 1.5);
  EXPECT_EQ(recipe.operations[1].place.align, Align::None);
  EXPECT_EQ(recipe.operations[2].kind, OperationKind::Remove);
  EXPECT_THAT(recipe.operations[2].at, ElementsAre("Tail1", "Tail2"));
  EXPECT_EQ(recipe.operations[3].kind, OperationKind::Detach);

  SurfaceOptions surface;
  surface.voxel_factor = 0.8;
  surface.presence_smoothing = 1;
  surface.keep_or_drop = {0.05, 0.6};
  EXPECT_EQ(recipe.surface, surface);
  EXPECT_FALSE(recipe.animation.all_clips);
  EXPECT_THAT(recipe.animation.clips, ElementsAre("Walk", "Idle"));
  EXPECT_FALSE(recipe.animation.complete);
  EXPECT_EQ(recipe.animation.rate_hz, 24);
  EXPECT_EQ(recipe.output, (OutputOptions{"a/centaur.glb", "centaur.obj", "centaur.vdb", false, {}, 8}));
}

TEST(LoadRecipe, LeavesDefaults) {
  const Recipe recipe = parse(with_operation(R"({"op": "replace", "at": "j", "from": "b", "joint": "k"})"));
  EXPECT_EQ(recipe.operations[0].place, Placement());
  EXPECT_EQ(recipe.operations[0].blend, Blend());
  EXPECT_EQ(recipe.surface, SurfaceOptions());
  EXPECT_EQ(recipe.animation, AnimationOptions());
  EXPECT_EQ(recipe.output,
            (OutputOptions{.glb = "x.glb", .obj = "", .vdb = "", .animated = {}, .influences = 4}));
}

TEST(LoadRecipe, ReadsSettingsOfClips) {
  const AnimationOptions options =
      parse(with_member(R"("animation": {"method": "paper", "tempo": [0.8, 1.25], "limb_phase": 0,
                       "limb_clearing_deg": 60, "key_tolerance": 0, "per_clip": {
                         "Gallop": {"use": ["Run", "Walk"], "loop": true, "rate_hz": 24, "limb_clearing_deg": 0},
                         "Idle": {"with": "Idle", "complete": false, "method": "sequence"}}})"))
          .animation;
  EXPECT_EQ(options.method, CompletionMethod::Paper);
  EXPECT_THAT(options.tempo, ElementsAre(0.8, 1.25));
  EXPECT_EQ(options.limb_phase, 0);
  EXPECT_EQ(options.limb_clearing_deg, 60);
  EXPECT_EQ(options.key_tolerance, 0);
  EXPECT_EQ(options.rate_hz, std::nullopt);
  const ClipSettings &gallop = options.per_clip.at("Gallop"), &idle = options.per_clip.at("Idle");
  EXPECT_THAT(gallop.use, ElementsAre("Run", "Walk"));
  EXPECT_EQ(gallop.loop, true);
  EXPECT_EQ(gallop.rate_hz, 24);
  EXPECT_EQ(gallop.limb_clearing_deg, 0);
  EXPECT_EQ(gallop.complete, std::nullopt);
  EXPECT_EQ(idle.with, "Idle");
  EXPECT_EQ(idle.complete, false);
  EXPECT_EQ(idle.method, CompletionMethod::Sequence);
}

TEST(LoadRecipe, ReadsWhatToAnimate) {
  EXPECT_TRUE(parse(with_member(R"("output": {"animated": "all"})")).output.all_animated);
  EXPECT_THAT(parse(with_member(R"("output": {"animated": ["Walk"]})")).output.animated, ElementsAre("Walk"));
}

// An operation takes the recipe's surface, key by key and side by side, where it does not say otherwise.
TEST(LoadRecipe, OperationsInheritTheSurface) {
  const auto surface = [](const std::string& of_recipe, const std::string& of_operation) {
    return parse_recipe(
               R"({"recipe_version": 1, "name": "x", "inputs": {"a": "a.glb", "b": "b.glb"}, "base": "a",
      "ops": [{"op": "replace", "at": "j", "from": "b", "joint": "k", "surface": )" +
                   of_operation + R"(}], "surface": )" + of_recipe + "}",
               "x.json")
        .operations.at(0)
        .surface;
  };
  const SurfaceOptions all =
      surface("{}", R"({"voxel": 0.02, "presence_smoothing": 3, "hardness": {"at": 0.5, "from": -0.2},
        "include_parent": true, "keep_or_drop": {"mean": 0.7}, "elements": "triangles", "smoothing": 5})");
  EXPECT_EQ(all.voxel, 0.02);
  EXPECT_EQ(all.presence_smoothing, 3);
  EXPECT_EQ(all.hardness, (Sides<double>{0.5, -0.2}));
  EXPECT_EQ(all.include_parent, (Sides<bool>{true, true}));
  EXPECT_EQ(all.keep_or_drop, (KeepOrDrop{0.04, 0.7}));
  EXPECT_EQ(all.elements, Elements::Triangles);
  EXPECT_EQ(all.smoothing, 5);

  EXPECT_EQ(surface(R"({"hardness": 0.3})", R"({"hardness": {"from": 0}})").hardness,
            (Sides<double>{0.3, 0}));
  EXPECT_EQ(surface(R"({"elements": "quads"})", "{}").elements, Elements::Quads);
  EXPECT_EQ(surface(R"({"voxel": 0.02})", R"({"voxel_factor": 0.7})").voxel, 0);
  EXPECT_EQ(surface(R"({"voxel_factor": 0.7})", R"({"voxel": 0.02})").voxel, 0.02);
}

TEST(LoadRecipe, RemembersPlaces) {
  const Recipe recipe = parse_recipe(kCentaur, "recipes/centaur.json");
  EXPECT_EQ(recipe.place("/ops/0/at"), "recipes/centaur.json:7:37: /ops/0/at");
  EXPECT_EQ(recipe.place("/inputs/man/pose/a~1b~0c"), "recipes/centaur.json:4:79: /inputs/man/pose/a~1b~0c");
  EXPECT_EQ(recipe.place("/ops/3/place/scale"), "recipes/centaur.json:11:12: /ops/3/place/scale");
}

TEST(LoadRecipe, YamlSaysTheSame) {
  const Recipe yaml = parse_recipe(
      "recipe_version: 1\nname: x\ninputs: {a: a.glb, b: b.glb}\nbase: a\nops:\n"
      "  - {op: replace, at: j, from: b, joint: k, place: {scale: 1.5}}\n",
      "x.yaml");
  const Recipe json = parse(
      with_operation(R"({"op": "replace", "at": "j", "from": "b", "joint": "k", "place": {"scale": 1.5}})"));
  EXPECT_EQ(yaml.operations, json.operations);
  EXPECT_EQ(yaml.output, json.output);
  EXPECT_EQ(to_bytes(yaml.operations[0]), to_bytes(json.operations[0]));
}

TEST(LoadRecipe, OffersTheNearestKey) {
  EXPECT_THAT(failure(with_operation(R"({"op": "replace", "att": "j", "from": "b", "joint": "k"})")),
              StartsWith("centaur.json:2:19: /ops/0: unknown key \"att\" (nearest: \"at\""));
  EXPECT_THAT(failure(with_member(R"("animaton": {})")),
              StartsWith("centaur.json:2:1: unknown key \"animaton\" (nearest: \"animation\""));
}

TEST(LoadRecipe, NamesPlaceWantedAndFound) {
  const auto op = [](const std::string& rest) { return failure(with_operation("{\"op\": " + rest + "}")); };
  EXPECT_EQ(op(R"("explode", "at": "j")"),
            "centaur.json:2:8: /ops/0/op: expected one of \"replace\", \"attach\", \"remove\", \"detach\", "
            "found the string "
            "\"explode\" (nearest: \"replace\", \"remove\")");
  EXPECT_EQ(op(R"("remove", "at": 5)"),
            "centaur.json:2:24: /ops/0/at: expected a joint, or a list of joints, found the number 5");
  EXPECT_EQ(op(R"("remove", "at": [])"),
            "centaur.json:2:24: /ops/0/at: expected at least one joint, such as \"Neck1\"");
  EXPECT_EQ(op(R"("remove", "at": ["j", "j"])"),
            "centaur.json:2:30: /ops/0/at/1: joint \"j\" is listed twice; leave one out");
  EXPECT_EQ(op(R"("remove", "at": "")"),
            "centaur.json:2:24: /ops/0/at: expected a string, found an empty one");
  EXPECT_EQ(op(R"("remove")"), "centaur.json:2:1: /ops/0: missing key \"at\", such as \"at\": \"Neck1\"");
  EXPECT_EQ(op(R"("remove", "at": "j", "from": "b")"),
            "centaur.json:2:37: /ops/0/from: \"from\" has no meaning here: this operation takes nothing from "
            "an input");
  EXPECT_EQ(op(R"("detach", "at": ["j", "k"])"),
            "centaur.json:2:24: /ops/0/at: this operation takes one joint");
  EXPECT_EQ(op(R"("replace", "at": "j", "joint": "k")"),
            "centaur.json:2:1: /ops/0: missing key \"from\", such as \"from\": \"man\"");
  EXPECT_EQ(op(R"("replace", "at": "j", "from": "c", "joint": "k")"),
            "centaur.json:2:38: /ops/0/from: no input \"c\"");
  const std::string part = R"("replace", "at": "j", "from": "b", "joint": "k", )";
  EXPECT_EQ(op(part + R"("place": {"scale": "x"})"),
            "centaur.json:2:76: /ops/0/place/scale: expected a number or \"loop\", found the string \"x\"");
  EXPECT_THAT(op(part + R"("place": {"scale": 0})"), HasSubstr("expected a number above 0"));
  EXPECT_THAT(op(part + R"("place": {"offset": [0, 0]})"),
              HasSubstr("expected a list of three numbers, found a list of 2"));
  EXPECT_THAT(op(part + R"("place": {"offset": [0, 0, "x"]})"),
              HasSubstr("/ops/0/place/offset/2: expected a number, found the string \"x\""));
  EXPECT_THAT(op(part + R"("place": {"offset": [0, 0, 1e300]})"),
              HasSubstr("expected a number from -1000000000 to 1000000000"));
  EXPECT_THAT(op(part + R"("blend": true)"), HasSubstr("expected one of \"auto\", \"blend\""));
  EXPECT_THAT(op(part + R"("blend": "union")"), HasSubstr("\"op\": \"attach\" unites"));
  EXPECT_THAT(op(part + R"("blend": {"radius": 0})"), HasSubstr("a number above 0"));
  EXPECT_THAT(op(part + R"("blend": {"operator": "paper", "radius": 0.1})"),
              HasSubstr("\"paper\" has no fillet"));
  EXPECT_THAT(op(part + R"("blend": {"operater": "smin"})"), HasSubstr("nearest: \"operator\""));
  EXPECT_THAT(op(R"("replace", "at": "j", "from": "a", "joint": "j")"), HasSubstr("of the base by itself"));
  EXPECT_THAT(op(part + R"("surface": {"hardnes": 1})"), HasSubstr("(nearest: \"hardness\""));
  EXPECT_THAT(op(part + R"("surface": {"hardness": 1})"), HasSubstr("expected a number from -0.9 to 0.9"));
  EXPECT_THAT(op(part + R"("surface": {"hardness": {"form": 0}})"), HasSubstr("(nearest: \"from\")"));
  EXPECT_THAT(
      op(part + R"("surface": {"hardness": "high"})"),
      HasSubstr("expected a number from -0.9 to 0.9, or an object with \"at\" and \"from\", found the "
                "string \"high\""));
  EXPECT_THAT(op(part + R"("surface": {"elements": "tris"})"),
              HasSubstr("expected one of \"auto\", \"quads\", \"triangles\""));
  EXPECT_THAT(op(part + R"("surface": {"voxel": 1, "voxel_factor": 1})"),
              HasSubstr("expected one of \"voxel\" and \"voxel_factor\""));
  EXPECT_THAT(op(R"("remove", "at": "j", "surface": {"hardness": 0})"), HasSubstr("blends nothing"));
  EXPECT_THAT(op(R"("remove", "at": "j", "surface": {"include_parent": {"from": true}})"),
              HasSubstr("takes nothing from an input"));
  EXPECT_THAT(op(R"("detach", "at": "j", "surface": {"include_parent": true})"), HasSubstr("blends nothing"));
  EXPECT_THAT(op(R"("attach", "at": "j", "from": "b", "joint": "k", "surface": {"hardness": {"at": 0}})"),
              HasSubstr("does not cut the character"));
  EXPECT_EQ(op(R"("attach", "at": "j", "from": "b", "joint": "k", "surface": {"hardness": 0.1})"),
            "no error");
  EXPECT_EQ(op(R"("replace", "at": "j", "from": "a", "joint": "j", "place": {"scale": 2})"), "no error");
}

TEST(LoadRecipe, ChecksTheOtherParts) {
  const auto expect = [](const std::string& member, const std::string& message) {
    EXPECT_THAT(failure(with_member(member)), HasSubstr(message)) << member;
  };
  expect(R"("surface": {"voxel_factor": 0})",
         "/surface/voxel_factor: expected a number from 0.1 to 4, found the number 0");
  expect(R"("surface": {"presence_smoothing": 1.5})", "expected a whole number from 0 to 99");
  expect(R"("surface": {"keep_or_drop": {"mean": 2}})", "expected a number from 0 to 1");
  expect(R"("animation": {"clips": "none"})",
         "expected \"all\" or a list of clip names, found the string \"none\"");
  expect(R"("animation": {"clips": ["a", "a"]})", "clip \"a\" is listed twice");
  expect(R"("animation": {"complete": 1})", "expected true or false, found the number 1");
  expect(R"("animation": {"rate_hz": 0})", "expected a number from 1 to 240");
  expect(R"("animation": {"metod": "paper"})", "unknown key \"metod\" (nearest: \"method\"");
  expect(R"("animation": {"method": "papre"})", "/animation/method: ");
  expect(R"("animation": {"tempo": [2, 0.5]})", "expected a number from 0.5 to 1, found the number 2");
  expect(R"("animation": {"tempo": [1]})", "expected the slowest and the fastest tempo");
  expect(R"("animation": {"per_clip": {"Run": {"usee": []}}})", "unknown key \"usee\" (nearest: \"use\"");
  expect(R"("animation": {"per_clip": {"Run": {"use": "Walk"}}})", "expected a list of clip names");
  expect(R"("animation": {"per_clip": {"Run": {"use": ["Walk"], "with": "Idle"}}})",
         "/animation/per_clip/Run/use: \"with\" already says which clip is played");
  expect(R"("output": {"influences": 5})", "expected 4 or 8, found the number 5");
  expect(R"("output": {"glb": "../x.glb"})", "must be a plain path inside the output folder");
  expect(R"("output": {"glb": "/tmp/x.glb"})", "must be a plain path inside the output folder");
  expect(R"("output": {"glb": "x.gltf"})", "output \"x.gltf\" must end in .glb");
  expect(R"("output": {"obj": null})", "/output/obj: expected a string, found null");
  expect(R"("ops": {})", "/ops: expected a list, found an object");
}

TEST(LoadRecipe, ChecksHeadAndInputs) {
  const auto recipe = [](const std::string& inputs, const std::string& name = "x",
                         const std::string& base = "a") {
    return failure(R"({"recipe_version": 1, "name": ")" + name + R"(", "inputs": )" + inputs +
                   R"(, "base": ")" + base + "\"}");
  };
  EXPECT_EQ(recipe(R"({"a": "a.glb"})"), "no error");
  EXPECT_THAT(recipe(R"({"a": "a.glb"})", "../x"), HasSubstr("/name: \"../x\" cannot be a file name"));
  EXPECT_THAT(recipe(R"({"horse": "a.glb"})", "x", "hrose"),
              HasSubstr("/base: no input \"hrose\" (nearest: \"horse\")"));
  EXPECT_THAT(recipe("{}"), HasSubstr("/inputs: expected at least one input"));
  EXPECT_THAT(recipe("[]"), HasSubstr("/inputs: expected an object, found a list of 0"));
  EXPECT_THAT(recipe(R"({"a": 1})"), HasSubstr("expected a path, or an object with \"file\" or \"recipe\""));
  EXPECT_THAT(recipe(R"({"a": {}})"), HasSubstr("expected one of \"file\" and \"recipe\""));
  EXPECT_THAT(recipe(R"({"a": {"file": "x", "recipe": "y"}})"),
              HasSubstr("expected one of \"file\" and \"recipe\""));
  EXPECT_THAT(recipe(R"({"a/b": "a.glb"})"), HasSubstr("input \"a/b\" cannot be a file name"));
  EXPECT_THAT(recipe(R"({"a": "/dev/zero"})"), HasSubstr("is absolute"));
  EXPECT_THAT(recipe(R"({"a": "..\\a.glb"})"), HasSubstr("has a backslash"));
  EXPECT_THAT(recipe(R"({"a": "http://127.0.0.1/a.glb"})"), HasSubstr("is an address"));
  EXPECT_THAT(recipe(R"({"a": "a\u0000.glb"})"), HasSubstr("has control characters"));
  EXPECT_THAT(failure(R"({"recipe_version": 2, "future": true})"),
              HasSubstr("/recipe_version: expected recipe version 1, found the number 2"));
  EXPECT_THAT(failure(R"({"recipe_version": "1"})"), HasSubstr("/recipe_version: expected a number"));
  EXPECT_THAT(failure("{}"), HasSubstr("missing key \"recipe_version\""));
  EXPECT_THAT(failure(R"({"recipeversion": 1})"),
              HasSubstr("unknown key \"recipeversion\" (nearest: \"recipe_version\""));
  EXPECT_THAT(failure("[]"), HasSubstr("expected an object, found a list of 0"));
  EXPECT_THAT(failure("{}", "centaur.txt"), HasSubstr("a recipe ends in .json, .jsonc, .yaml or .yml"));
}

TEST(LoadRecipe, AsksForQuotesAroundYamlsDoubtfulWords) {
  const auto yaml = [](const std::string& at) {
    return failure(
        "recipe_version: 1\nname: x\ninputs: {a: a.glb}\nbase: a\nops: [{op: remove, at: " + at + "}]",
        "x.yaml");
  };
  EXPECT_EQ(yaml("no"),
            "x.yaml:5:24: /ops/0/at: put \"no\" in quotes: plain no is true or false to some readers");
  EXPECT_EQ(yaml("'no'"), "no error");
  EXPECT_THAT(yaml("1e3"), HasSubstr("found the number 1e3"));
  EXPECT_EQ(yaml("\"1e3\""), "no error");
}

class RecipeFiles : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) { std::ofstream(folder / name) << text; }
  std::string load_failure(const std::string& name, ExitCode code) {
    try {
      load_recipe(folder / name);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code);
      return error.what();
    }
    return "no error";
  }
  static std::string including(const std::string& other) {
    return R"({"recipe_version": 1, "name": "x", "inputs": {"a": {"recipe": ")" + other +
           R"("}}, "base": "a"})";
  }
  testing::TemporaryFolder folder;
};

TEST_F(RecipeFiles, ARecipeCanBeAnInput) {
  fs::create_directory(folder / "parts");
  write("outer.json", including("parts/inner.json"));
  write("parts/inner.json", R"({"recipe_version": 1, "name": "y", "inputs": {"b": "b.glb"}, "base": "b"})");
  const Recipe outer = load_recipe(folder / "outer.json");
  ASSERT_TRUE(outer.inputs[0].recipe);
  EXPECT_EQ(outer.inputs[0].recipe->name, "y");
  EXPECT_EQ(outer.inputs[0].recipe->inputs[0].file.resolved, folder / "parts/b.glb");
}

TEST_F(RecipeFiles, CirclesAreRefused) {
  write("one.json", including("two.json"));
  write("two.json", including("one.json"));
  EXPECT_THAT(load_failure("one.json", ExitCode::Usage), HasSubstr("two.json:1:"));
  EXPECT_THAT(load_failure("one.json", ExitCode::Usage), HasSubstr("includes itself"));
}

TEST_F(RecipeFiles, ChainsAreBounded) {
  for (int i = 0; i < 20; ++i)
    write("r" + std::to_string(i) + ".json", including("r" + std::to_string(i + 1) + ".json"));
  write("r20.json", R"({"recipe_version": 1, "name": "y", "inputs": {"b": "b.glb"}, "base": "b"})");
  EXPECT_THAT(load_failure("r0.json", ExitCode::Usage), HasSubstr("deeper than 16"));
  EXPECT_EQ(load_failure("r4.json", ExitCode::Usage), "no error");
}

TEST_F(RecipeFiles, FilesThatCannotBeRead) {
  EXPECT_THAT(load_failure("none.json", ExitCode::BadInput), HasSubstr("none.json: no such file"));
  fs::create_directory(folder / "folder.json");
  EXPECT_THAT(load_failure("folder.json", ExitCode::BadInput), HasSubstr("not a regular file"));
  write("outer.json", including("none.json"));
  EXPECT_THAT(load_failure("outer.json", ExitCode::BadInput), HasSubstr("none.json: no such file"));
  write("large.json", std::string((1 << 20) + 1, ' '));
  EXPECT_THAT(load_failure("large.json", ExitCode::Usage), HasSubstr("at most 1048576 bytes"));
}

TEST(LoadRecipe, ReadsAllSharedRecipes) {
  SKINFORGE_NEEDS_SHARED();
  int count = 0;
  for (const auto& item : fs::directory_iterator(testing::shared_file("recipes"))) {
    const Recipe recipe = load_recipe(item.path());
    EXPECT_EQ(recipe.name, item.path().stem());
    for (const RecipeInput& input : recipe.inputs)
      EXPECT_TRUE(fs::exists(input.file.resolved)) << input.file.resolved;
    ++count;
  }
  EXPECT_EQ(count, 18);
}

// Verdicts of the index; what needs the files themselves (missing, unknown joint, not a model) is the
// importer's.
TEST(LoadRecipe, JudgesTheHostileRecipes) {
  SKINFORGE_NEEDS_SHARED();
  const std::map<std::string, std::string> rejected = {
      {"empty.json", ":1:1: the file is empty"},
      {"include_self.json", "leads back to itself"},
      {"input_dev_zero.json", "path \"/dev/zero\" is absolute"},
      {"json_truncated.json", ":11:1: expected a key in quotes, found the end of the file"},
      {"number_nan.yaml", ":14:1: unknown key \"blend_radius\""},
      {"output_absolute.json", "/output/glb: output \"/tmp/sf_escape.glb\" must be a plain path"},
      {"output_traversal.json", "/output/glb: output \"../../../escape.glb\" must be a plain path"},
      {"source_is_target.json", "/ops/0: this replaces joint \"spine\" of the base by itself"},
      {"unknown_key.json", "unknown key \"operatons\" (nearest: \"ops\""},
      {"unknown_op.json", "found the string \"explode\""},
      {"version_future.json", "expected recipe version 1, found the number 999"},
      {"yaml_billion_laughs.yaml", ":1:5: anchors"},
      {"yaml_python_tag.yaml", ":14:4: tags"}};
  int count = 0;
  for (const auto& item : fs::directory_iterator(testing::shared_file("hostile/gen/recipes"))) {
    const std::string name = item.path().filename();
    SCOPED_TRACE(name);
    ++count;
    std::string message = "no error";
    try {
      load_recipe(item.path());
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::Usage);
      message = error.what();
    }
    const auto expected = rejected.find(name);
    if (expected == rejected.end()) {
      EXPECT_EQ(message, "no error");
    } else {
      EXPECT_THAT(message, StartsWith(item.path().string() + ":"));
      EXPECT_THAT(message, HasSubstr(expected->second));
    }
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
  EXPECT_EQ(count, 18);
}

}  // namespace
}  // namespace skinforge
