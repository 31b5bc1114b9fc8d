#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <sstream>
#include <thread>

#include "base/hash.h"
#include "testing/assets.h"
#include "testing/glb_file.h"
#include "testing/program.h"
#include "testing/temporary_folder.h"

// Whole builds of real characters: the same bytes whatever happens, and nothing done twice.
namespace skinforge {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Program;
using testing::ProgramResult;

std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Relative name -> content of every file but the timings and the page, which tell of this run.
std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& item : fs::recursive_directory_iterator(folder))
    if (item.is_regular_file() && item.path().filename() != "timings.json" &&
        item.path().filename() != "report.html")
      files[fs::relative(item.path(), folder)] = read_text(item.path());
  return files;
}

Bytes bytes_of(const fs::path& path) {
  const std::string text = read_text(path);
  const auto view = std::as_bytes(std::span(text));
  return {view.begin(), view.end()};
}

// The JSON chunk of a GLB.
json glb_json(const fs::path& path) {
  const std::string file = read_text(path);
  std::uint32_t length = 0;
  std::memcpy(&length, file.data() + 12, sizeof length);
  return json::parse(file.substr(20, length));
}

// Lines of stderr that are errors; warnings about what was read before may stand beside them.
std::ptrdiff_t error_lines(const std::string& text) {
  std::istringstream lines(text);
  std::ptrdiff_t count = 0;
  for (std::string line; std::getline(lines, line);) count += line.starts_with("warning: ") ? 0 : 1;
  return count;
}

class Build : public ::testing::Test {
 protected:
  void SetUp() override { SKINFORGE_NEEDS_SHARED(); }

  ProgramResult call(std::vector<std::string> arguments) const {
    return Program(SKINFORGE_BINARY, std::move(arguments), folder.path()).finish();
  }
  std::vector<std::string> build(const std::string& recipe, const std::string& out,
                                 const std::string& cache = "cache") const {
    return {"build", recipe, "--out", out, "--cache", cache, "--report", "json", "--json"};
  }
  // Stage -> status of a --json answer.
  static std::map<std::string, std::string> statuses(const ProgramResult& result) {
    std::map<std::string, std::string> found;
    const json answer = json::parse(result.out);
    for (const json& stage : answer.at("recipes").at(0).at("stages"))
      found[stage.at("stage")] = stage.at("status");
    return found;
  }
  // A recipe of the shared folder under another roof, changed by `change`.
  std::string copied_recipe(const std::string& name, const std::function<void(json&)>& change) const {
    json recipe = json::parse(read_text(testing::shared_file("recipes/" + name)));
    const fs::path assets = fs::canonical(testing::shared_file("assets"));
    for (json& input : recipe.at("inputs")) {
      const fs::path file = assets / fs::path(input.get<std::string>()).lexically_relative("../assets");
      input = fs::relative(file, fs::canonical(folder.path())).string();
    }
    change(recipe);
    std::ofstream(folder / name) << recipe.dump(1);
    return name;
  }

  // A recipe that takes the horse without its tail and adds nothing.
  void write_nested() const {
    copied_recipe("d13_remove_horse_tail.json", [](json&) {});
    std::ofstream(folder / "outer.json") << R"({"recipe_version": 1, "name": "outer", "base": "tailless",
               "inputs": {"tailless": {"recipe": "d13_remove_horse_tail.json"}}})";
  }
  // cyclic.glb: a joint that is its own grandparent.
  void write_cyclic(const fs::path& good) const {
    json document = glb_json(good);
    for (json& node : document.at("nodes")) {
      if (!node.contains("children")) continue;
      document.at("nodes").at(node.at("children").at(0).get<std::size_t>())["children"] = {
          std::size_t(&node - &document.at("nodes").at(0))};
      break;
    }
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::string whole = read_text(good);
    std::uint32_t length = 0;
    std::memcpy(&length, whole.data() + 12, sizeof length);
    const std::string binary = whole.substr(20 + length);
    const std::array<std::uint32_t, 5> head = {0x46546C67, 2,
                                               static_cast<std::uint32_t>(20 + text.size() + binary.size()),
                                               static_cast<std::uint32_t>(text.size()), 0x4E4F534A};
    std::ofstream file(folder / "cyclic.glb", std::ios::binary);
    file.write(reinterpret_cast<const char*>(head.data()), sizeof head) << text << binary;
  }

  testing::TemporaryFolder folder;
  const std::string horse = fs::absolute(testing::shared_file("recipes/d13_remove_horse_tail.json"));
};

