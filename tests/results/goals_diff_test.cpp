#include "io/export.h"
#include "io/import.h"
#include "results/goal_test.h"

// Goal 13 of the build tool: what `diff` finds between a character and what other programs made of it.
namespace skinforge {
namespace {
using namespace testing;
using ::testing::HasSubstr;

class Goal13 : public GoalTest {
 protected:
  void SetUp() override { SKINFORGE_NEEDS_SHARED(); }

  json diff(const std::string& other, int status = 5) const { return answer({"diff", horse, other}, status); }
  static json worst_clip(const json& diff) {
    json worst = {{"max", -1}};
    for (const json& clip : diff.at("clips"))
      if (clip.at("max") > worst.at("max")) worst = clip;
    return worst;
  }

  static json most_changed(const json& diff) {
    json most = {{"changed", -1}};
    for (const json& picture : diff.at("pictures"))
      if (picture.at("changed") > most.at("changed")) most = picture;
    return most;
  }

  const std::string horse = fs::absolute(testing::shared_file("assets/quaternius_horse/horse.glb"));
};

// A "lossless" resample leaves out keys by a tolerance of each channel, which adds up along the limbs.
TEST_F(Goal13, DiffFindsWhatALosslessResampleMoves) {
  const std::string tool = npm_program("gltf-transform");
  if (tool.empty())
    GTEST_SKIP()
        << "GLTF-TRANSFORM ABSENT: npm install @gltf-transform/cli into build/node, or set NODE_PATH";
  ASSERT_EQ(
      Program("/usr/bin/env", {"node", tool, "resample", horse, "b.glb"}, folder.path()).finish().status, 0);
  const json found = diff("b.glb"), worst = worst_clip(found), picture = most_changed(found);
  EXPECT_EQ(worst.at("clip"), "Idle_2");
  EXPECT_NEAR(worst.at("max").get<double>(), 0.0109, 0.0002);
  EXPECT_EQ(picture.at("clip"), "Idle_2");
  EXPECT_EQ(picture.at("time"), worst.at("time"));
  EXPECT_GT(picture.at("changed").get<double>(), 0.2);
  EXPECT_LT(picture.at("ssim").get<double>(), 0.7);
}

TEST_F(Goal13, DiffFindsWhatGltfpackMoves) {
  const std::string tool = npm_program("gltfpack");
  if (tool.empty()) GTEST_SKIP() << "GLTFPACK ABSENT: npm install gltfpack into build/node, or set NODE_PATH";
  ASSERT_EQ(
      Program("/usr/bin/env", {"node", tool, "-i", horse, "-o", "b.glb"}, folder.path()).finish().status, 0);
  const json found = diff("b.glb"), worst = worst_clip(found);
  EXPECT_EQ(worst.at("clip"), "Gallop");
  EXPECT_NEAR(worst.at("max").get<double>(), 0.0267, 0.0003);
  EXPECT_NEAR(worst.at("duration_b").get<double>() - worst.at("duration_a").get<double>(), 0.0167, 0.0001);
  EXPECT_EQ(found.at("structure").at("edits").size(), 15U);  // joints without weights
  EXPECT_EQ(most_changed(found).at("title"), "Gallop at 0.583 s, side");
}

TEST_F(Goal13, DiffOfAFileAndItselfIsNothing) {
  const json same = diff(horse, 0);
  EXPECT_EQ(worst_clip(same).at("max"), 0);
  EXPECT_TRUE(same.at("structure").at("edits").empty());
  EXPECT_TRUE(same.at("drawn_alike").get<bool>());
  EXPECT_TRUE(same.at("rules").empty() && same.at("provenance").empty());
  EXPECT_EQ(same.at("geometry").at("uv_a"), same.at("geometry").at("uv_b"));
  EXPECT_EQ(same.at("/structure/a/genus"_json_pointer), 0);
}

// The file as it came names a wrong root of its skin. That our repair took it away is no fault, the other way
// it is.
TEST_F(Goal13, DiffTellsRulesThatOnlyTheNewFileBreaks) {
  ASSERT_EQ(call({"repair", horse, "-o", "sound.glb"}).status, 0);
  EXPECT_EQ(diff("sound.glb", 0).at("rules").at(0).at("b"), 0);
  const json back = answer({"diff", "sound.glb", horse}, 5);
  EXPECT_EQ(back.at("/structure/edits"_json_pointer), json({"glTF error SKIN_SKELETON_INVALID is new"}));
  EXPECT_EQ(call({"diff", "sound.glb", horse, "--threshold", "structure=any"}).status, 0);
}

// Blender keeps what is seen, to a few float steps, and samples every joint at every frame.
TEST_F(Goal13, DiffFindsOnlyBulkInABlenderRoundTrip) {
  const ProgramResult run = run_blender("round_trip.py", {horse, "b.glb"}, folder.path());
  if (run.status == 127) GTEST_SKIP() << "NO BLENDER: what its round trip changes was not measured";
  ASSERT_TRUE(fs::exists(folder / "b.glb")) << run.out << run.err;
  const json found = diff("b.glb", 0);
  EXPECT_LE(worst_clip(found).at("max").get<double>(), 5e-6);
  EXPECT_LE(found.at("geometry").at("max").get<double>(), 5e-6);
  EXPECT_EQ(found.at("geometry").at("unmatched_a"), 0);
  EXPECT_TRUE(found.at("structure").at("edits").empty()) << found.at("structure").at("edits");
  const json &a = found.at("structure").at("a"), &b = found.at("structure").at("b");
  const auto times = [&](const char* what) { return b.at(what).get<double>() / a.at(what).get<double>(); };
  EXPECT_EQ(most_changed(found).at("changed"), 0);
  EXPECT_NEAR(times("keys"), 4.7, 0.2);
  EXPECT_NEAR(times("bytes"), 2.8, 0.1);
}

// What no distance shows: a body in another colour. Drawings and verdicts go where they are asked for.
TEST_F(Goal13, PicturesShowWhatDistancesDoNot) {
  IssueSink issues;
  Character griffin = import_character(repository_file("data/griffin.glb"), issues);
  const auto write = [&](const char* name) {
    const Bytes glb = write_glb(griffin);
    std::ofstream(folder / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(glb.data()), static_cast<std::streamsize>(glb.size()));
  };
  write("a.glb");
  for (Material& material : griffin.materials) material.base_color.x() *= 0.5;
  write("b.glb");
  const auto compare = [&](const std::vector<std::string>& more, int status) {
    std::vector<std::string> arguments = {"diff", "a.glb", "b.glb", "--threshold", "structure=any"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return answer(arguments, status);
  };
  const json found = compare({"--pictures", "drawn", "--sarif", "s.json", "--junit", "j.xml"}, 5);
  for (const json& finding : found.at("findings"))
    EXPECT_EQ(finding.at("is_over"), finding.at("group") == "picture") << finding;
  EXPECT_EQ(found.at("pictures").size(), 9U);
  for (const json& picture : found.at("pictures")) EXPECT_EQ(picture.at("overlap"), 1) << picture;
  EXPECT_TRUE(fs::exists(folder / "drawn/01_bind_pose_front.png"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "drawn"), {}), 9);
  const json sarif = json::parse(read_text(folder / "s.json")).at("runs").at(0).at("results");
  ASSERT_EQ(sarif.size(), 1U);
  EXPECT_EQ(sarif.at(0).at("ruleId"), "different");
  EXPECT_EQ(sarif.at(0).at("/locations/0/physicalLocation/artifactLocation/uri"_json_pointer), "b.glb");
  EXPECT_THAT(read_text(folder / "j.xml"), HasSubstr("failures=\"1\""));
  EXPECT_THAT(read_text(folder / "j.xml"), HasSubstr("name=\"picture, pictures\""));
  EXPECT_TRUE(compare({"--no-pictures"}, 0).at("pictures").empty());
  compare({"--threshold", "picture=100%"}, 0);
  EXPECT_EQ(call({"diff", "a.glb", "b.glb", "--no-pictures", "--pictures", "x"}).status, 2);
}

TEST_F(Goal13, AcceptPutsTheNewFileInThePlaceOfTheOld) {
  fs::copy_file(testing::shared_file("assets/quaternius_horse/horse.glb"), folder / "golden.glb");
  fs::copy_file(testing::repository_file("data/horse.glb"), folder / "new.glb");
  const auto run = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"diff", "golden.glb", "new.glb"});
    return call(more);
  };
  EXPECT_EQ(run({"--junit", "j.xml"}).status, 5);
  EXPECT_TRUE(fs::exists(folder / "j.xml"));
  EXPECT_EQ(run({"--accept"}).status, 0);
  EXPECT_TRUE(fs::exists(folder / "golden.glb.change.md"));
  EXPECT_EQ(run({}).status, 0);
  EXPECT_EQ(run({"--threshold", "animatoin=1%"}).status, 2);
}

}  // namespace
}  // namespace skinforge
