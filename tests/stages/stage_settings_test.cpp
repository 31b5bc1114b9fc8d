#include "stages/stage_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "diff/character_diff.h"
#include "pipeline/engine.h"
#include "recipe/schema_properties.h"
#include "stages/build.h"
#include "testing/assets.h"

// Goal 7 of the build tool: each property of the schema moves exactly the stages that the table declares.
namespace skinforge {
namespace {
using nlohmann::json;
using ::testing::IsEmpty;

json full_recipe() {
  return json::parse(R"({
    "recipe_version": 1, "name": "mix", "base": "horse",
    "inputs": {
      "horse": { "file": "data/horse.glb", "pose": { "Head": { "rotate_deg": [10, 0, 0] } } },
      "human": { "file": "data/human.glb", "clips": ["data/human.glb"] },
      "griffin": "data/griffin.glb" },
    "ops": [
      { "op": "replace", "at": "Neck1", "from": "human", "joint": "Spine",
        "place": { "align": "none", "scale": 1.2, "offset": [0, 0.355, 0.683] },
        "surface": { "elements": "quads" } },
      { "op": "remove", "at": "Tail2" } ],
    "animation": { "clips": ["Walk", "Gallop"] }, "expect": { "triangles": 9000, "golden": { "file": "data/horse.glb" } } })");
}

json bound_recipe() {
  return json::parse(R"({
    "recipe_version": 1, "name": "bound", "base": "human",
    "inputs": { "human": { "file": "data/human.obj",
                           "bind": { "skeleton": "data/human.glb", "method": "heat", "resolution": 16 } } },
    "correctives": { "method": "dqs", "targets": 2 } })");
}

// Parameters in the key of every stage, by label.
using Parameters = std::map<std::string, std::vector<HashedField>>;

class StageSettings : public ::testing::Test {
 protected:
  Parameters parameters_of(const json& recipe) {
    Engine engine(cache_, {});
    const Recipe parsed = parse_recipe(recipe.dump(), testing::repository_file("recipe.json"));
    add_imports(parsed, engine, [&] { engine.run(); });
    engine.run();
    EXPECT_TRUE(engine.is_ok());
    add_grafts(parsed, engine, ReportLevel::Full);
    return engine.parameters();
  }

  // Names of the stages whose own parameters differ, those that are new or gone too.
  static std::set<std::string> moved(const Parameters& before, const Parameters& after) {
    std::set<std::string> names;
    const auto note = [&](const std::string& label) { names.insert(label.substr(0, label.find(' '))); };
    for (const auto& [label, fields] : after)
      if (const auto old = before.find(label); old == before.end() || old->second != fields) note(label);
    for (const auto& [label, fields] : before)
      if (!after.contains(label)) note(label);
    return names;
  }

  MemoryStore store_;
  Cache cache_{store_};
};

// One change of each property, as a patch (RFC 7396, and lists by index below "ops").
struct Flip {
  const char* property;
  const char* pointer;
  json value;
  bool is_bound = false;  // of bound_recipe
  // Stages that come or go with the property, or stand for another: not a matter of keys.
  std::set<std::string> others = {};
};