TEST_F(Build, Goal01ASecondOneDoesNothing) {
  const ProgramResult first = call(build(horse, "out"));
  ASSERT_EQ(first.status, 0) << first.err;
  const auto made = contents(folder / "out");
  EXPECT_TRUE(made.contains("d13_remove_horse_tail.glb"));
  EXPECT_TRUE(made.contains("report.json"));
  const ProgramResult second = call(build(horse, "out"));
  EXPECT_EQ(second.status, 0);
  for (const auto& [stage, status] : statuses(second)) EXPECT_EQ(status, "hit") << stage;
  const json answer = json::parse(second.out);
  for (const json& file : answer.at("recipes").at(0).at("files")) EXPECT_FALSE(file.at("written"));
  EXPECT_EQ(contents(folder / "out"), made);
}

TEST_F(Build, SameBytesForAnyJobsAndFolder) {
  fs::create_directories(folder / "elsewhere");
  auto one = build(horse, "one", "cache1"), many = build(horse, "../many", "../cache2");
  one.insert(one.end(), {"-j", "1"});
  many.insert(many.end(), {"-j", "4"});
  ASSERT_EQ(call(one).status, 0);
  ASSERT_EQ(
      Program(SKINFORGE_BINARY, many, folder / "elsewhere", {{"LC_ALL", "de_DE.UTF-8"}}).finish().status, 0);
  EXPECT_EQ(contents(folder / "one"), contents(folder / "many"));
}

// Comments, the order of keys and files touched without a change run nothing; a changed placement runs what
// depends on it, and no import.
TEST_F(Build, OnlyWhatChangedRunsAgain) {
  const std::string recipe = copied_recipe("d7_four_armed_man.json", [](json&) {});
  ASSERT_EQ(call(build(recipe, "out")).status, 0);
  const std::string text = read_text(folder / recipe);
  std::ofstream(folder / recipe) << "// a comment\n" << json::parse(text).dump(4);
  for (const auto& [stage, status] : statuses(call(build(recipe, "out")))) EXPECT_EQ(status, "hit") << stage;

  json changed = json::parse(text);
  changed.at("ops").at(0).at("place").at("offset").at(1) =
      changed.at("ops").at(0).at("place").at("offset").at(1).get<double>() + 0.01;
  std::ofstream(folder / recipe) << changed.dump();
  const ProgramResult third = call(build(recipe, "out"));
  ASSERT_EQ(third.status, 0) << third.err;
  const auto after = statuses(third);
  EXPECT_EQ(after.at("place"), "ran");
  EXPECT_EQ(after.at("export"), "ran");
  for (const auto& [stage, status] : after)
    EXPECT_TRUE(!stage.starts_with("import") || status == "hit") << stage;
}

// Settings of one clip run that clip and what is made of all clips; the others, the motion sets and the
// surface stay.
TEST_F(Build, SettingsOfOneClipRunThatClipAlone) {
  const std::string recipe = copied_recipe("d7_four_armed_man.json", [](json&) {});
  ASSERT_EQ(call(build(recipe, "out")).status, 0);
  json changed = json::parse(read_text(folder / recipe));
  const std::string clip = "man2_Run";
  changed["animation"]["per_clip"][clip]["with"] = "Walk";
  std::ofstream(folder / recipe) << changed.dump();
  const ProgramResult result = call(build(recipe, "out"));
  ASSERT_EQ(result.status, 0) << result.err;
  for (const auto& [stage, status] : statuses(result)) {
    const bool is_clip = stage == "complete_clip " + clip || stage == "quality " + clip;
    const bool is_made_of_all = stage == "export" || stage == "validate" || stage == "report";
    EXPECT_EQ(status, is_clip || is_made_of_all ? "ran" : "hit") << stage;
  }
  const json report = json::parse(read_text(folder / "out" / "report.json"));
  for (const json& each : report.at("clips"))
    if (each.at("name") == clip) {
      EXPECT_EQ(each.at("completed_from").at(0).at("clip"), "Walk");
    }
}

