#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "io/export.h"
#include "testing/assets.h"
#include "testing/program.h"
#include "testing/temporary_folder.h"
#include "testing/toy_character.h"

// Goal 14: pages that a browser shows without a network, opened in headless Chromium.
namespace skinforge {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::Program;

constexpr double kMoves = 0.003;  // of a small picture's pixels: more than a hand
constexpr std::uintmax_t kMegabyte = 1'000'000;

bool has_viewer() {
  return fs::exists(fs::path(SKINFORGE_BINARY).parent_path() / "skinforge_viewer.js.gz");
}

class Goal14 : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_viewer())
      GTEST_SKIP() << "VIEWER ABSENT: scripts/setup.sh --node brings three.js and the bundler; build again";
  }
  void run(const std::vector<std::string>& arguments, int status = 0) const {
    const auto result = Program(SKINFORGE_BINARY, arguments, folder.path()).finish();
    ASSERT_EQ(result.status, status) << result.err;
  }
  // What the browser saw; null where there is no browser.
  json opened(const std::string& kind, const fs::path& page) const {
    const auto script = testing::repository_file("tests/html/check_page.py");
    const auto result = Program("/usr/bin/env", {"python3", script, kind, page}, folder.path()).finish();
    if (result.status == 3) return nullptr;
    EXPECT_EQ(result.status, 0) << result.err;
    return json::parse(result.out, nullptr, false);
  }

  testing::TemporaryFolder folder;
};

void expect_quiet(const json& seen) {
  EXPECT_EQ(seen.at("viewer"), "ready") << seen.at("text");
  EXPECT_THAT(seen.at("complaints"), IsEmpty()) << seen.at("complaints");
  EXPECT_THAT(seen.at("requests"), IsEmpty()) << seen.at("requests");
}

TEST_F(Goal14, TheReportOfABuild) {
  const std::string recipe = testing::repository_file("recipes/tail.json");
  run({"build", recipe, "--out", "out", "--cache", "cache"});
  const auto page = fs::file_size(folder / "out/report.html"), model = fs::file_size(folder / "out/tail.glb");
  EXPECT_LE(page, kMegabyte + (model + 2) / 3 * 4);  // as base64
  const json seen = opened("build", folder / "out/report.html");
  if (seen.is_null()) GTEST_SKIP() << "CHROMIUM ABSENT: scripts/setup.sh --node installs it";
  expect_quiet(seen);
  const json report = json::parse(std::ifstream(folder / "out/report.json"));
  EXPECT_EQ(seen.at("clips").size(), report.at("clips").size());
  for (const auto& [clip, share] : seen.at("moved").items()) EXPECT_GT(share.get<double>(), kMoves) << clip;
  for (const auto& [what, share] : seen.at("changed").items()) EXPECT_GT(share.get<double>(), kMoves) << what;
  EXPECT_EQ(seen.at("legend"), json({"human", "griffin", "made new at a junction"})) << seen.at("legend");
  EXPECT_EQ(seen.at("pictures"), 3);  // rest, weights, the junction
  for (const char* section : {"clips", "junctions", "pictures", "issues", "ledger", "timeline", "files"})
    EXPECT_THAT(seen.at("sections"), Contains(section));
}

TEST_F(Goal14, ANoOpBuildLeavesThePageAlone) {
  const std::string recipe = testing::repository_file("recipes/tail.json");
  run({"build", recipe, "--out", "out", "--cache", "cache"});
  const auto written = fs::last_write_time(folder / "out/report.html");
  run({"build", recipe, "--out", "out", "--cache", "cache"});
  EXPECT_EQ(fs::last_write_time(folder / "out/report.html"), written);
  fs::remove(folder / "out/report.html");
  run({"build", recipe, "--out", "out", "--cache", "cache"});
  EXPECT_TRUE(fs::exists(folder / "out/report.html"));
}

// Names from a file are shown, not run: the markup in a joint's name would ask for a picture and complain.
TEST_F(Goal14, TwoModelsSideBySide) {
  Character toy = testing::ToyCharacter::make();
  const auto write = [&](const char* name) {
    const Bytes glb = write_glb(toy);
    std::ofstream(folder / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(glb.data()), static_cast<std::streamsize>(glb.size()));
  };
  toy.skeleton.joints[1].name = "</script><img src=x onerror=document.title=1>";
  write("a.glb");
  for (JointTracks& tracks : toy.clips[0].joints)
    for (Vec3& value : tracks.translation.values) value *= 1.5;
  write("b.glb");
  run({"diff", "a.glb", "b.glb", "--html", "diff.html"}, 5);
  const json seen = opened("diff", folder / "diff.html");
  if (seen.is_null()) GTEST_SKIP() << "CHROMIUM ABSENT: scripts/setup.sh --node installs it";
  expect_quiet(seen);
  EXPECT_THAT(seen.at("sections"), ElementsAre("findings", "clips", "pictures", "structure"));
  EXPECT_GT(seen.at("changed").at("error").get<double>(), kMoves);
  EXPECT_EQ(seen.at("pictures"), 4 + 3 + 2);  // the bind pose, the worst clip, two more
  const auto models = fs::file_size(folder / "a.glb") + fs::file_size(folder / "b.glb");
  EXPECT_LE(fs::file_size(folder / "diff.html"), kMegabyte + (models + 2) / 3 * 4);
}

}  // namespace
}  // namespace skinforge