std::vector<Flip> flips() {
  return {
      {"/$schema", "/$schema", "x.json"},
      {"/name", "/name", "other"},
      {"/inputs/*/file", "/inputs/horse/file", "data/horse.fbx", false, {"complete_clip", "pictures"}},
      {"/inputs/*/clips", "/inputs/human/clips", json::array()},
      {"/inputs/*/pose", "/inputs/human/pose", {{"Head", {{"rotate_deg", {1, 0, 0}}}}}},
      {"/inputs/*/pose/*/rotate_deg", "/inputs/horse/pose/Head/rotate_deg", {11, 0, 0}},
      {"/inputs/*/pose/*/translate", "/inputs/horse/pose/Head/translate", {0, 0.1, 0}},
      {"/inputs/*/bind/skeleton",
       "/inputs/human/bind/skeleton",
       "data/horse.glb",
       true,
       {"complete_clip", "pictures", "quality"}},
      {"/inputs/*/bind/method", "/inputs/human/bind/method", "harmonic", true},
      {"/inputs/*/bind/handle_weight", "/inputs/human/bind/handle_weight", 0.7, true},
      {"/inputs/*/bind/handle_factor", "/inputs/human/bind/handle_factor", 2, true},
      {"/inputs/*/bind/handle_least", "/inputs/human/bind/handle_least", 6, true},
      {"/inputs/*/bind/resolution", "/inputs/human/bind/resolution", 20, true},
      {"/inputs/*/bind/rate_hz", "/inputs/human/bind/rate_hz", 60, true},
      {"/base", "/base", "griffin", false, {"complete_clip", "pictures", "quality"}},
      {"/ops/*/op", "/ops/0/op", "attach"},
      {"/ops/*/at", "/ops/0/at", "Neck2"},
      {"/ops/*/from", "/ops/0/from", "griffin"},
      {"/ops/*/joint", "/ops/0/joint", "Chest"},
      {"/ops/*/place/align", "/ops/0/place/align", "joint"},
      {"/ops/*/place/scale", "/ops/0/place/scale", 1.3},
      {"/ops/*/place/rotate_deg", "/ops/0/place/rotate_deg", {0, 1, 0}},
      {"/ops/*/place/offset", "/ops/0/place/offset", {0, 0, 0}},
      {"/ops/*/place/turn_limit_deg", "/ops/0/place/turn_limit_deg", 30},
      {"/ops/*/blend", "/ops/0/blend", "smin"},
      {"/ops/*/blend/operator", "/ops/0/blend", {{"operator", "gradient"}}},
      {"/ops/*/blend/radius", "/ops/0/blend", {{"radius", 0.05}}},
      {"/animation/clips", "/animation/clips", {"Walk"}, false, {"complete_clip", "quality"}},
      {"/animation/complete", "/animation/complete", false},
      {"/animation/method", "/animation/method", "paper"},
      {"/animation/rate_hz", "/animation/rate_hz", 60},
      {"/animation/tempo", "/animation/tempo", {0.9, 1.1}},
      {"/animation/limb_phase", "/animation/limb_phase", 0.25},
      {"/animation/limb_clearing_deg", "/animation/limb_clearing_deg", 10},
      {"/animation/key_tolerance", "/animation/key_tolerance", 0.001},
      {"/animation/per_clip/*/complete", "/animation/per_clip/Walk", {{"complete", false}}},
      {"/animation/per_clip/*/method", "/animation/per_clip/Walk", {{"method", "paper"}}},
      {"/animation/per_clip/*/rate_hz", "/animation/per_clip/Walk", {{"rate_hz", 60}}},
      {"/animation/per_clip/*/tempo", "/animation/per_clip/Walk", {{"tempo", {0.9, 1.1}}}},
      {"/animation/per_clip/*/limb_clearing_deg", "/animation/per_clip/Walk", {{"limb_clearing_deg", 10}}},
      {"/animation/per_clip/*/limb_phase", "/animation/per_clip/Walk", {{"limb_phase", 0.25}}},
      {"/animation/per_clip/*/loop", "/animation/per_clip/Walk", {{"loop", false}}},
      {"/animation/per_clip/*/use", "/animation/per_clip/Walk", {{"use", {"Walk"}}}},
      {"/animation/per_clip/*/with", "/animation/per_clip/Gallop", {{"with", "human_Walk"}}},
      {"/output/animated", "/output/animated", {"Walk"}, false, {"animated"}},
      {"/correctives/method", "/correctives/method", "poisson", true},
      {"/correctives/targets", "/correctives/targets", 3, true},
      {"/correctives/enough", "/correctives/enough", 0.5, true},
      {"/output/glb", "/output/glb", "other.glb"},
      {"/output/obj", "/output/obj", "other.obj"},
      {"/output/vdb", "/output/vdb", "other.vdb", false, {"vdb"}},
      {"/output/influences", "/output/influences", 8},
      {"/output/influences", "/output/influences", 8, true},
      {"/expect/triangles", "/expect/triangles", 8999},
      {"/expect/triangles/min", "/expect/triangles", {{"min", 1}}},
      {"/expect/triangles/max", "/expect/triangles", {{"max", 8999}}},
      {"/expect/vertices", "/expect/vertices", 1},
      {"/expect/joints", "/expect/joints", 1},
      {"/expect/influences", "/expect/influences", 1},
      {"/expect/materials", "/expect/materials", 1},
      {"/expect/images", "/expect/images", 1},
      {"/expect/morph_targets", "/expect/morph_targets", 1},
      {"/expect/clips", "/expect/clips", 1},
      {"/expect/bytes", "/expect/bytes", 1},
      {"/expect/watertight", "/expect/watertight", true},
      {"/expect/clip_names", "/expect/clip_names", {"Walk"}},
      {"/expect/golden/file", "/expect/golden/file", "data/human.glb"},
      {"/expect/golden/geometry", "/expect/golden/geometry", "2%"},
      {"/expect/golden/normals", "/expect/golden/normals", 5},
      {"/expect/golden/uv", "/expect/golden/uv", 0.5},
      {"/expect/golden/weights", "/expect/golden/weights", 0.5},
      {"/expect/golden/animation", "/expect/golden/animation", 0.1},
      {"/expect/golden/duration", "/expect/golden/duration", 1},
      {"/expect/golden/picture", "/expect/golden/picture", "5%"},
      {"/expect/golden/structure", "/expect/golden/structure", "any"},
  };
}

