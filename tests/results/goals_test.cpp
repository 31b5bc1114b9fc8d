#include <functional>
#include <set>

#include "results/goal_test.h"

// The goals of the build tool, one test each, by number.
namespace skinforge {
namespace {
using namespace testing;
using ::testing::HasSubstr;

class Goals : public TailTest {
 protected:
  ProgramResult call(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--cache", "cache"});
    return TailTest::call(arguments);
  }
  ProgramResult build() const {
    return call({"build", "tail.json", "--out", "out", "--report", "json", "--json"});
  }
  json explain(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"explain", "tail.json", "--report", "json", "--json"});
    const ProgramResult result = call(more);
    EXPECT_EQ(result.status, 0) << result.err;
    return json::parse(result.out);
  }
  static const json* change_of(const json& stages, const std::string& name) {
    for (const json& stage : stages)
      for (const json& change : stage.at("changes"))
        if (change.value("name", "") == name) return &change;
    return nullptr;
  }
  static std::set<std::string> stages_that_ran(const ProgramResult& result) {
    std::set<std::string> ran;
    const json answer = json::parse(result.out);
    for (const json& stage : answer.at("recipes").at(0).at("stages"))
      if (stage.at("status") == "ran") ran.insert(stage.at("stage"));
    return ran;
  }
  // Every stage that ran has its changes, each one with both values in words or with the stage that made it.
  static void expect_explained(const std::set<std::string>& ran, const json& explained) {
    std::set<std::string> named;
    for (const json& stage : explained.at("stages")) {
      named.insert(stage.at("stage"));
      for (const json& change : stage.at("changes")) {
        if (change.at("kind") == "never-run") continue;  // of a clip that is new
        const std::string before = change.value("before", ""), after = change.value("after", "");
        const bool is_in_words = !before.starts_with("sha256:") && !after.starts_with("sha256:");
        const bool has_values = !before.empty() && !after.empty() && is_in_words;
        const bool came_or_went =
            change.at("kind") == "input" && (before.empty() || after.empty());  // a clip
        EXPECT_TRUE(has_values || came_or_went || change.contains("made_by")) << change;
        EXPECT_TRUE(change.contains("place") || came_or_went || change.contains("made_by") ||
                    change.at("kind") == "parameter")
            << change;
      }
    }
    for (const std::string& label : ran) EXPECT_TRUE(named.contains(label)) << label;
  }
};

TEST_F(Goals, Goal07CommentsKeyOrderAndTimesMoveNothing) {
  ASSERT_EQ(build().status, 0);
  std::string text = "// a comment\n{";
  for (const char* key : {"ops", "base", "inputs", "name", "recipe_version"})  // another order, other spaces
    text += "  \"" + std::string(key) + "\" :" + recipe.at(key).dump(3) + (key[0] == 'r' ? "}" : ",\n");
  std::ofstream(folder / "tail.json") << text;
  for (const char* file : {"human.glb", "griffin.glb"})
    fs::last_write_time(folder / file, fs::file_time_type::clock::now());
  const json plan = json::parse(call({"plan", "tail.json", "--report", "json", "--json"}).out);
  for (const json& stage : plan.at("recipes").at(0).at("stages"))
    EXPECT_EQ(stage.at("state"), "hit") << stage;
  EXPECT_THAT(explain().at("stages"), ::testing::IsEmpty());
}

TEST_F(Goals, Goal08ExplainNamesWhatChanged) {
  ASSERT_EQ(build().status, 0);
  recipe.at("ops").at(0).at("place")["offset"] = {0, 0.2, 0.379};
  recipe["animation"] = {{"rate_hz", 24}};
  write();
  const json before = explain({"place"});
  const json* offset = change_of(before.at("stages"), "/ops/0/place/offset");
  ASSERT_NE(offset, nullptr) << before;
  EXPECT_EQ(offset->at("before"), "[0, 0.194, 0.379]");
  EXPECT_EQ(offset->at("after"), "[0, 0.2, 0.379]");
  EXPECT_THAT(offset->at("place"), HasSubstr("tail.json:"));
  EXPECT_EQ(change_of(before.at("stages"), "/animation/rate_hz"), nullptr);  // not read by this stage

  const ProgramResult second = build();
  ASSERT_EQ(second.status, 0) << second.err;
  const json after = explain();  // up to date now: against the run before
  expect_explained(stages_that_ran(second), after);
  const json* rate = change_of(after.at("stages"), "/animation/rate_hz");
  ASSERT_NE(rate, nullptr);
  EXPECT_EQ(rate->at("before"), "not set (default)");
  EXPECT_EQ(rate->at("after"), "24");
}

