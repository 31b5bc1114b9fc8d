#include <fmt/format.h>

#include <map>

#include "results/goal_test.h"

// Same input, same bytes: pictures, meshes and fields too.
namespace skinforge {
namespace {
using namespace testing;

// Relative name -> content of every file but the timings and the page, which tell of this run.
std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& item : fs::recursive_directory_iterator(folder)) {
    const fs::path name = item.path().filename();
    if (!item.is_regular_file() || name == "timings.json" || name == "report.html") continue;
    files[fs::relative(item.path(), folder)] = read_text(item.path());
  }
  return files;
}

class Determinism : public TailTest {
 protected:
  // With every kind of output.
  void SetUp() override {
    TailTest::SetUp();
    recipe["output"] = {{"glb", "tail.glb"}, {"obj", "tail.obj"}, {"vdb", "tail.vdb"}};
    write();
  }

  void build(const fs::path& from, const std::string& file, const std::string& out,
             const std::string& jobs) const {
    const auto run = Program(SKINFORGE_BINARY,
                             {"build", file, "--quiet", "--out", folder / out, "--cache",
                              folder / (out + "-cache"), "-j", jobs},
                             from)
                         .finish();
    ASSERT_EQ(run.status, 0) << run.err;
  }
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

// Three runs, by one, two and eight threads, from two folders, in two languages: one result.
TEST_F(Determinism, Goal05ManyRunsAreOne) {
  fs::create_directories(folder / "elsewhere");
  std::map<std::string, std::string> first;
  for (const char* run : {"1", "2", "3"})
    for (const char* jobs : {"1", "2", "8"})
      for (const std::string up : {"", "../"})
        for (const char* language : {"C", "de_DE.UTF-8"}) {
          SCOPED_TRACE(fmt::format("run {}, -j{}, {}tail.json, {}", run, jobs, up, language));
          const ProgramResult result =
              Program(SKINFORGE_BINARY,
                      {"build", up + "tail.json", "--quiet", "--report", "json", "--out", up + "out",
                       "--cache", up + "cache", "-j", jobs},
                      up.empty() ? folder.path() : folder / "elsewhere", {{"LC_ALL", language}})
                  .finish();
          ASSERT_EQ(result.status, 0) << result.err;
          const auto made = contents(folder / "out");
          if (first.empty()) first = made;
          ASSERT_TRUE(made == first);
          fs::remove_all(folder / "out");
          fs::remove_all(folder / "cache");
        }
  EXPECT_TRUE(first.contains("tail.glb"));
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
