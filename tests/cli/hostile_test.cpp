// The hostile corpus through the program: what a person sees of it. scripts/hostile.sh watches memory, time,
// files and network besides.
#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "testing/assets.h"
#include "testing/program.h"
#include "testing/temporary_folder.h"

namespace skinforge {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::Program;
using testing::ProgramResult;

constexpr int kBadInput = 3;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// What the case asks for, by the letter of the corpus's README.
void expect_verdict(const nlohmann::json& item, const ProgramResult& result) {
  const std::string expect = item.at("expect"), file = item.at("file");
  const bool is_warned = result.out.find("warning ") != std::string::npos;
  if (expect == "accept") {
    EXPECT_EQ(result.status, 0) << result.err;
  } else if (expect == "accept-warn") {
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(is_warned) << result.out;
  } else if (expect == "reject") {
    EXPECT_EQ(result.status, kBadInput) << result.out;
  } else {
    EXPECT_TRUE(result.status == kBadInput || is_warned) << result.out;
  }
  if (result.status == 0) return;
  const auto lines = lines_of(result.err);
  ASSERT_EQ(lines.size(), 1u) << result.err;
  EXPECT_THAT(lines[0], HasSubstr(fs::path(file).filename().string() + ": "));
  for (const auto& word : item.value("message_must_contain", nlohmann::json::array()))
    EXPECT_THAT(lines[0], HasSubstr(word.get<std::string>()));
}

TEST(Hostile, EveryAssetGetsItsVerdict) {
  SKINFORGE_NEEDS_SHARED();
  const testing::TemporaryFolder folder;
  const fs::path hostile = fs::absolute(testing::shared_file("hostile"));
  int seen = 0;
  for (const auto& item : nlohmann::json::parse(std::ifstream(hostile / "index.json"))) {
    const std::string file = item.at("file"), kind = item.at("kind");
    if (kind.starts_with("recipe")) continue;
    SCOPED_TRACE(file);
    ++seen;
    expect_verdict(item, Program(SKINFORGE_BINARY, {"inspect", hostile / file}, folder.path()).finish());
  }
  EXPECT_EQ(seen, 213);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

// In a build, too, the line names the recipe, the input and the cause, and nothing is written.
TEST(Hostile, ABrokenInputIsNamedByItsRecipe) {
  const testing::TemporaryFolder folder;
  fs::create_directories(folder / "models");
  std::ofstream(folder / "models/broken.glb") << "glTF, but not really";
  std::ofstream(folder / "models/notes") << "no model at all";
  for (const auto& [input, cause] :
       {std::pair("broken.glb", "broken.glb: "), {"notes", "no model format ends in"}}) {
    std::ofstream(folder / "r.json") << R"({ "recipe_version": 1, "name": "r",
  "inputs": { "a": "models/)" << input
                                     << R"(" }, "base": "a", "ops": [] })";
    const auto result =
        Program(SKINFORGE_BINARY, {"build", "r.json", "-q", "--cache", "cache"}, folder.path()).finish();
    EXPECT_EQ(result.status, kBadInput);
    EXPECT_THAT(result.err, HasSubstr("r.json:2:20: /inputs/a: "));
    EXPECT_THAT(result.err, HasSubstr(cause));
    EXPECT_FALSE(fs::exists(folder / "out"));
  }
}

// Faces that lie on each other in the input do so in the output, and all joints of a skin without inverse
// bind matrices stand at one place: warned of, no fault of what was written.
TEST(Hostile, WhatAnInputHasIsNoFaultOfTheOutput) {
  const testing::TemporaryFolder folder;
  std::ofstream(folder / "a.obj")
      << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n";
  std::ofstream(folder / "r.json")
      << R"({ "recipe_version": 1, "name": "r", "inputs": { "a": "a.obj" }, "base": "a", "ops": [] })";
  const auto result =
      Program(SKINFORGE_BINARY, {"build", "r.json", "--cache", "cache", "--out", "out", "--report", "json"},
              folder.path())
          .finish();
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(fs::exists(folder / "out/r.glb"));
  std::ifstream report(folder / "out/report.json");
  EXPECT_THAT((std::string(std::istreambuf_iterator<char>(report), {})), HasSubstr("faces-doubled"));
}