TEST_F(Build, Goal04GoesOnAfterBeingKilled) {
  ASSERT_EQ(call(build(horse, "whole", "whole-cache")).status, 0);
  for (int round = 0; round < 12; ++round) {
    Program program(SKINFORGE_BINARY, build(horse, "out"), folder.path());
    std::this_thread::sleep_for(std::chrono::milliseconds(7 + 23 * round));
    program.send(SIGKILL);
    program.finish();
    if (round % 4 == 3) fs::remove_all(folder / "cache");  // start from nothing now and then
  }
  const ProgramResult last = call(build(horse, "out"));
  ASSERT_EQ(last.status, 0) << last.err;
  EXPECT_EQ(contents(folder / "out"), contents(folder / "whole"));
  EXPECT_EQ(call({"cache", "verify", "--cache", "cache"}).status, 0);
}

// A stage that had too little room has more next time.
TEST_F(Build, WantOfMemoryIsNotRemembered) {
  const std::string limiter = "/usr/bin/prlimit";
  if (!fs::exists(limiter)) GTEST_SKIP() << "no " << limiter;
  const std::string recipe = fs::absolute(testing::repository_file("recipes/tail.json"));
  for (const int megabytes : {64, 128, 192}) {
    const std::string name = std::to_string(megabytes);
    const auto words = build(recipe, "out" + name, "cache" + name);
    auto limited = words;
    limited.insert(limited.begin(), {"--as=" + std::to_string(megabytes << 20), SKINFORGE_BINARY});
    Program(limiter, limited, folder.path()).finish();
    const ProgramResult next = call(words);
    EXPECT_EQ(next.status, 0) << megabytes << " MB: " << next.err;
  }
}

// Every stage gives the same bytes a second time.
TEST_F(Build, VerifyRunsWhatIsKnownAndComparesIt) {
  ASSERT_EQ(call(build(horse, "out")).status, 0);
  const auto made = contents(folder / "out");
  auto words = build(horse, "out");
  words.push_back("--verify");
  const ProgramResult result = call(words);
  ASSERT_EQ(result.status, 0) << result.err;
  for (const auto& [stage, status] : statuses(result)) EXPECT_EQ(status, "ran") << stage;
  EXPECT_EQ(contents(folder / "out"), made);
}

// Anybody can write what a file was made of.
TEST_F(Build, AModelWithOddProvenanceIsRefusedInOneLine) {
  for (const char* odd :
       {R"({"inputs": [1]})", R"({"inputs": {"a": 5}})", R"({"inputs": {"a": [{"file": 5, "sha256": []}]}})",
        R"({"recipe_sha256": 5, "inputs": "x"})", R"({"recipe_sha256": "\u001b[1m"})", "5"}) {
    const Bytes glb = testing::glb_bytes(
        fmt::format(R"({{"asset": {{"version": "2.0", "extras": {{"skinforge": {}}}}}}})", odd));
    std::ofstream(folder / "odd.glb", std::ios::binary)
        .write(reinterpret_cast<const char*>(glb.data()), static_cast<std::streamsize>(glb.size()));
    const ProgramResult result = call({"verify", "odd.glb", "--recipe", horse});
    EXPECT_EQ(result.status, 4) << odd << result.err;
    EXPECT_THAT(result.err, Not(HasSubstr("internal error")));
    EXPECT_THAT(result.err, Not(HasSubstr("\x1b[1m")));
  }
}

// One byte of every file of a warm cache is flipped: the build warns, repairs and gives the same bytes.
TEST_F(Build, Goal06MendsADamagedCache) {
  ASSERT_EQ(call(build(horse, "out")).status, 0);
  const auto made = contents(folder / "out");
  for (const auto& item : fs::recursive_directory_iterator(folder / "cache")) {
    if (!item.is_regular_file() || item.file_size() == 0) continue;
    std::fstream file(item.path(), std::ios::in | std::ios::out | std::ios::binary);
    const auto middle = static_cast<std::streamoff>(item.file_size() / 2);
    file.seekg(middle);
    const int byte = file.get();
    file.seekp(middle);
    file.put(static_cast<char>(byte ^ 1));
  }
  fs::remove_all(folder / "out");
  const ProgramResult result = call(build(horse, "out"));
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("[cache-entry-damaged]"));
  EXPECT_EQ(contents(folder / "out"), made);
}

