#include "recipe/migrate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "recipe/recipe.h"
#include "recipe/recipe_file.h"

// Older recipes become recipes of the present version, and nothing else of their text moves.
namespace skinforge {
namespace {
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

std::string error_of(const std::string& text, const char* path = "x.json") {
  try {
    migrate_recipe(text, path);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::Usage);
    return error.what();
  }
  return "";
}

constexpr const char* kDraft = R"(// my centaur
{
  "$schema": "../schemas/recipe.schema.json",
  "name": "centaur",   // goes to out/centaur
  "inputs": {
    "horse": { "file": "horse.glb", "root": "Body" },
    "man": {
      "file": "man.fbx",  /* from the shop */
      "root": "Hips"      // as ever
    }
  },
  "base": "horse",
  "ops": [ { "op": "replace", "at": "Neck1", "from": "man", "joint": "Spine", "blend": "union" } ]
}
)";

TEST(Migrate, ADraftKeepsItsCommentsAndItsLayout) {
  const Migration migration = migrate_recipe(kDraft, "x.json");
  EXPECT_EQ(migration.text, R"(// my centaur
{
  "$schema": "../schemas/recipe.schema.json",
  "recipe_version": 1,
  "name": "centaur",   // goes to out/centaur
  "inputs": {
    "horse": { "file": "horse.glb" },
    "man": {
      "file": "man.fbx"  /* from the shop */
      // as ever
    }
  },
  "base": "horse",
  "ops": [ { "op": "replace", "at": "Neck1", "from": "man", "joint": "Spine", "blend": "auto" } ]
}
)");
  EXPECT_THAT(migration.changes,
              ElementsAre(StartsWith("x.json:4:3: /recipe_version: 1 is written"),
                          StartsWith("x.json:6:37: /inputs/horse/root is gone"),
                          StartsWith("x.json:9:7: /inputs/man/root is gone"),
                          StartsWith("x.json:13:88: /ops/0/blend: \"union\" is \"auto\" now")));
  const Recipe recipe = parse_recipe(migration.text, "x.json");
  EXPECT_EQ(recipe.name, "centaur");
}

TEST(Migrate, YamlLikewise) {
  const Migration migration = migrate_recipe(R"(# my centaur
name: centaur
inputs:
  horse:
    root: Body    # as ever
    file: horse.glb
  man: { file: man.fbx, root: Hips }
base: horse
ops:
  - op: attach
    at: Neck1
    from: man
    joint: Spine
    blend: blend
)",
                                             "x.yaml");
  EXPECT_EQ(migration.text, R"(# my centaur
recipe_version: 1
name: centaur
inputs:
  horse:
    # as ever
    file: horse.glb
  man: { file: man.fbx }
base: horse
ops:
  - op: attach
    at: Neck1
    from: man
    joint: Spine
    blend: auto
)");
  EXPECT_EQ(migration.changes.size(), 4U);
  EXPECT_EQ(parse_recipe(migration.text, "x.yaml").operations.size(), 1U);
}

TEST(Migrate, OneLineAndOtherLetters) {
  const std::string before =
      "\xEF\xBB\xBF{\"name\":\"x\",\"inputs\":{\"r\xC3\xB6\":{\"root\":\"a\",\"file\":\"m.glb\"}},"
      "\"base\":\"r\xC3\xB6\"}";
  EXPECT_EQ(
      migrate_recipe(before, "x.json").text,
      "\xEF\xBB\xBF{\"recipe_version\": 1, \"name\":\"x\",\"inputs\":{\"r\xC3\xB6\":{\"file\":\"m.glb\"}},"
      "\"base\":\"r\xC3\xB6\"}");
}

TEST(Migrate, TheVersionItselfIsRaised) {
  EXPECT_EQ(migrate_recipe(R"({"recipe_version": 0, "name": "x"})", "x.json").text,
            R"({"recipe_version": 1, "name": "x"})");
}

// What is written once needs nothing a second time, and a recipe of today nothing at all.
TEST(Migrate, IsDoneOnce) {
  const Migration once = migrate_recipe(kDraft, "x.json");
  const Migration twice = migrate_recipe(once.text, "x.json");
  EXPECT_THAT(twice.changes, IsEmpty());
  EXPECT_EQ(twice.text, once.text);
}

// A base or a part has the version of what uses it.
TEST(Migrate, PartsOfRecipesGetNoVersion) {
  for (const char* text : {R"({"extends": "base.json", "inputs": {"a": "a.glb"}, "base": "a"})",
                           R"({"extra_arms": [{"op": "attach"}]})", R"([{"op": "attach"}])"})
    EXPECT_THAT(migrate_recipe(text, "x.json").changes, IsEmpty()) << text;
}

TEST(Migrate, NewerVersionsAreLeftAlone) {
  EXPECT_THAT(error_of(R"({"recipe_version": 2, "name": "x"})"),
              HasSubstr("x.json:1:20: /recipe_version: 2 is newer than 1"));
  EXPECT_THAT(error_of(R"({"recipe_version": "new"})"), HasSubstr("expected a whole number"));
  EXPECT_THAT(error_of("{"), StartsWith("x.json:1:2"));
}
}  // namespace
}  // namespace skinforge
