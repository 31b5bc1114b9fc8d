#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "testing/assets.h"
#include "testing/program.h"
#include "testing/temporary_folder.h"

// The tool as people call it: status, stdout, stderr.
namespace skinforge {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::AnyOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::Program;
using testing::ProgramResult;
using ::testing::StartsWith;

std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class Cli : public ::testing::Test {
 protected:
  ProgramResult call(const std::vector<std::string>& arguments,
                     const std::map<std::string, std::string>& variables = {}) const {
    return Program(SKINFORGE_BINARY, arguments, folder.path(), variables).finish();
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }

  testing::TemporaryFolder folder;
};

constexpr const char* kNoSuchInput =
    R"({"recipe_version": 1, "name": "x", "inputs": {"a": "not_there.glb"}, "base": "a"})";

TEST_F(Cli, Version) {
  const ProgramResult plain = call({"version"});
  EXPECT_EQ(plain.status, 0);
  EXPECT_THAT(plain.out, ContainsRegex("^skinforge [0-9]+\\.[0-9]+\\.[0-9]+\n$"));
  EXPECT_THAT(plain.err, IsEmpty());
  const json document = json::parse(call({"version", "--json"}).out);
  EXPECT_THAT(document.at("build").get<std::string>(), StartsWith(document.at("version").get<std::string>()));
  EXPECT_EQ(call({"--version"}).out, plain.out);
}

// OpenVDB's library binds 70,000 symbols when it is loaded: 46 ms that a build without work must not pay.
TEST_F(Cli, LoadsOpenVdbOnlyWhenNeeded) {
  const ProgramResult loaded = call({"version"}, {{"LD_TRACE_LOADED_OBJECTS", "1"}});
  EXPECT_THAT(loaded.out, HasSubstr("libc.so"));
  EXPECT_THAT(loaded.out, Not(HasSubstr("openvdb")));
}

TEST_F(Cli, SchemaIsTheFileOfTheRepository) {
  const ProgramResult result = call({"schema"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out, read_text(testing::repository_file("schemas/recipe.schema.json")));
}

TEST_F(Cli, SchemaOfReports) {
  EXPECT_EQ(json::parse(call({"schema", "report"}).out).at("$schema"),
            "http://json-schema.org/draft-07/schema#");
  EXPECT_EQ(call({"schema", "nothing"}).status, 2);
}

TEST_F(Cli, HelpNamesEveryVerb) {
  const ProgramResult result = call({"help"});
  EXPECT_EQ(result.status, 0);
  for (const char* verb :
       {"build", "check", "plan", "explain", "expand", "diff", "stage", "cache", "inspect", "validate",
        "repair", "graph", "doctor", "completion", "schema", "version", "help"}) {
    EXPECT_THAT(result.out, HasSubstr(std::string("\n  ") + verb + " "));
    const ProgramResult about = call({"help", verb});
    EXPECT_EQ(about.status, 0);
    EXPECT_THAT(about.out, HasSubstr(std::string("skinforge ") + verb));
    EXPECT_EQ(call({verb, "--help"}).status, 0);
  }
  EXPECT_EQ(call({"--help"}).out, result.out);
}

TEST_F(Cli, UsageErrorsOfferTheNearestName) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"buidl", "x.json"}, "error: unknown command \"buidl\" (nearest: \"build\""},
      {{"cache", "stat"}, "error: unknown command \"stat\" (nearest: \"stats\""},
      {{"help", "plna"}, "error: unknown command \"plna\" (nearest: \"plan\""},
      {{"build", "--jbos=3", "x.json"}, "error: unknown option --jbos (nearest: \"--j"},
      {{"build", "x.json", "--reprot", "none"}, "error: unknown option --reprot (nearest: \"--report\""},
      {{}, "error: a command is missing"},
      {{"cache"}, "error: \"cache\" needs one of: stats, gc, pin, unpin, verify, clear, path"},
      {{"build"}, "error: RECIPE is required"},
      {{"build", "-j", "0", "x.json"}, "error: --jobs: Value 0 not in range 1 to 1024"},
      {{"build", "-j", "many", "x.json"}, "error: --jobs: Value many not in range 1 to 1024"},
      {{"build", "--report", "some", "x.json"}, "error: --report: some not in {none,json,full}"},
      {{"version", "extra"}, "error: unexpected argument \"extra\""}};
  for (const auto& [arguments, message] : cases) {
    const ProgramResult result = call(arguments);
    EXPECT_EQ(result.status, 2) << message;
    EXPECT_THAT(result.err, StartsWith(message));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_THAT(result.out, IsEmpty());
  }
}