TEST_F(Build, Goal06SeveralAtOnceShareACache) {
  std::vector<std::unique_ptr<Program>> programs;
  for (int i = 0; i < 3; ++i)
    programs.push_back(
        std::make_unique<Program>(SKINFORGE_BINARY, build(horse, "out" + std::to_string(i)), folder.path()));
  for (const auto& program : programs) {
    const ProgramResult result = program->finish();
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, Not(HasSubstr("warning: ac/")));
  }
  EXPECT_EQ(contents(folder / "out0"), contents(folder / "out1"));
  EXPECT_EQ(contents(folder / "out0"), contents(folder / "out2"));
  for (const auto& item : fs::recursive_directory_iterator(folder / "cache"))
    EXPECT_THAT(item.path().filename().string(), Not(HasSubstr(".skinforge-")));
}

TEST_F(Build, PlanSaysWhatWillRun) {
  const auto plan = [&] { return call({"plan", horse, "--cache", "cache", "--report", "json"}).out; };
  EXPECT_THAT(plan(), HasSubstr("run   import horse  (never run)"));
  EXPECT_THAT(plan(), HasSubstr("further stages follow"));
  EXPECT_FALSE(fs::exists(folder / "out"));
  ASSERT_EQ(call(build(horse, "out")).status, 0);
  EXPECT_THAT(plan(), HasSubstr("hit   import horse\n"));
  EXPECT_THAT(plan(), Not(HasSubstr("\nrun ")));
}

// A recipe as an input: its stages are planned like the others, and nothing is imported or built for it.
TEST_F(Build, PlanOfARecipeInARecipeRunsNothing) {
  write_nested();
  const auto plan = [&] { return call({"plan", "outer.json", "--cache", "cache", "--report", "json"}); };
  const ProgramResult cold = plan();
  EXPECT_EQ(cold.status, 0) << cold.err;
  EXPECT_THAT(cold.out, HasSubstr("run   tailless/import horse  (never run)"));
  EXPECT_THAT(cold.out, HasSubstr("further stages follow"));
  EXPECT_FALSE(fs::exists(folder / "cache"));
  ASSERT_EQ(call(build("outer.json", "out")).status, 0);
  EXPECT_THAT(plan().out, HasSubstr("hit   adopt tailless\n"));
  EXPECT_THAT(plan().out, Not(HasSubstr("\nrun ")));
}

// The files behind an input, with their digests, stand in the report and in the GLB; those of a recipe's
// inputs count as its own.
TEST_F(Build, SaysWhichFilesItWasMadeOf) {
  write_nested();
  ASSERT_EQ(call(build("outer.json", "out")).status, 0);
  const Bytes bytes = bytes_of(testing::shared_file("assets/quaternius_horse/horse.glb"));
  const std::string digest = sha256(bytes).hex();
  const json report = json::parse(read_text(folder / "out/report.json"));
  const json& input = report.at("inputs").at(0);
  EXPECT_EQ(input.at("file"), "d13_remove_horse_tail.json");
  EXPECT_EQ(input.at("files"), json({{{"name", "horse.glb"}, {"bytes", bytes.size()}, {"sha256", digest}}}));
  EXPECT_THAT(input.at("repairs").dump(), HasSubstr("skin-skeleton-ignored"));
  const json extras = glb_json(folder / "out/outer.glb").at("asset").at("extras").at("skinforge");
  EXPECT_EQ(extras.at("version"), report.at("tool").at("version"));
  EXPECT_EQ(extras.at("recipe_sha256"), report.at("recipe").at("sha256"));
  EXPECT_EQ(extras.at("inputs"), json({{"tailless", {{{"file", "horse.glb"}, {"sha256", digest}}}}}));
}

// What a stage finds odd reaches the report, under the operation or input it belongs to.
TEST_F(Build, ReportCarriesIssuesAndMeasures) {
  ASSERT_EQ(call(build(horse, "out")).status, 0);
  const json report = json::parse(read_text(folder / "out/report.json"));
  EXPECT_THAT(report.at("inputs").at(0).at("repairs").dump(), HasSubstr("skin-skeleton-ignored"));
  for (const json& issue : report.at("issues")) EXPECT_FALSE(issue.at("code").get<std::string>().empty());
  const json& weights = report.at("weights");
  EXPECT_GT(weights.at("junction_step"), 0);
  EXPECT_LE(weights.at("junction_step"), 2);
  EXPECT_GT(weights.at("neighbour_step"), 0);
  const json& step = report.at("junctions").at(0).at("border_color_step");
  EXPECT_GT(step.at("edges"), 0);
  EXPECT_LE(step.at("mean"), step.at("max"));
  for (const json& clip : report.at("clips")) EXPECT_GT(clip.at("driven_joints"), 0) << clip.at("name");
}

