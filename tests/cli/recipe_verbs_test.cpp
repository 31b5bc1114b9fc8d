#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "testing/assets.h"
#include "testing/program.h"
#include "testing/temporary_folder.h"

// `migrate` and `report`, as people call them.
namespace skinforge {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using testing::Program;
using testing::ProgramResult;

std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class RecipeVerbs : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::copy_file(testing::repository_file("data/human.glb"), folder / "human.glb");
    write("only.json", R"({ "recipe_version": 1, "name": "only", "inputs": { "a": "human.glb" }, "base": "a",
  "animation": { "clips": ["Idle"] } })");
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }
  ProgramResult call(const std::vector<std::string>& arguments) const {
    return Program(SKINFORGE_BINARY, arguments, folder.path()).finish();
  }

  testing::TemporaryFolder folder;
};

TEST_F(RecipeVerbs, MigrateRewritesADraft) {
  const std::string draft = R"({ // first try
  "name": "old", "inputs": { "a": { "file": "human.glb", "root": "Hips" } }, "base": "a" })";
  write("old.json", draft);
  const ProgramResult refused = call({"check", "old.json"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("skinforge migrate"));

  const ProgramResult checked = call({"migrate", "old.json", "only.json", "--check", "--json"});
  EXPECT_EQ(checked.status, 5);
  EXPECT_EQ(json::parse(checked.out).at("recipes").at(0).at("changes").size(), 2U);
  EXPECT_TRUE(json::parse(checked.out).at("recipes").at(1).at("changes").empty());
  EXPECT_EQ(read_text(folder / "old.json"), draft);

  const ProgramResult done = call({"migrate", "old.json"});
  EXPECT_EQ(done.status, 0);
  EXPECT_THAT(done.err, HasSubstr("old.json:2:58: /inputs/a/root is gone"));
  EXPECT_THAT(read_text(folder / "old.json"), HasSubstr("// first try\n  \"recipe_version\": 1"));
  EXPECT_EQ(call({"migrate", "old.json", "--check"}).status, 0);
  EXPECT_EQ(call({"check", "old.json"}).status, 0);
}

TEST_F(RecipeVerbs, MigrateLeavesTheNewerAlone) {
  write("new.json", R"({ "recipe_version": 2, "name": "x" })");
  const ProgramResult result = call({"migrate", "new.json", "none.json"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("new.json:1:21: /recipe_version: 2 is newer than 1"));
  EXPECT_THAT(result.err, HasSubstr("none.json: no such file"));
}

// Of a build without a report: only what tells of the character runs, and the character is not written again.
TEST_F(RecipeVerbs, ReportIsWrittenFromTheCache) {
  const ProgramResult nothing = call({"report", "only.json"});
  EXPECT_EQ(nothing.status, 3);
  EXPECT_THAT(nothing.err, HasSubstr("not in the cache: stage import a"));
  EXPECT_FALSE(fs::exists(folder / "out"));

  ASSERT_EQ(call({"build", "only.json", "--report", "none"}).status, 0);
  fs::remove_all(folder / "out");
  const ProgramResult result = call({"report", "only.json", "--out", "told", "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(fs::exists(folder / "told/report.html"));
  EXPECT_TRUE(fs::exists(folder / "told/pictures/rest.png"));
  EXPECT_TRUE(fs::exists(folder / "told/timings.json"));
  EXPECT_FALSE(fs::exists(folder / "told/only.glb"));
  EXPECT_EQ(result.out, read_text(folder / "told/report.json"));

  ASSERT_EQ(call({"build", "only.json", "--out", "built"}).status, 0);  // the same as that of the build
  EXPECT_EQ(read_text(folder / "told/report.json"), read_text(folder / "built/report.json"));

  write("only.json", R"({ "recipe_version": 1, "name": "only", "inputs": { "a": "human.glb" }, "base": "a",
  "ops": [ { "op": "remove", "at": "Head" } ], "animation": { "clips": ["Idle"] } })");
  const ProgramResult changed = call({"report", "only.json"});
  EXPECT_EQ(changed.status, 3);
  EXPECT_THAT(changed.err, HasSubstr("skinforge build makes it"));
}
}  // namespace
}  // namespace skinforge
