#include "results/goal_test.h"

// Goal 13 of the build tool inside a build: a golden in the recipe, its verdict and how it is accepted.
namespace skinforge {
namespace {
using namespace testing;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

class Goal13Golden : public TailTest {
 protected:
  // With one clip and a golden.
  void SetUp() override {
    TailTest::SetUp();
    recipe["animation"] = {{"clips", {"Walk"}}};
    recipe["expect"]["golden"] = "golden/tail.glb";
    write();
  }

  ProgramResult build(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"build", "tail.json", "--out", "out", "--cache", "cache", "--report", "json",
                               "--json", "--junit", "j.xml", "--sarif", "s.json"});
    return call(more);
  }
  static json first_recipe(const ProgramResult& result) {
    return json::parse(result.out).at("recipes").at(0);
  }
  json report() const { return json::parse(read_text(folder / "out/report.json")); }
  void make_golden() const { ASSERT_EQ(build({"--accept"}).status, 0); }
  // The tail a little larger.
  void change() {
    recipe["ops"][0]["place"]["scale"] = 0.78;
    write();
  }
  std::size_t line_of(const std::string& text) const {
    const std::string whole = read_text(folder / "tail.json");
    return 1 + static_cast<std::size_t>(std::count(
                   whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(whole.find(text)), '\n'));
  }
};

TEST_F(Goal13Golden, AMissingOneIsToldWithTheWayToMakeIt) {
  const ProgramResult check = call({"check", "tail.json", "--cache", "cache"});
  EXPECT_EQ(check.status, 0);
  EXPECT_THAT(check.err, HasSubstr("[golden-missing]"));
  const ProgramResult result = build();
  EXPECT_EQ(result.status, 3) << result.err;
  EXPECT_THAT(
      first_recipe(result).at("error").get<std::string>(),
      ContainsRegex("tail\\.json:[0-9]+:[0-9]+: /expect/golden: golden/tail\\.glb is not there; .*build "
                    "--accept makes it"));
  EXPECT_TRUE(fs::exists(folder / "out/tail.glb"));  // to be looked at
  EXPECT_EQ(report().at("golden").at("missing"), true);
  EXPECT_FALSE(fs::exists(folder / "golden"));
}

TEST_F(Goal13Golden, AcceptMakesItAndThenAllIsWell) {
  const ProgramResult accepted = build({"--accept"});
  ASSERT_EQ(accepted.status, 0) << accepted.err;
  EXPECT_EQ(read_text(folder / "golden/tail.glb"), read_text(folder / "out/tail.glb"));
  EXPECT_FALSE(fs::exists(folder / "golden/tail.glb.change.md"));  // nothing was there to change
  const ProgramResult result = build();
  EXPECT_EQ(result.status, 0) << result.err;
  for (const json& stage : first_recipe(result).at("stages")) EXPECT_EQ(stage.at("status"), "hit") << stage;
  EXPECT_EQ(report().at("golden").at("file"), "tail.glb");
  EXPECT_EQ(report().at("golden").at("missing"), false);
  const json told = report();
  for (const json& finding : told.at("golden").at("findings"))
    EXPECT_EQ(finding.at("is_over"), false) << finding;
}

// Over a threshold: exit 5 at the line of the recipe, everywhere a CI looks; the files are there; the next
// build does nothing again.
TEST_F(Goal13Golden, ADifferenceIsToldEverywhere) {
  make_golden();
  change();
  const std::string golden = read_text(folder / "golden/tail.glb");
  const std::size_t line = line_of("\"golden\"");
  for (const char* status : {"ran", "hit"}) {
    const ProgramResult result = build();
    ASSERT_EQ(result.status, 5) << result.err;
    const json answer = first_recipe(result);
    EXPECT_EQ(answer.at("id"), "different");
    EXPECT_THAT(answer.at("error").get<std::string>(), HasSubstr("tail.json:" + std::to_string(line) + ":"));
    EXPECT_THAT(answer.at("error").get<std::string>(), HasSubstr("differs from golden/tail.glb: structure"));
    EXPECT_THAT(answer.at("error").get<std::string>(), HasSubstr("build --accept takes it"));
    for (const json& stage : answer.at("stages")) {
      if (stage.at("stage") == "compare") {
        EXPECT_EQ(stage.at("status"), status);
      } else if (stage.at("stage") == "golden") {
        EXPECT_EQ(stage.value("remembered", false), std::string(status) == "hit");
      }
    }
  }
  EXPECT_THAT(read_text(folder / "j.xml"), HasSubstr("type=\"different\""));
  const json sarif = json::parse(read_text(folder / "s.json")).at("runs").at(0).at("results").at(0);
  EXPECT_EQ(sarif.at("ruleId"), "different");
  EXPECT_EQ(sarif.at("/locations/0/physicalLocation/region/startLine"_json_pointer), line);
  bool is_over = false;
  const json told = report();
  for (const json& finding : told.at("golden").at("findings")) is_over |= finding.at("is_over").get<bool>();
  EXPECT_TRUE(is_over);
  EXPECT_THAT(report().at("issues").dump(), HasSubstr("golden-different"));
  EXPECT_NE(read_text(folder / "out/tail.glb"), golden);
  const json provenance = answer({"diff", "golden/tail.glb", "out/tail.glb"}, 5).at("provenance");
  EXPECT_THAT(provenance.dump(), ContainsRegex("^\\[\"recipe: [0-9a-f]{12} -> [0-9a-f]{12}\"\\]$"));
  EXPECT_EQ(read_text(folder / "golden/tail.glb"), golden);
}