// Those of "surface" stand in the recipe and in each operation.
std::vector<Flip> surface_flips() {
  const std::vector<std::pair<std::string, json>> values = {{"voxel_factor", 0.7},
                                                            {"voxel", 0.02},
                                                            {"presence_smoothing", 3},
                                                            {"hardness", 0.3},
                                                            {"hardness/at", 0.3},
                                                            {"hardness/from", 0.2},
                                                            {"include_parent", true},
                                                            {"include_parent/at", true},
                                                            {"include_parent/from", true},
                                                            {"keep_or_drop/variance", 0.1},
                                                            {"keep_or_drop/mean", 0.4},
                                                            {"elements", "triangles"},
                                                            {"smoothing", 2}};
  static std::vector<std::string> names;  // what the flips point at
  names.reserve(4 * values.size());
  std::vector<Flip> flips;
  for (const char* prefix : {"/surface/", "/ops/*/surface/"})
    for (const auto& [key, value] : values) {
      const std::string& property = names.emplace_back(prefix + key);
      const bool is_of_operation = property.starts_with("/ops");
      const std::string& pointer =
          names.emplace_back((is_of_operation ? "/ops/0/surface/" : "/surface/") + key);
      flips.push_back({property.c_str(), pointer.c_str(), value});
    }
  return flips;
}

std::vector<Flip> all_flips() {
  std::vector<Flip> all = flips();
  for (Flip& flip : surface_flips()) all.push_back(std::move(flip));
  return all;
}

// Sets what the pointer leads to; scalars on the way give place to objects.
void set(json& document, const std::string& pointer, const json& value) {
  const json::json_pointer path(pointer);
  if (const auto parent = path.parent_pointer(); !parent.empty()) {
    if (!document.contains(parent) || !(document[parent].is_object() || document[parent].is_array()))
      document[parent] = json::object();
  }
  document[path] = value;
}

TEST_F(StageSettings, Goal07EachPropertyMovesExactlyItsStages) {
  const Parameters full = parameters_of(full_recipe()), bound = parameters_of(bound_recipe());
  for (const Flip& flip : all_flips()) {
    json recipe = flip.is_bound ? bound_recipe() : full_recipe();
    set(recipe, flip.pointer, flip.value);
    std::set<std::string> actual;
    try {
      actual = moved(flip.is_bound ? bound : full, parameters_of(recipe));
    } catch (const Error& error) {
      ADD_FAILURE() << flip.property << ": " << error.what();
      continue;
    }
    std::set<std::string> declared = flip.others;
    for (const auto& [label, fields] : flip.is_bound ? bound : full) {
      StageInfo stage;
      stage.name = label.substr(0, label.find(' '));
      if (stage.name != label) stage.instance = label.substr(stage.name.size() + 1);
      if (reads_setting(stage, flip.pointer)) declared.insert(stage.name);
    }
    if (std::string_view(flip.pointer) == "/$schema") declared.clear();  // no setting: recipe_settings
    EXPECT_EQ(actual, declared) << flip.property;
  }
}

