#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "testing/assets.h"
#include "testing/program.h"
#include "testing/temporary_folder.h"

// Same input, same bytes: pictures, meshes and fields too.
namespace skinforge {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using testing::Program;

// Relative name -> content of every file but the timings and the page, which tell of this run.
std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& item : fs::recursive_directory_iterator(folder)) {
    const fs::path name = item.path().filename();
    if (!item.is_regular_file() || name == "timings.json" || name == "report.html") continue;
    std::ifstream file(item.path(), std::ios::binary);
    files[fs::relative(item.path(), folder)] = {std::istreambuf_iterator<char>(file), {}};
  }
  return files;
}

class Determinism : public ::testing::Test {
 protected:
  // The tail of this repository with every kind of output.
  void SetUp() override {
    json recipe = json::parse(std::ifstream(testing::repository_file("recipes/tail.json")));
    for (auto& [name, file] : recipe.at("inputs").items()) {
      const fs::path from = fs::path(testing::repository_file("recipes")) / file.get<std::string>();
      fs::copy_file(from, folder / (name + ".glb"));
      file = name + ".glb";
    }
    recipe["output"] = {{"glb", "tail.glb"}, {"obj", "tail.obj"}, {"vdb", "tail.vdb"}};
    std::ofstream(folder / "tail.json") << recipe;
  }

  void build(const fs::path& from, const std::string& recipe, const std::string& out,
             const std::string& jobs) const {
    const auto run = Program(SKINFORGE_BINARY,
                             {"build", recipe, "--quiet", "--out", folder / out, "--cache",
                              folder / (out + "-cache"), "-j", jobs},
                             from)
                         .finish();
    ASSERT_EQ(run.status, 0) << run.err;
  }

  testing::TemporaryFolder folder;
};

TEST_F(Determinism, Goal05EveryFileHasTheSameBytes) {
  fs::create_directories(folder / "elsewhere");
  build(folder.path(), "tail.json", "one", "1");
  build(folder / "elsewhere", "../tail.json", "two", "2");
  const auto one = contents(folder / "one"), two = contents(folder / "two");
  for (const char* name : {"tail.glb", "tail.obj", "report.json", "pictures/rest.png"})
    EXPECT_TRUE(one.contains(name)) << name;
  ASSERT_EQ(one.size(), two.size());
  for (const auto& [name, bytes] : one) {
    ASSERT_TRUE(two.contains(name)) << name;
    EXPECT_TRUE(bytes == two.at(name)) << name;
  }
}

// Rule 18: number of threads, folder of the call, language, time zone, home, umask, layout of memory.
TEST_F(Determinism, NothingOfTheMachineIsInTheBytes) {
  struct Surroundings {
    const char* name;
    const char* jobs;
    const char* before;  // shell words that lead the command
    std::map<std::string, std::string> variables;
  };
  const std::vector<Surroundings> all = {
      {"plain", "1", "exec", {}},
      {"two", "2", "exec", {{"LC_ALL", "de_DE.UTF-8"}, {"TZ", "Asia/Kolkata"}}},
      {"eight", "8", "umask 077; exec", {{"LC_ALL", "tr_TR.UTF-8"}, {"HOME", "/nowhere"}, {"TZ", "UTC+12"}}},
      {"fixed", "2", "exec setarch -R", {{"LC_ALL", "C"}, {"USER", "x"}}},
      {"tight",
       "8",
       "umask 000; exec setarch -R nice",
       {{"MALLOC_PERTURB_", "165"}, {"MALLOC_ARENA_MAX", "1"}}}};
  std::map<std::string, std::string> first;
  for (const Surroundings& around : all) {
    SCOPED_TRACE(around.name);
    const fs::path from = folder / around.name;
    fs::create_directories(from / "deeper");
    fs::copy(folder / "tail.json", from);
    for (const char* input : {"human.glb", "griffin.glb"}) fs::copy(folder / input, from);
    const std::string command =
        std::string(around.before) + " \"" + SKINFORGE_BINARY +
        "\" build ../tail.json --quiet --report json --out ../out --cache ../cache -j " + around.jobs;
    const auto run = Program("/bin/sh", {"-c", command}, from / "deeper", around.variables).finish();
    ASSERT_EQ(run.status, 0) << run.err;
    const auto made = contents(from / "out");
    if (first.empty()) first = made;
    EXPECT_GE(made.size(), 4u);
    EXPECT_TRUE(made == first);
  }
}

}  // namespace
}  // namespace skinforge