// Every verb takes --json, -q and -v, before its name or behind it.
TEST_F(Cli, TalkFlagsGoWithEveryVerb) {
  for (const std::vector<std::string>& verb : std::vector<std::vector<std::string>>{{"version"},
                                                                                    {"schema"},
                                                                                    {"schema", "report"},
                                                                                    {"help"},
                                                                                    {"cache", "stats"},
                                                                                    {"cache", "verify"},
                                                                                    {"cache", "clear"},
                                                                                    {"cache", "path"}}) {
    for (const char* flag : {"-q", "-v", "--quiet", "--verbose"}) {
      std::vector<std::string> before = {flag, "--json"}, behind = verb;
      before.insert(before.end(), verb.begin(), verb.end());
      behind.insert(behind.end(), {flag, "--json"});
      for (const auto& arguments : {before, behind}) {
        const ProgramResult result = call(arguments);
        EXPECT_EQ(result.status, 0) << result.err;
        EXPECT_FALSE(json::parse(result.out, nullptr, false).is_discarded()) << verb[0] << result.out;
      }
    }
  }
  EXPECT_THAT(call({"-q", "cache", "verify"}).err, IsEmpty());
}

TEST_F(Cli, RecipeErrorsSayWhereAndAreStatus2) {
  write("x.json", "{\"recipe_version\": 1,\n  \"name\": \"x\", \"inptus\": {}}");
  for (const char* verb : {"build", "check", "plan"}) {
    const ProgramResult result = call({verb, "x.json"});
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, StartsWith("error: x.json:2:16: unknown key \"inptus\" (nearest: \"inputs\""));
    EXPECT_THAT(result.out, IsEmpty());
  }
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST_F(Cli, MissingFilesAreStatus3) {
  const ProgramResult recipe = call({"build", "none.json"});
  EXPECT_EQ(recipe.status, 3);
  EXPECT_EQ(recipe.err, "error: none.json: no such file\n");
  write("x.json", kNoSuchInput);
  for (const char* verb : {"build", "check", "plan"}) {
    const ProgramResult input = call({verb, "x.json"});
    EXPECT_EQ(input.status, 3);
    EXPECT_THAT(input.err, StartsWith("error: x.json:1:"));
    EXPECT_THAT(input.err, HasSubstr("/inputs/a: not_there.glb: "));
  }
  EXPECT_EQ(call({"inspect", "none.glb"}).status, 3);
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST_F(Cli, WithJsonStdoutIsOneDocument) {
  write("x.json", kNoSuchInput);
  const std::vector<std::pair<std::vector<std::string>, int>> cases = {
      {{"build", "x.json", "--json"}, 3},
      {{"check", "x.json", "--json"}, 3},
      {{"plan", "x.json", "--json"}, 3},
      {{"explain", "x.json", "--json"}, 3},
      {{"expand", "none.json", "--json"}, 3},
      {{"diff", "none.glb", "none.glb", "--json"}, 3},
      {{"cache", "gc", "--json"}, 2},
      {{"inspect", "none.glb", "--json"}, 3},
      {{"stage", "run", "x.json", "import a", "--json"}, 3},
      {{"build", "--json", "--oops"}, 2}};
  for (const auto& [arguments, status] : cases) {
    const ProgramResult result = call(arguments);
    EXPECT_EQ(result.status, status);
    const json document = json::parse(result.out, nullptr, false);
    ASSERT_FALSE(document.is_discarded()) << arguments[0] << ": " << result.out;
    EXPECT_EQ(document.at("exit_code"), status);
    EXPECT_THAT(result.err, StartsWith("error: "));
  }
}

TEST_F(Cli, KeepGoingIsStatus6) {
  write("x.json", kNoSuchInput);
  write("y.json", "{");
  EXPECT_EQ(call({"build", "x.json", "y.json"}).status, 3);
  const ProgramResult result = call({"build", "--keep-going", "x.json", "y.json", "--json"});
  EXPECT_EQ(result.status, 6);
  const json recipes = json::parse(result.out).at("recipes");
  ASSERT_EQ(recipes.size(), 2U);
  EXPECT_EQ(recipes[0].at("exit_code"), 3);
  EXPECT_EQ(recipes[1].at("exit_code"), 2);
}

TEST_F(Cli, NoEscapesOutsideATerminal) {
  for (const std::map<std::string, std::string>& variables : {std::map<std::string, std::string>{},
                                                              {{"TERM", "xterm"}},
                                                              {{"CLICOLOR_FORCE", "1"}, {"NO_COLOR", "1"}}}) {
    const ProgramResult result = call({"build", "none.json"}, variables);
    EXPECT_THAT(result.out + result.err, Not(HasSubstr("\x1b")));
  }
  EXPECT_THAT(call({"build", "none.json"}, {{"CLICOLOR_FORCE", "1"}}).err, HasSubstr("\x1b"));
}

TEST_F(Cli, MessagesStayOneLine) {
  const ProgramResult result = call({"build", "a\nb\x1b[31m.json"});
  EXPECT_EQ(result.status, 3);
  EXPECT_EQ(result.err, "error: a\\x0ab\\x1b[31m.json: no such file\n");
}

TEST_F(Cli, CacheFolder) {
  const std::string here = fs::canonical(folder.path());
  EXPECT_EQ(call({"cache", "path"}).out, here + "/.skinforge/cache\n");
  EXPECT_EQ(call({"cache", "path"}, {{"SKINFORGE_CACHE", "/somewhere"}}).out, "/somewhere\n");
  EXPECT_EQ(call({"cache", "path", "--cache", "mine"}, {{"SKINFORGE_CACHE", "/somewhere"}}).out,
            here + "/mine\n");
  EXPECT_FALSE(fs::exists(folder / ".skinforge"));  // asking makes nothing
}

TEST_F(Cli, CacheUpkeep) {
  fs::create_directories(folder / "cache/cas");
  const std::string damaged = "cache/cas/" + std::string(64, 'a');
  write(damaged, "something else");
  write("cache/cas/README", "not ours");
  EXPECT_EQ(json::parse(call({"cache", "stats", "--cache", "cache", "--json"}).out).at("results"), 1);
  const ProgramResult bad = call({"cache", "verify", "--cache", "cache"});
  EXPECT_EQ(bad.status, 4);
  EXPECT_THAT(bad.err, HasSubstr("content does not match its name; removed"));
  EXPECT_FALSE(fs::exists(folder / damaged));
  EXPECT_EQ(call({"cache", "verify", "--cache", "cache"}).status, 0);
  write(damaged, "something else");
  EXPECT_EQ(json::parse(call({"cache", "clear", "--cache", "cache", "--json"}).out).at("removed"), 1);
  EXPECT_TRUE(fs::exists(folder / "cache/cas/README"));
}

TEST_F(Cli, FoldersAreTheRecipesInThem) {
  fs::create_directories(folder / "many/below");
  const std::string recipe =
      R"({"recipe_version": 1, "name": "NAME", "base": "a", "inputs": {"a": "a.glb"}})";
  const auto named = [&](std::string name) {
    return std::string(recipe).replace(recipe.find("NAME"), 4, std::move(name));
  };
  write("many/b.json", named("b"));
  write("many/a.yaml", "extends: b.json\nname: a\n");
  write("many/_part.json", named("part"));
  write("many/list.json", "[1, 2]");
  write("many/notes.txt", "none");
  write("many/below/c.json", named("c"));
  const auto names = [&](std::vector<std::string> arguments) {
    std::vector<std::string> found;
    arguments.insert(arguments.begin(), {"expand", "--json"});
    const ProgramResult result = call(arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    const json answer = json::parse(result.out);
    for (const json& one : answer.at("recipes")) found.push_back(one.at("name"));
    return found;
  };
  EXPECT_EQ(names({"many"}), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(names({"many", "--shard", "2/2"}), std::vector<std::string>{"b"});
  EXPECT_EQ(names({"many/below", "many/b.json", "--set", "/output/influences=8"}),
            (std::vector<std::string>{"c", "b"}));
  for (const char* shard : {"0/2", "3/2", "1", "1/2x"})
    EXPECT_EQ(call({"expand", "many", "--shard", shard}).status, 2);
  fs::create_directories(folder / "nothing");
  EXPECT_EQ(call({"expand", "nothing"}).status, 2);
  const json origins =
      json::parse(call({"expand", "--json", "many/a.yaml"}).out).at("recipes").at(0).at("origins");
  EXPECT_EQ(origins.at("/name"), "many/a.yaml:2:7");
  EXPECT_THAT(origins.at("/base").get<std::string>(), StartsWith("many/b.json:1:"));
}

// Recipes are built side by side; what they say comes in their order all the same.
TEST_F(Cli, SeveralRecipesSpeakInTheirOrder) {
  const std::string input = testing::repository_file("data/human.obj");
  fs::copy_file(input, folder / "human.obj");
  std::vector<std::string> arguments = {"build",    "--cache", "cache", "--out", "out",
                                        "--report", "none",    "-j",    "3"};
  for (const char* name : {"e", "b", "d", "a", "c"}) {
    write(name + std::string(".json"), R"({ "recipe_version": 1, "name": ")" + std::string(name) +
                                           R"(", "inputs": { "h": "human.obj" }, "base": "h", "ops": [] })");
    arguments.push_back(name + std::string(".json"));
  }
  const ProgramResult result = call(arguments);
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, ::testing::ContainsRegex("e: .*b: .*d: .*a: .*c: .* stages"));
}