// Containers, and properties that need files which the repository does not have.
bool is_covered_elsewhere(const std::string& pattern) {
  static const std::set<std::string> kRest = {"/recipe_version",
                                              "/extends",
                                              "/inputs/*/recipe",
                                              "/inputs/*/bind/handles",
                                              "/correctives/rest",
                                              "/correctives/kernel",
                                              "/correctives/joints",
                                              "/correctives/examples",
                                              "/correctives/examples/*/shape",
                                              "/correctives/examples/*/pose"};
  if (kRest.contains(pattern)) return true;
  if (pattern.starts_with("/vars/") || pattern.starts_with("/matrix/")) return true;
  if (pattern.ends_with("/include")) return true;
  if (pattern.starts_with("/inputs/*/bind/handles/")) return true;
  const bool is_end = pattern.ends_with("/min") || pattern.ends_with("/max");  // of triangles stands for all
  if (is_end && pattern.starts_with("/expect/")) return true;
  const auto& all = schema_properties();
  return std::any_of(all.begin(), all.end(),
                     [&](const SchemaProperty& p) { return p.pattern.starts_with(pattern + "/"); });
}

// The limits of a golden are those of `diff` where the recipe does not say otherwise.
TEST(GoldenOptions, AreThoseOfDiff) {
  const GoldenOptions golden;
  const DiffThresholds diff;
  EXPECT_EQ(golden.geometry, diff.geometry);
  EXPECT_EQ(golden.normals, diff.normals);
  EXPECT_EQ(golden.uv, diff.uv);
  EXPECT_EQ(golden.weights, diff.weights);
  EXPECT_EQ(golden.animation, diff.animation);
  EXPECT_EQ(golden.duration, diff.duration);
  EXPECT_EQ(golden.picture, diff.picture);
  EXPECT_EQ(golden.structure, diff.structure);
}

TEST_F(StageSettings, Goal07NoPropertyIsLeftOut) {
  std::set<std::string> flipped;
  for (const Flip& flip : all_flips()) flipped.insert(flip.property);
  std::vector<std::string> missing;
  for (const SchemaProperty& property : schema_properties())
    if (!flipped.contains(property.pattern) && !is_covered_elsewhere(property.pattern))
      missing.push_back(property.pattern);
  EXPECT_THAT(missing, IsEmpty());
  for (const StageSetting& row : stage_settings()) {
    const auto& all = schema_properties();
    const bool is_known = std::any_of(all.begin(), all.end(), [&](const SchemaProperty& p) {
      return p.pattern.starts_with(row.property) || std::string(row.property) == p.pattern + "/*";
    });
    EXPECT_TRUE(is_known) << row.property;
  }
}

TEST_F(StageSettings, EachStageReadsItsOwn) {
  const auto stage = [](const char* name, const char* instance, const char* artifact) {
    return StageInfo{.name = name, .instance = instance, .writes = {artifact}};
  };
  EXPECT_TRUE(reads_setting(stage("import", "horse", "imported:horse"), "/inputs/horse"));
  EXPECT_FALSE(reads_setting(stage("import", "horse", "imported:horse"), "/inputs/human"));
  EXPECT_TRUE(reads_setting(stage("field", "2", "field:1"), "/ops/1/blend/radius"));
  EXPECT_FALSE(reads_setting(stage("field", "2", "field:1"), "/ops/0/blend/radius"));
  EXPECT_TRUE(reads_setting(stage("place", "", "placement"), "/ops/0/place/scale"));
  EXPECT_FALSE(reads_setting(stage("place", "", "placement"), "/ops/0/surface/smoothing"));
  EXPECT_TRUE(reads_setting(stage("report", "", "report"), "/anything"));
  // of the recipe behind the input "body"
  EXPECT_FALSE(reads_setting(stage("place", "", "body/placement"), "/ops/0/place/scale"));
  EXPECT_TRUE(reads_setting(stage("place", "", "body/placement"), "/inputs/body/recipe/ops/0/place/scale"));
  EXPECT_FALSE(reads_setting(stage("place", "", "placement"), "/inputs/body/recipe/ops/0/place/scale"));
}

TEST_F(StageSettings, SourcesLeadBackToTheRecipe) {
  EXPECT_EQ(setting_of_source("file:horse:0"), "/inputs/horse");
  EXPECT_EQ(setting_of_source("body/file:horse:12"), "/inputs/body/recipe/inputs/horse");
  EXPECT_EQ(setting_of_source("clip:file:horse"), std::nullopt);
  EXPECT_EQ(setting_of_source("placement"), std::nullopt);
}

}  // namespace
}  // namespace skinforge
