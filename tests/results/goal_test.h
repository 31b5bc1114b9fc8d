#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "testing/assets.h"
#include "testing/program.h"
#include "testing/temporary_folder.h"

/// What the tests of the build tool's goals share.
namespace skinforge::testing {
namespace fs = std::filesystem;
using nlohmann::json;

inline std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Calls the program in a folder of its own.
class GoalTest : public ::testing::Test {
 protected:
  ProgramResult call(const std::vector<std::string>& arguments) const {
    return Program(SKINFORGE_BINARY, arguments, folder.path()).finish();
  }
  /// What it says with --json.
  json answer(std::vector<std::string> arguments, int status = 0) const {
    arguments.emplace_back("--json");
    const ProgramResult result = call(arguments);
    EXPECT_EQ(result.status, status) << result.err;
    return json::parse(result.out, nullptr, false);
  }

  TemporaryFolder folder;
};

/// The tail of this repository as tail.json in that folder, its inputs beside it.
class TailTest : public GoalTest {
 protected:
  void SetUp() override {
    recipe = json::parse(read_text(repository_file("recipes/tail.json")));
    for (auto& [name, file] : recipe.at("inputs").items()) {
      fs::copy_file(fs::path(repository_file("recipes")) / file.get<std::string>(), folder / (name + ".glb"));
      file = name + ".glb";
    }
    write();
  }
  void write() const { std::ofstream(folder / "tail.json") << recipe.dump(1); }

  json recipe;
};

/// A program of an npm package; empty where it is not installed.
inline std::string npm_program(const std::string& name) {
  const char* path = std::getenv("NODE_PATH");
  for (const fs::path& folder :
       {fs::path(path ? path : ""), fs::path(SKINFORGE_SOURCE_DIR) / "build/node/node_modules"})
    if (fs::exists(folder / ".bin" / name)) return folder / ".bin" / name;
  return {};
}

/// Runs a script of tests/results in Blender, without its window. Status 127: it is not installed.
inline ProgramResult run_blender(const std::string& script, std::vector<std::string> arguments,
                                 const fs::path& folder) {
  arguments.insert(arguments.begin(), {"blender", "-b", "--factory-startup", "-P",
                                       repository_file("tests/results/" + script), "--"});
  return Program("/usr/bin/env", arguments, folder).finish();
}

}  // namespace skinforge::testing