TEST_F(Cli, TwoRecipesOfOneNameAreRefused) {
  for (const char* file : {"a.json", "b.json"})
    write(file,
          R"({ "recipe_version": 1, "name": "x", "inputs": { "h": "none.obj" }, "base": "h", "ops": [] })");
  const ProgramResult result = call({"build", "a.json", "b.json", "-k", "--cache", "cache"});
  EXPECT_EQ(result.status, 6);
  EXPECT_THAT(result.err, HasSubstr("b.json:1:"));
  EXPECT_THAT(result.err, HasSubstr("a.json is called \"x\", too"));
}

TEST_F(Cli, CacheGcAndPins) {
  EXPECT_EQ(call({"cache", "gc", "--cache", "cache"}).status, 2);
  fs::create_directories(folder / "cache/cas");
  write("cache/cas/.skinforge-1-2", "half");  // of a build that was killed
  const ProgramResult gc = call({"cache", "gc", "--cache", "cache", "--max-age", "7", "--json"});
  EXPECT_EQ(gc.status, 0);
  EXPECT_EQ(json::parse(gc.out).at("entries"), 0);
  EXPECT_FALSE(fs::exists(folder / "cache/cas/.skinforge-1-2"));
  write("x.json", kNoSuchInput);
  EXPECT_THAT(call({"cache", "pin", "x.json", "--cache", "cache"}).err, HasSubstr("no build of it"));
}

// The tool waits on a pipe that nobody reads, and that is smaller than the schema, and gets the signal there.
TEST_F(Cli, SignalsHaveTheirStatus) {
  for (const int signal : {SIGINT, SIGTERM}) {
    Program program(SKINFORGE_BINARY, {"schema"}, folder.path());
    std::array<pollfd, 1> pipe = {{{program.stdout_descriptor(), POLLIN, 0}}};
    ASSERT_EQ(::poll(pipe.data(), 1, 10000), 1);  // it has begun to write
    program.send(signal);
    const ProgramResult result = program.finish();
    EXPECT_EQ(result.status, 128 + signal);
    EXPECT_EQ(result.err, "\ninterrupted\n");
  }
}

TEST_F(Cli, AClosedStdoutIsAnError) {
  Program program(SKINFORGE_BINARY, {"schema"}, folder.path());
  ::close(program.stdout_descriptor());
  EXPECT_THAT(program.finish().status, AnyOf(1, 128 + SIGPIPE));
}

}  // namespace
}  // namespace skinforge
