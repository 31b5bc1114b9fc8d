#include "recipe/schema.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "recipe/recipe.h"
#include "recipe/value_tree.h"
#include "testing/assets.h"

namespace skinforge {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;

json schema() {
  return json::parse(recipe_schema());
}

bool is_valid(const json& schema_json, const json& document) {
  valijson::Schema compiled;
  valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(schema_json), compiled);
  return valijson::Validator().validate(compiled, valijson::adapters::NlohmannJsonAdapter(document), nullptr);
}

json to_json(const Value& value) {
  switch (value.kind) {
    case Value::Kind::Null:
      return nullptr;
    case Value::Kind::Bool:
      return value.boolean;
    case Value::Kind::Number:
      return json::parse(value.text);
    case Value::Kind::String:
      return value.text;
    case Value::Kind::Array: {
      json items = json::array();
      for (const Value& item : value.items) items.push_back(to_json(item));
      return items;
    }
    case Value::Kind::Object: {
      json object = json::object();
      for (const auto& member : value.members) object[member.key] = to_json(member.value);
      return object;
    }
  }
  return {};
}

std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

bool parser_accepts(const std::string& text) {
  try {
    parse_recipe(text, "x.json");
    return true;
  } catch (const Error&) {
    return false;
  }
}

// skinforge schema > schemas/recipe.schema.json
TEST(RecipeSchema, TheFileIsWhatTheCodeSays) {
  EXPECT_EQ(read_text(testing::repository_file("schemas/recipe.schema.json")), recipe_schema());
}

void for_each_property(const json& node, const std::string& place,
                       const std::function<void(const std::string&, const json&)>& visit) {
  if (node.is_object() && node.contains("properties") && node.contains("additionalProperties"))
    for (const auto& [name, property] : node.at("properties").items()) visit(place + "/" + name, property);
  if (node.is_structured())
    for (const auto& [key, child] : node.items()) for_each_property(child, place + "/" + key, visit);
}

TEST(RecipeSchema, EveryPropertyIsExplained) {
  int count = 0;
  for_each_property(schema(), "", [&](const std::string& place, const json& property) {
    SCOPED_TRACE(place);
    ++count;
    EXPECT_TRUE(property.contains("description"));
    ASSERT_TRUE(property.contains("examples"));
    for (const json& example : property.at("examples")) EXPECT_TRUE(is_valid(property, example)) << example;
    EXPECT_TRUE(!property.contains("default") || is_valid(property, property.at("default")));
    const json& rules = property.contains("anyOf") ? property.at("anyOf").at(0) : property;
    const std::string type = rules.contains("type") && rules.at("type").is_string() ? rules.at("type") : "";
    const bool is_number = type == "number" || type == "integer";
    EXPECT_TRUE(!is_number || property.contains("unit"));
    const bool is_inherited =
        place.find("/ops/") != std::string::npos && place.find("/surface/") != std::string::npos;
    const bool is_side = place.find("/anyOf/") != std::string::npos;  // the default is of both together
    const bool has_no_default =
        is_inherited || is_side || place.ends_with("/voxel") || place.ends_with("/radius");
    EXPECT_TRUE(!(is_number || type == "boolean") || property.contains("default") || has_no_default);
  });
  // 14 of the recipe, 5 + 2 + 8 + 2 of an input, 7 + 4 + 2 of an operation, twice 8 + 2 + 4 of its surface, 9
  // + 9 of the animation, 7 + 2 and 5 of correctives and output, 11 budgets of which 9 have two ends, a
  // golden of 9, 6 of a variable and 2 of the matrix; and in each object that may take a part from a file,
  // `include`
  EXPECT_EQ(count, 187);
}

struct Case {
  const char* what;
  std::string text;
  bool is_good = false;
};