TEST_F(Goals, Goal08ExplainNamesFilesAndRuns) {
  ASSERT_EQ(build().status, 0);
  fs::copy_file(testing::repository_file("data/horse.glb"), folder / "griffin.glb",
                fs::copy_options::overwrite_existing);
  const json file = explain({"import griffin"});
  const json* change = change_of(file.at("stages"), "file:griffin:0");
  ASSERT_NE(change, nullptr) << file;
  EXPECT_THAT(change->at("place"), HasSubstr("tail.json:"));
  EXPECT_NE(change->at("before"), change->at("after"));
  const ProgramResult second = build();
  ASSERT_EQ(second.status, 0) << second.err;
  expect_explained(stages_that_ran(second), explain());

  const std::string first = file.at("against");
  fs::copy_file(testing::repository_file("data/griffin.glb"), folder / "griffin.glb",
                fs::copy_options::overwrite_existing);
  recipe.at("ops").at(0).at("place")["scale"] = 0.8;
  write();
  ASSERT_EQ(build().status, 0);
  recipe.at("ops").at(0).at("place")["scale"] = 0.85;
  write();
  const json now = explain({"place"});
  const json* last = change_of(now.at("stages"), "/ops/0/place/scale");
  ASSERT_NE(last, nullptr);
  EXPECT_EQ(last->at("before"), "0.8");
  const json old = explain({"place", "--against", first});
  ASSERT_NE(change_of(old.at("stages"), "/ops/0/place/scale"), nullptr) << old;
  EXPECT_EQ(change_of(old.at("stages"), "/ops/0/place/scale")->at("before"), "0.75");
  const ProgramResult unknown = call({"explain", "tail.json", "--against", "nothing"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.err, HasSubstr(first));
  EXPECT_EQ(call({"explain", "tail.json", "plaice"}).status, 2);
}

// 24 characters of one file; the misspelled joint breaks two of them.
TEST_F(Goals, Goal09AMatrixWithTwoBrokenCells) {
  std::ofstream(folder / "many.json") << R"({
  "recipe_version": 1, "name": "${matrix.without}_${matrix.rate}", "base": "human",
  "matrix": { "without": ["Head", "Hand.L", "Hand.R", "LowerArm.L", "LowerArm.R", "UpperArm.L", "UpperArm.R",
                          "Foot.L", "Foot.R", "Toes.L", "Toes.R", "Hed"],
              "rate": [24, 30] },
  "inputs": { "human": "human.glb" },
  "animation": { "rate_hz": "${matrix.rate}" },
  "ops": [
    { "op": "remove", "at": "${matrix.without}" } ] })";
  const auto night = [&](std::vector<std::string> more) {
    more.insert(more.begin(),
                {"build", "many.json", "--keep-going", "--out", "out", "--report", "none", "--json",
                 "--junit", "junit.xml", "--sarif", "all.sarif", "--summary", "summary.md"});
    more.insert(more.end(), {"--cache", "cache"});
    return Program(SKINFORGE_BINARY, more, folder.path(), {{"GITHUB_ACTIONS", "true"}}).finish();
  };
  const auto ran = [](const ProgramResult& result) {
    std::size_t count = 0;
    const json answer = json::parse(result.out);
    for (const json& one : answer.at("recipes"))
      for (const json& stage : one.at("stages"))
        count +=
            stage.at("status") == "ran" || (stage.at("status") == "failed" && !stage.contains("remembered"));
    return count;
  };
  const auto text = [&](const char* name) {
    std::ifstream file(folder / name);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };

  const ProgramResult first = night({});
  EXPECT_EQ(first.status, 6);
  std::size_t built = 0;
  const json answer = json::parse(first.out);
  for (const json& one : answer.at("recipes")) built += one.at("exit_code") == 0 ? 1 : 0;
  EXPECT_EQ(built, 22U);
  EXPECT_TRUE(fs::exists(folder / "out/Toes.R_30/Toes.R_30.glb"));
  EXPECT_THAT(text("junit.xml"), HasSubstr("tests=\"24\" failures=\"2\""));
  EXPECT_THAT(text("summary.md"), HasSubstr("22 of 24 recipes built"));
  const json log = json::parse(text("all.sarif"));
  std::size_t errors = 0;
  for (const json& result : log.at("runs").at(0).at("results")) {
    if (result.at("level") != "error") continue;
    ++errors;
    const json& place = result.at("locations").at(0).at("physicalLocation");
    EXPECT_EQ(place.at("artifactLocation").at("uri"), "many.json");
    EXPECT_EQ(place.at("region").at("startLine"), 8);
    EXPECT_THAT(result.at("message").at("text").get<std::string>(), HasSubstr("Hed"));
  }
  EXPECT_EQ(errors, 2U);
  EXPECT_THAT(first.err, HasSubstr("::error file=many.json,line=8,col="));

  const ProgramResult second = night({});  // the second night does nothing, and says the same
  EXPECT_EQ(second.status, 6);
  EXPECT_EQ(ran(second), 0U);
  EXPECT_THAT(text("junit.xml"), HasSubstr("failures=\"2\""));
  EXPECT_GT(ran(night({"--retry-failed"})), 0U);
  EXPECT_EQ(night({"--only", "without=Head"}).status, 0);
  std::set<std::string> names;
  for (const char* shard : {"1/3", "2/3", "3/3"}) {
    const json part = json::parse(night({"--shard", shard}).out);
    for (const json& one : part.at("recipes")) names.insert(one.at("variant"));
    EXPECT_EQ(part.at("recipes").size(), 8U);
  }
  EXPECT_EQ(names.size(), 24U);
}