// The bad input of the issue: one line, the right status, nothing written.
TEST_F(Build, BadInputIsOneLineAndLeavesNothing) {
  const fs::path good = testing::shared_file("assets/quaternius_horse/horse.glb");
  fs::copy_file(good, folder / "horse.glb");
  std::ofstream(folder / "cut.glb") << read_text(good).substr(0, 20000);
  write_cyclic(good);
  struct Case {
    const char* what;
    const char* recipe;  // behind the version and the name
    int status;
    std::vector<const char*> words;
  };
  const std::vector<Case> cases = {
      {"unknown joint",
       R"("inputs": {"a": "horse.glb"}, "base": "a", "ops": [{"op": "remove", "at": "Nekc1"}])",
       2,
       {"x.json:2:", "no joint \"Nekc1\"", "nearest: \"Neck1\""}},
      {"missing file",
       R"("inputs": {"a": "none.glb"}, "base": "a")",
       3,
       {"x.json:2:", "none.glb: no such file"}},
      {"truncated GLB",
       R"("inputs": {"a": "cut.glb"}, "base": "a")",
       3,
       {"header says 682356 bytes, file has 20000"}},
      {"cyclic joints", R"("inputs": {"a": "cyclic.glb"}, "base": "a")", 3, {"cyclic.glb", "cycle"}},
      {"unknown key",
       R"("inputs": {"a": "horse.glb"}, "bsae": "a")",
       2,
       {"x.json:2:31: unknown key \"bsae\""}},
      {"wrong type",
       R"("inputs": {"a": "horse.glb"}, "base": "a", "output": {"influences": "four"})",
       2,
       {"x.json:2:69: /output/influences: expected a number"}},
      {"output leaves the folder",
       R"("inputs": {"a": "horse.glb"}, "base": "a", "output": {"glb": "../x.glb"})",
       2,
       {"/output/glb", "inside the output folder"}}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    std::ofstream(folder / "x.json") << "{\"recipe_version\": 1, \"name\": \"x\",\n" << c.recipe << "}";
    for (const char* verb : {"build", "check"}) {
      const ProgramResult result = call({verb, "-q", "x.json", "--cache", "cache"});
      EXPECT_EQ(result.status, c.status);
      EXPECT_EQ(result.out, "");
      EXPECT_EQ(error_lines(result.err), 1) << result.err;
      for (const char* word : c.words) EXPECT_THAT(result.err, HasSubstr(word));
      EXPECT_FALSE(fs::exists(folder / "out"));
      EXPECT_FALSE(fs::exists(folder / "x.glb"));
    }
  }
}

TEST_F(Build, OneStageAtATimeGivesTheSameBytes) {
  ASSERT_EQ(call(build(horse, "whole", "whole-cache")).status, 0);
  const ProgramResult list = call({"stage", "list", horse, "--cache", "cache", "--report", "json", "--json"});
  ASSERT_EQ(list.status, 0) << list.err;
  const json stages = json::parse(list.out).at("stages");
  for (const json& stage : stages)
    ASSERT_EQ(call({"stage", "run", horse, stage.at("stage"), "--cache", "cache", "--report", "json"}).status,
              0);
  const ProgramResult result = call(build(horse, "out"));
  for (const auto& [stage, status] : statuses(result)) EXPECT_EQ(status, "hit") << stage;
  EXPECT_EQ(contents(folder / "out"), contents(folder / "whole"));
}