std::string operation(const std::string& body) {
  return R"({"recipe_version": 1, "name": "x", "inputs": {"a": "a.glb", "b": "b.glb"}, "base": "a", "ops": [{)" +
         body + "}]}";
}
std::string member(const std::string& body) {
  return R"({"recipe_version": 1, "name": "x", "inputs": {"a": "a.glb"}, "base": "a", )" + body + "}";
}
std::string head(const std::string& body) {
  return "{" + body + "}";
}
const std::string kPart = R"("op": "replace", "at": "j", "from": "b", "joint": "k", )";

TEST(RecipeSchema, AgreesWithTheParser) {
  const json compiled = schema();
  const std::vector<Case> cases = {
      {"smallest", head(R"("recipe_version": 1, "name": "x", "inputs": {"a": "a.glb"}, "base": "a")"), true},
      {"replace", operation(R"("op": "replace", "at": ["j", "k"], "from": "b", "joint": "k")"), true},
      {"attach one in a list", operation(R"("op": "attach", "at": ["j"], "from": "b", "joint": "k")"), true},
      {"remove", operation(R"("op": "remove", "at": ["j", "k"])"), true},
      {"placement", operation(kPart + R"("place": {"align": "none", "scale": 2, "rotate_deg": [1, 2, 3]})"),
       true},
      {"scale by loop", operation(kPart + R"("place": {"scale": "loop"}, "blend": "blend")"), true},
      {"blend operator", operation(kPart + R"("blend": {"operator": "gradient", "radius": 0.1})"), true},
      {"all options",
       member(R"("surface": {"voxel_factor": 1, "presence_smoothing": 0, "keep_or_drop": {"mean": 0}},
                 "animation": {"clips": [], "complete": false, "method": "paper", "rate_hz": 60, "tempo": [0.5, 2],
                   "limb_phase": 0.5, "limb_clearing_deg": 30, "key_tolerance": 0, "per_clip": {"Run": {"use": ["Walk"], "loop": false}}},
                 "output": {"glb": "a/b.glb", "animated": "all", "influences": 8})"),
       true},
      {"input object",
       head(
           R"("recipe_version": 1, "name": "x", "base": "a", "inputs": {"a": {"file": "a.glb", "clips": ["c.fbx"],
               "pose": {"Head": {"rotate_deg": [1, 2, 3]}}}})"),
       true},
      {"bind", head(R"("recipe_version": 1, "name": "x", "base": "a",
               "inputs": {"a": {"file": "a.obj", "bind": {"skeleton": "a.tgf", "method": "heat", "resolution": 64}}})"),
       true},
      {"bind with its own skeleton", head(R"("recipe_version": 1, "name": "x", "base": "a",
               "inputs": {"a": {"file": "a.obj", "bind": {"method": "heat"}}})"),
       true},
      {"painted handles",
       head(R"("recipe_version": 1, "name": "x", "base": "a", "inputs": {"a": {"file": "a.obj",
               "bind": {"handles": {"image": "l.png", "colors": {"Head": "#ff8000"}}}}})"),
       true},
      {"painted without colors",
       head(R"("recipe_version": 1, "name": "x", "base": "a", "inputs": {"a": {"file": "a.obj",
               "bind": {"handles": {"image": "l.png", "colors": {}}}}})")},
      {"colour word", head(R"("recipe_version": 1, "name": "x", "base": "a", "inputs": {"a": {"file": "a.obj",
               "bind": {"handles": {"image": "l.png", "colors": {"Head": "red"}}}}})")},
      {"correctives", member(R"("correctives": {"method": "dqs", "targets": 4, "enough": 0})"), true},
      {"correctives without method", member(R"("correctives": {"targets": 4})")},
      {"no targets", member(R"("correctives": {"method": "dqs", "targets": 0})")},
      {"no version", head(R"("name": "x", "inputs": {"a": "a.glb"}, "base": "a")")},
      {"other version", head(R"("recipe_version": 2, "name": "x", "inputs": {"a": "a.glb"}, "base": "a")")},
      {"no name", head(R"("recipe_version": 1, "inputs": {"a": "a.glb"}, "base": "a")")},
      {"no base", head(R"("recipe_version": 1, "name": "x", "inputs": {"a": "a.glb"})")},
      {"unsafe name", head(R"("recipe_version": 1, "name": "../x", "inputs": {"a": "a.glb"}, "base": "a")")},
      {"no inputs", head(R"("recipe_version": 1, "name": "x", "inputs": {}, "base": "a")")},
      {"input of wrong type", head(R"("recipe_version": 1, "name": "x", "inputs": {"a": 1}, "base": "a")")},
      {"input without file", head(R"("recipe_version": 1, "name": "x", "inputs": {"a": {}}, "base": "a")")},
      {"file and recipe",
       head(
           R"("recipe_version": 1, "name": "x", "inputs": {"a": {"file": "f", "recipe": "r"}}, "base": "a")")},
      {"absolute input",
       head(R"("recipe_version": 1, "name": "x", "inputs": {"a": "/dev/zero"}, "base": "a")")},
      {"backslash", head(R"("recipe_version": 1, "name": "x", "inputs": {"a": "..\\a.glb"}, "base": "a")")},
      {"address",
       head(R"("recipe_version": 1, "name": "x", "inputs": {"a": "http://h/a.glb"}, "base": "a")")},
      {"unsafe input name",
       head(R"("recipe_version": 1, "name": "x", "inputs": {"a/b": "a.glb"}, "base": "a/b")")},
      {"unknown key", member(R"("operatons": [])")},
      {"unknown key in place", operation(kPart + R"("place": {"rotate": [0, 0, 0]})")},
      {"unknown operation", operation(R"("op": "explode", "at": "j")")},
      {"no at", operation(R"("op": "remove")")},
      {"empty at", operation(R"("op": "remove", "at": [])")},
      {"at twice", operation(R"("op": "remove", "at": ["j", "j"])")},
      {"at of wrong type", operation(R"("op": "remove", "at": 5)")},
      {"detach of two", operation(R"("op": "detach", "at": ["j", "k"])")},
      {"attach to two", operation(R"("op": "attach", "at": ["j", "k"], "from": "b", "joint": "k")")},
      {"replace without from", operation(R"("op": "replace", "at": "j", "joint": "k")")},
      {"remove with from", operation(R"("op": "remove", "at": "j", "from": "b")")},
      {"scale zero", operation(kPart + R"("place": {"scale": 0})")},
      {"scale word", operation(kPart + R"("place": {"scale": "big"})")},
      {"two numbers", operation(kPart + R"("place": {"offset": [0, 0]})")},
      {"text in a vector", operation(kPart + R"("place": {"offset": [0, 0, "x"]})")},
      {"blend", operation(kPart + R"("blend": "soft")")},
      {"replace by union", operation(kPart + R"("blend": "union")")},
      {"voxel factor", member(R"("surface": {"voxel_factor": 0})")},
      {"whole surface",
       operation(kPart + R"("surface": {"voxel": 0.1, "hardness": {"at": 0.5}, "include_parent": true,
                                        "elements": "quads", "smoothing": 3})"),
       true},
      {"attach hardness",
       operation(R"("op": "attach", "at": "j", "from": "b", "joint": "k", "surface": {"hardness": 0.2})"),
       true},
      {"remove with its parent",
       operation(R"("op": "remove", "at": "j", "surface": {"include_parent": true})"), true},
      {"two voxels", operation(kPart + R"("surface": {"voxel": 0.1, "voxel_factor": 1})")},
      {"hardness", operation(kPart + R"("surface": {"hardness": 1})")},
      {"hardness of a side", operation(kPart + R"("surface": {"hardness": {"top": 0}})")},
      {"elements", operation(kPart + R"("surface": {"elements": "tris"})")},
      {"remove hardness", operation(R"("op": "remove", "at": "j", "surface": {"hardness": 0})")},
      {"remove voxel", operation(R"("op": "remove", "at": "j", "surface": {"voxel": 1})")},
      {"remove from",
       operation(R"("op": "remove", "at": "j", "surface": {"include_parent": {"from": true}})")},
      {"detach parent", operation(R"("op": "detach", "at": "j", "surface": {"include_parent": true})")},
      {"attach at", operation(R"("op": "attach", "at": "j", "from": "b", "joint": "k",
                                 "surface": {"hardness": {"at": 0.2}})")},
      {"half a pass", member(R"("surface": {"presence_smoothing": 1.5})")},
      {"clips word", member(R"("animation": {"clips": "none"})")},
      {"rate", member(R"("animation": {"rate_hz": 0})")},
      {"tempo", member(R"("animation": {"tempo": [2, 0.5]})")},
      {"method", member(R"("animation": {"method": "best"})")},
      {"use and with", member(R"("animation": {"per_clip": {"Run": {"use": ["Walk"], "with": "Idle"}}})")},
      {"complete", member(R"("animation": {"complete": "yes"})")},
      {"influences", member(R"("output": {"influences": 5})")},
      {"budgets", member(R"("expect": {"triangles": 10, "clips": {"min": 1, "max": 2}, "watertight": true,
                             "clip_names": ["Walk"]})"),
       true},
      {"unknown budget", member(R"("expect": {"polygons": 10})")},
      {"empty budget", member(R"("expect": {"joints": "few"})")},
      {"a variable", member(R"("vars": {"rate": 60}, "animation": {"rate_hz": "${rate}"})"), true},
      {"a variable of objects", member(R"("vars": {"rate": {"default": 60, "rate": 1}})")},
      {"a matrix", head(R"("recipe_version": 1, "name": "x${matrix.m}", "inputs": {"a": "${matrix.m}.glb"},
                           "base": "a", "matrix": {"m": ["one"]})"),
       true},
      {"an empty axis", member(R"("matrix": {"m": []})")},
      {"output leaves", member(R"("output": {"glb": "../x.glb"})")},
      {"output absolute", member(R"("output": {"glb": "/tmp/x.glb"})")},
      {"output extension", member(R"("output": {"obj": "x.glb"})")},
  };
  for (const Case& c : cases) {
    EXPECT_EQ(parser_accepts(c.text), c.is_good) << "parser: " << c.what;
    EXPECT_EQ(is_valid(compiled, json::parse(c.text)), c.is_good) << "schema: " << c.what;
  }
}