// A recipe from anywhere reads what it may: links count by where they lead.
TEST(Hostile, InputsCanBeKeptBelowAFolder) {
  const testing::TemporaryFolder folder;
  fs::create_directories(folder / "project/models");
  fs::copy_file(testing::repository_file("data/human.obj"), folder / "secret.obj");
  fs::create_symlink("../../secret.obj", folder / "project/models/link.obj");
  for (const char* input : {"../secret.obj", "models/link.obj"}) {
    std::ofstream(folder / "project/r.json") << R"({ "recipe_version": 1, "name": "r",
  "inputs": { "a": ")" << input << R"(" }, "base": "a", "ops": [] })";
    const auto plan = [&](const std::string& root) {
      return Program(SKINFORGE_BINARY, {"plan", "project/r.json", "--inputs-under", root, "--cache", "cache"},
                     folder.path())
          .finish();
    };
    EXPECT_EQ(plan(".").status, 0) << plan(".").err;
    EXPECT_EQ(plan("project").status, 2);
    EXPECT_THAT(plan("project").err, HasSubstr("is not below a folder of --inputs-under"));
    EXPECT_EQ(plan("nowhere").status, 2);
  }
}

// So do the files that a recipe is made of: nothing outside is opened, whatever way leads there.
TEST(Hostile, PartsOfRecipesCanBeKeptBelowAFolder) {
  const testing::TemporaryFolder folder;
  fs::create_directories(folder / "project");
  fs::copy_file(testing::repository_file("data/human.obj"), folder / "project/human.obj");
  const std::string whole =
      R"({ "recipe_version": 1, "name": "r", "inputs": { "a": "project/human.obj" }, "base": "a" })";
  std::ofstream(folder / "outside.json") << whole;
  fs::create_symlink("../outside.json", folder / "project/link.json");
  const std::string head = R"({ "recipe_version": 1, "name": "r", "base": "a", "inputs": { "a": )";
  const std::vector<std::string> recipes = {
      R"({ "extends": "../outside.json" })", R"({ "extends": "link.json" })",
      head + R"({ "file": "human.obj" } }, "ops": [ { "include": "../outside.json#/ops" } ] })",
      head + R"({ "recipe": "../outside.json" } } })",
      head + R"("human.obj" }, "expect": { "golden": "../golden.glb" } })"};
  for (const std::string& recipe : recipes) {
    std::ofstream(folder / "project/r.json") << recipe;
    const auto plan =
        Program(SKINFORGE_BINARY, {"plan", "project/r.json", "--inputs-under", "project", "--cache", "cache"},
                folder.path())
            .finish();
    EXPECT_EQ(plan.status, 2) << recipe;
    EXPECT_THAT(plan.err, HasSubstr("is not below a folder of --inputs-under")) << recipe;
    EXPECT_THAT(plan.err, ::testing::ContainsRegex("r\\.json:[0-9]+:[0-9]+: ")) << recipe;
  }
}

TEST(Hostile, LimitsAreToldAndRaisedOnTheCommandLine) {
  const testing::TemporaryFolder folder;
  const auto inspect = [&](const std::string& limit) {
    return Program(SKINFORGE_BINARY,
                   {"inspect", testing::repository_file("data/human.fbx"), "--limit", limit}, folder.path())
        .finish();
  };
  EXPECT_EQ(inspect("nodes=5").status, kBadInput);
  EXPECT_THAT(inspect("nodes=5").err, HasSubstr("the limit is 5; --limit nodes=N raises it"));
  EXPECT_EQ(inspect("nodes=5K").status, 0);
  EXPECT_EQ(inspect("nods=5").status, 2);
  const auto help = Program(SKINFORGE_BINARY, {"help", "limits"}, folder.path()).finish();
  EXPECT_THAT(help.out, HasSubstr("import-seconds"));
}

}  // namespace
}  // namespace skinforge