TEST_F(Build, UnknownJointsAndClipsAreNamed) {
  const std::string joint =
      copied_recipe("d13_remove_horse_tail.json", [](json& r) { r.at("ops").at(0).at("at") = "Tial1"; });
  for (const char* verb : {"check", "build"}) {
    const ProgramResult result = call({verb, joint, "--cache", "cache"});
    EXPECT_EQ(result.status, 2) << result.err;
    EXPECT_THAT(result.err, HasSubstr("Tial1"));
    EXPECT_THAT(result.err, HasSubstr("nearest: \"Tail1\""));
  }
  const std::string clip =
      copied_recipe("d13_remove_horse_tail.json", [](json& r) { r["animation"]["clips"] = {"Galop"}; });
  const ProgramResult result = call({"check", clip, "--cache", "cache"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("Galop"));
  EXPECT_FALSE(fs::exists(folder / "out"));
  const std::string use = copied_recipe(
      "d1_centaur.json", [](json& r) { r["animation"]["per_clip"]["Gallop"]["use"] = {"Rum"}; });
  const ProgramResult used = call({"check", use, "--cache", "cache"});
  EXPECT_EQ(used.status, 2);
  EXPECT_THAT(used.err, HasSubstr("/animation/per_clip/Gallop/use: no clip \"Rum\" in any other input"));
}

TEST_F(Build, CheckAcceptsTheSharedRecipes) {
  std::vector<std::string> arguments = {"check", "--cache", "cache", "-q"};
  for (const auto& item : fs::directory_iterator(testing::shared_file("recipes")))
    arguments.push_back(fs::absolute(item.path()));
  const ProgramResult result = call(arguments);
  EXPECT_EQ(result.status, 0) << result.err;
}

TEST_F(Build, HostileRecipesGetTheirVerdicts) {
  const fs::path hostile = testing::shared_file("hostile");
  int count = 0;
  for (const json& item : json::parse(read_text(hostile / "index.json"))) {
    const std::string file = item.at("file");
    if (!file.starts_with("gen/recipes/")) continue;
    ++count;
    SCOPED_TRACE(file);
    const ProgramResult result = call({"build", fs::absolute(hostile / file), "--cache", "cache", "--out",
                                       "out/" + std::to_string(count), "--report", "none"});
    if (item.at("expect") == "accept") {
      EXPECT_EQ(result.status, 0) << result.err;
      continue;
    }
    EXPECT_TRUE(result.status == 2 || result.status == 3) << result.status << " " << result.err;
    EXPECT_THAT(result.err, HasSubstr("error: "));
    for (const json& word : item.value("message_must_contain", json::array()))
      EXPECT_THAT(result.err, HasSubstr(word.get<std::string>()));
    EXPECT_FALSE(fs::exists(folder / ("out/" + std::to_string(count))));
  }
  EXPECT_EQ(count, 18);
}

TEST_F(Build, InspectCountsTheHorse) {
  const ProgramResult result =
      call({"inspect", fs::absolute(testing::shared_file("assets/quaternius_horse/horse.glb")), "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const json horse_facts = json::parse(result.out);
  EXPECT_EQ(horse_facts.at("clips").size(), 13U);
  EXPECT_EQ(horse_facts.at("materials").size(), 8U);
  EXPECT_GE(horse_facts.at("joints").size(), 50U);
  const ProgramResult text =
      call({"inspect", fs::absolute(testing::shared_file("assets/quaternius_horse/horse.glb"))});
  EXPECT_THAT(text.out, HasSubstr("clips      13\n"));
  EXPECT_THAT(text.out, HasSubstr("Gallop"));
}

// A key of "surface" moves the stages that it means and those behind them, no others.
TEST_F(Build, SurfaceKeysMoveTheirStages) {
  const std::string recipe = "d13_remove_horse_tail.json";
  const auto build_with = [&](const json& surface) {
    copied_recipe(recipe, [&](json& r) {
      r["animation"] = {{"clips", json::array()}};
      if (!surface.empty()) r["ops"][0]["surface"] = surface;
    });
    const ProgramResult result = call(build(recipe, "out"));
    EXPECT_EQ(result.status, 0) << result.err;
    return statuses(result);
  };
  build_with({});
  const auto ran = [](const std::map<std::string, std::string>& all) {
    std::set<std::string> names;
    for (const auto& [stage, status] : all)
      if (status == "ran") names.insert(stage);
    return names;
  };
  const auto elements = ran(build_with({{"elements", "triangles"}}));
  EXPECT_THAT(elements, ::testing::Contains("junction"));
  for (const char* other : {"import horse", "place", "graft_skeleton", "map_joints", "select", "field 1"})
    EXPECT_THAT(elements, Not(::testing::Contains(other)));
  const auto rule = ran(build_with({{"keep_or_drop", {{"mean", 0.6}}}}));
  EXPECT_THAT(rule, ::testing::Contains("select"));
  EXPECT_THAT(rule, Not(::testing::Contains("place")));
  EXPECT_THAT(rule, Not(::testing::Contains("graft_skeleton")));
  EXPECT_THAT(rule, Not(::testing::Contains("junction")));  // the tail has no such component: nothing changed
}

// The bytes that the refusal names are just enough.
TEST_F(Build, TheLatticeIsEstimatedBeforeItIsTaken) {
  const std::string recipe = copied_recipe("d1_centaur.json", [](json& r) {
    r["animation"] = {{"clips", json::array()}};
    r["ops"][0]["surface"] = {{"voxel", 0.0125}};
  });
  const auto build_with = [&](const std::string& limit) {
    return call({"build", recipe, "--report", "none", "--cache", "cache", "--out", "out", "--limit", limit});
  };
  const ProgramResult refused = build_with("memory=9M");
  EXPECT_EQ(refused.status, 1);
  const std::string before = "lattice points of ";
  EXPECT_THAT(refused.err, HasSubstr("--limit memory=N raises it"));
  ASSERT_THAT(refused.err, HasSubstr(before));
  const double bytes = std::stod(refused.err.substr(refused.err.find(before) + before.size()));  // 3 digits
  const auto memory = [&](double factor) { return "memory=" + std::to_string(std::llround(factor * bytes)); };
  EXPECT_EQ(build_with(memory(0.99)).status, 1);
  EXPECT_FALSE(fs::exists(folder / "out"));
  EXPECT_EQ(build_with(memory(1.01)).status, 0);
}

// A preview stands beside the build and says what it is.
TEST_F(Build, PreviewNeverReplacesTheBuild) {
  const std::string recipe = copied_recipe("d1_centaur.json", [](json& r) {
    r["animation"] = {{"clips", {"Walk"}}};
  });
  auto arguments = build(recipe, "out");
  ASSERT_EQ(call(arguments).status, 0);
  const auto before = contents(folder / "out");
  arguments.push_back("--preview");
  const ProgramResult result = call(arguments);
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(statuses(result), Not(::testing::Contains(::testing::Key("junction"))));
  auto after = contents(folder / "out");
  EXPECT_GT(after.erase("d1_centaur-preview.glb"), 0U);
  const json report = json::parse(after.at("report-preview.json"));
  EXPECT_GT(after.erase("report-preview.json"), 0U);
  EXPECT_EQ(after, before);
  EXPECT_EQ(report.at("preview"), true);
  EXPECT_EQ(report.at("clips").at(0).at("name"), "Walk");
  EXPECT_EQ(report.at("issues").back().at("code"), "preview-only");
  EXPECT_EQ(json::parse(before.at("report.json")).at("preview"), false);
  const json glb = glb_json(folder / "out/d1_centaur-preview.glb");
  EXPECT_EQ(glb.at("asset").at("extras").at("skinforge").at("preview"), true);
  EXPECT_FALSE(glb.at("animations").empty());
}

// A leg without its hoof, which hangs on an IK control beside the leg: `check` names the joint that is
// missing.
TEST_F(Build, CheckNamesJointsOfPartsLeftBehind) {
  const std::string recipe =
      copied_recipe("d13_remove_horse_leg.json", [](json& r) { r["ops"][0]["at"] = "FrontShoulder.L"; });
  const ProgramResult result = call({"check", recipe, "--cache", "cache"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("[part-left-behind]"));
  EXPECT_THAT(result.err, HasSubstr("they hang on \"IKFrontLeg.L\", outside of what goes; add it to \"at\""));
  copied_recipe("d13_remove_horse_leg.json", [](json&) {});
  EXPECT_THAT(call({"check", recipe, "--cache", "cache"}).err, Not(HasSubstr("part-left")));
}

// Eyes with an armature of their own do not come with the head.
TEST_F(Build, CheckNamesPartsLeftOut) {
  const std::string recipe = copied_recipe("d9_three_model_composite.json", [](json&) {});
  const ProgramResult result = call({"check", recipe, "--cache", "cache"});
  EXPECT_THAT(result.err, HasSubstr("op 1: 133 faces of dragon do not come along: they hang on \"Bone\""));
}

}  // namespace
}  // namespace skinforge