// A property without what it may be instead: a reference to a variable, or an object of another file.
const json& rules_of(const json& property) {
  return property.contains("anyOf") ? property.at("anyOf").at(0) : property;
}

// An object with the defaults that the schema states for its properties, those inside it too. What cannot
// stand without a required key has no default.
json stated_defaults(const json& object_schema) {
  json object = json::object();
  for (const auto& [name, property] : rules_of(object_schema).at("properties").items()) {
    const json& rules = rules_of(property);
    if (property.contains("default"))
      object[name] = property.at("default");
    else if (rules.contains("properties") && !rules.contains("required"))
      object[name] = stated_defaults(property);
  }
  return object;
}

// A recipe that writes out every default is the recipe that leaves them all out.
TEST(RecipeSchema, DefaultsAreThoseOfTheParser) {
  const json compiled = schema();
  const json smallest = {{"recipe_version", 1},
                         {"name", "x"},
                         {"base", "a"},
                         {"inputs", {{"a", {{"file", "a.glb"}}}, {"b", {{"file", "b.glb"}}}}},
                         {"ops", {{{"op", "replace"}, {"at", "j"}, {"from", "b"}, {"joint", "k"}}}}};
  json whole = smallest;
  whole.update(stated_defaults({{"properties",
                                 {{"surface", compiled.at("properties").at("surface")},
                                  {"animation", compiled.at("properties").at("animation")},
                                  {"output", compiled.at("properties").at("output")}}}}));
  whole["ops"][0].update(stated_defaults(rules_of(compiled.at("properties").at("ops")).at("items")));
  const json& inputs = rules_of(compiled.at("properties").at("inputs"));
  const json& input = inputs.at("additionalProperties").at("anyOf").at(1);
  whole["inputs"]["b"].update(stated_defaults(input));
  const json& pose = rules_of(rules_of(input).at("properties").at("pose")).at("additionalProperties");
  whole["inputs"]["b"]["pose"]["Head"] = stated_defaults(pose);

  const Recipe little = parse_recipe(smallest.dump(), "x.json"), all = parse_recipe(whole.dump(), "x.json");
  EXPECT_EQ(whole.at("surface").size(), 7U);
  EXPECT_EQ(whole.at("ops").at(0).at("place").size(), 5U);
  EXPECT_EQ(little.operations, all.operations);
  EXPECT_EQ(little.surface, all.surface);
  EXPECT_EQ(little.animation, all.animation);
  EXPECT_EQ(little.output, all.output);
  EXPECT_EQ(all.inputs.at(1).clips.size(), 0U);
  EXPECT_EQ(all.inputs.at(1).pose.at("Head"), PoseChange());
}