TEST_F(Goal13Golden, ThresholdsStandInTheRecipe) {
  make_golden();
  change();
  recipe["expect"]["golden"] = {
      {"file", "golden/tail.glb"}, {"geometry", "5%"}, {"normals", 180}, {"uv", 1},
      {"animation", 0.05},         {"weights", 2},     {"duration", 1},  {"picture", "20%"},
      {"structure", "any"}};
  write();
  const ProgramResult result = build();
  EXPECT_EQ(result.status, 0) << result.err;
  recipe["expect"]["golden"]["geometry"] = "0.01%";
  write();
  EXPECT_EQ(build().status, 5);
}

TEST_F(Goal13Golden, AcceptTakesANewOneWithANote) {
  make_golden();
  change();
  ASSERT_EQ(build({"--accept"}).status, 0);
  EXPECT_EQ(read_text(folder / "golden/tail.glb"), read_text(folder / "out/tail.glb"));
  EXPECT_THAT(read_text(folder / "golden/tail.glb.change.md"), HasSubstr("surface distance"));
  EXPECT_EQ(build().status, 0);
}

// What fails otherwise is not accepted.
TEST_F(Goal13Golden, NothingIsAcceptedOverBudget) {
  make_golden();
  const std::string golden = read_text(folder / "golden/tail.glb");
  change();
  recipe["expect"]["joints"] = 1;
  write();
  const ProgramResult result = build({"--accept"});
  EXPECT_EQ(result.status, 4) << result.err;
  EXPECT_EQ(read_text(folder / "golden/tail.glb"), golden);
  EXPECT_FALSE(fs::exists(folder / "golden/tail.glb.change.md"));
}

// The golden is part of the key: another file is compared anew, and explained with its place.
TEST_F(Goal13Golden, AnotherFileIsComparedAnew) {
  make_golden();
  fs::copy_file(folder / "human.glb", folder / "golden/tail.glb", fs::copy_options::overwrite_existing);
  const auto said = [&](const std::string& verb) {
    return call({verb, "tail.json", "--cache", "cache", "--report", "json"}).out;
  };
  EXPECT_THAT(said("plan"), ContainsRegex("run +compare"));
  EXPECT_THAT(said("plan"), HasSubstr("hit   export"));
  EXPECT_THAT(said("explain"), HasSubstr("file golden: "));
  EXPECT_THAT(said("explain"), HasSubstr("tail.json:" + std::to_string(line_of("\"golden\""))));
  EXPECT_EQ(build().status, 5);
}

TEST_F(Goal13Golden, MistakesAreTold) {
  fs::create_directories(folder / "golden");
  std::ofstream(folder / "golden/tail.glb") << "no model";
  const ProgramResult broken = build();
  EXPECT_EQ(broken.status, 3);
  EXPECT_THAT(broken.err, ContainsRegex("tail\\.json:[0-9]+:[0-9]+: /expect/golden: "));
  EXPECT_EQ(build({"--accept", "--preview"}).status, 2);
  for (const auto& [golden, message] : std::vector<std::pair<json, std::string>>{
           {"golden.fbx", "must end in .glb"},
           {"/golden.glb", "absolute"},
           {json::object(), "missing key \"file\""},
           {{{"file", "a.glb"}, {"geometry", "x"}}, "percentage"},
           {{{"file", "a.glb"}, {"animatoin", 1}}, "nearest: \"animation\""},
           {{{"file", "a.glb"}, {"structure", "some"}}, "expected one of \"none\", \"any\""}}) {
    recipe["expect"]["golden"] = golden;
    write();
    const ProgramResult result = build();
    EXPECT_EQ(result.status, 2) << golden;
    EXPECT_THAT(result.err, HasSubstr(message)) << golden;
  }
  recipe.erase("expect");
  write();
  const ProgramResult without = build({"--accept"});
  EXPECT_EQ(without.status, 2);
  EXPECT_THAT(without.err, HasSubstr("--accept needs a golden"));
}
}  // namespace
}  // namespace skinforge