// Every digest in the file is derived anew; an edit, a stripped stamp and a changed input are noticed.
TEST_F(Goals, Goal21ProvenanceIsVerified) {
  ASSERT_EQ(build().status, 0);
  const auto verify = [&](const std::string& file, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"verify", file});
    return Program(SKINFORGE_BINARY, more, folder.path()).finish();
  };
  EXPECT_EQ(verify("out/tail.glb").status, 0);
  EXPECT_EQ(verify("out/tail.glb", {"--recipe", "tail.json"}).status, 0);
  std::ifstream file(folder / "out/tail.glb", std::ios::binary);
  const std::string good(std::istreambuf_iterator<char>(file), {});
  const auto write_changed = [&](const std::string& name, const std::function<void(std::string&)>& change) {
    std::string bytes = good;
    change(bytes);
    std::ofstream(folder / name, std::ios::binary) << bytes;
  };
  write_changed("edited.glb", [](std::string& bytes) { bytes[bytes.size() - 100] ^= 1; });
  EXPECT_EQ(verify("edited.glb").status, 4);
  EXPECT_THAT(verify("edited.glb").err, HasSubstr("not as it was written"));
  write_changed("stripped.glb",
                [](std::string& bytes) { bytes.replace(bytes.find("content_sha256"), 7, "tnetnoc"); });
  EXPECT_EQ(verify("stripped.glb").status, 4);
  EXPECT_EQ(verify("human.glb").status, 4);  // not made by this tool
  EXPECT_EQ(verify("tail.json").status, 3);

  const std::string stated =
      json::parse(verify("out/tail.glb", {"--json"}).out).at("provenance").at("recipe_sha256");
  EXPECT_EQ(stated.size(), 64U);
  EXPECT_THAT(verify("out/tail.glb", {"--recipe", "tail.json", "--set", "/output/influences=8"}).err,
              HasSubstr("asks for something else now: " + stated.substr(0, 12)));
  fs::copy_file(testing::repository_file("data/horse.glb"), folder / "griffin.glb",
                fs::copy_options::overwrite_existing);
  EXPECT_THAT(verify("out/tail.glb", {"--recipe", "tail.json"}).err,
              HasSubstr("input \"griffin\": griffin.glb was "));
}

}  // namespace
}  // namespace skinforge