// Paths, comments and the order of keys change nothing that is asked for; every value does.
TEST(RecipeDigest, KnowsWhatIsAskedFor) {
  const auto digest = [](const std::string& text) { return recipe_digest(parse_recipe(text, "x.json")); };
  const std::string plain = operation(kPart + R"("place": {"scale": 2})");
  EXPECT_EQ(digest(plain), digest("// a comment\n" + plain));
  std::string elsewhere = plain;
  elsewhere.replace(elsewhere.find("a.glb"), 5, "../other/a.glb");
  EXPECT_EQ(digest(plain), digest(elsewhere));
  for (const std::string& other :
       {operation(kPart + R"("place": {"scale": 3})"), operation(kPart + R"("blend": "blend")"),
        operation(R"("op": "remove", "at": "j")")})
    EXPECT_NE(digest(plain), digest(other)) << other;
}

// What a schema cannot say: the parser alone refuses these.
TEST(RecipeSchema, LeavesReferencesToTheParser) {
  const json compiled = schema();
  for (const std::string& text :
       {member(R"("ops": [{"op": "replace", "at": "j", "from": "nobody", "joint": "k"}])"),
        head(R"("recipe_version": 1, "name": "x", "inputs": {"a": "a.glb"}, "base": "b")"),
        head(R"("recipe_version": 1, "name": "con", "inputs": {"a": "a.glb"}, "base": "a")"),
        operation(R"("op": "replace", "at": "j", "from": "a", "joint": "j")")}) {
    EXPECT_TRUE(is_valid(compiled, json::parse(text))) << text;
    EXPECT_FALSE(parser_accepts(text)) << text;
  }
}

TEST(RecipeSchema, AcceptsTheRepositorysRecipes) {
  const json compiled = schema();
  for (const auto& item : fs::directory_iterator(testing::repository_file("recipes"))) {
    if (item.path().extension() != ".json" && item.path().extension() != ".yaml") continue;
    SCOPED_TRACE(item.path());
    load_recipe(item.path());
    const std::string text = read_text(item.path());
    const bool is_yaml = item.path().extension() == ".yaml";
    EXPECT_TRUE(is_valid(compiled, to_json(is_yaml ? parse_yaml_text(text, "") : parse_json_text(text, ""))));
  }
}

TEST(RecipeSchema, AcceptsAllSharedRecipes) {
  SKINFORGE_NEEDS_SHARED();
  const json compiled = schema();
  for (const auto& item : fs::directory_iterator(testing::shared_file("recipes")))
    EXPECT_TRUE(is_valid(compiled, json::parse(read_text(item.path())))) << item.path();
}

}  // namespace
}  // namespace skinforge
