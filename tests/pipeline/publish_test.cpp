#include "pipeline/publish.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "pipeline/text_stage.h"
#include "testing/temporary_folder.h"

namespace skinforge {
namespace {
namespace fs = std::filesystem;
using testing::bytes_of;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using testing::TemporaryFolder;

std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class Publish : public ::testing::Test {
 protected:
  Publish() {
    engine.put_source("glb", bytes_of("GLB"));
    engine.put_source("picture", bytes_of("PNG"));
  }
  std::string failure(std::vector<OutputFile> files, std::vector<fs::path> inputs = {}) {
    try {
      publish(engine, files, folder / "out", inputs);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::Usage);
      return error.what();
    }
    return "no error";
  }

  TemporaryFolder folder;
  MemoryStore store;
  Cache cache{store};
  Engine engine{cache, {}};
};

TEST_F(Publish, WritesOnlyWhatDiffers) {
  const std::vector<OutputFile> files = {{"centaur.glb", "glb"}, {"pictures/rest.png", "picture"}};
  for (const bool expected : {true, false}) {
    const auto published = publish(engine, files, folder / "out");
    ASSERT_THAT(published, SizeIs(2));
    EXPECT_EQ(published[0].was_written, expected);
    EXPECT_EQ(published[1].was_written, expected);
    EXPECT_EQ(published[0].digest, sha256(bytes_of("GLB")));
  }
  EXPECT_EQ(read_text(folder / "out/centaur.glb"), "GLB");
  EXPECT_EQ(read_text(folder / "out/pictures/rest.png"), "PNG");
  std::ofstream(folder / "out/centaur.glb") << "BLG";  // same length
  EXPECT_TRUE(publish(engine, files, folder / "out")[0].was_written);
  EXPECT_EQ(read_text(folder / "out/centaur.glb"), "GLB");
}

TEST_F(Publish, LeavesOutWhatWasNotMade) {
  engine.add(testing::text_stage("one", {"glb"}, {"never run"}, ""));
  EXPECT_THAT(publish(engine, std::vector<OutputFile>{{"a.glb", "never run"}}, folder / "out"), SizeIs(0));
  EXPECT_FALSE(fs::exists(folder / "out/a.glb"));
}

TEST_F(Publish, StaysInsideItsFolder) {
  for (const char* name :
       {"../escape.glb", "/tmp/escape.glb", "a/../../b.glb", "", "a//b.glb", "a\\b.glb", ".", "con.glb"})
    EXPECT_THAT(failure({{name, "glb"}}), HasSubstr("is not a safe name")) << name;
  fs::create_directories(folder / "out");
  fs::create_directories(folder / "elsewhere");
  fs::create_directory_symlink(folder / "elsewhere", folder / "out/pictures");
  EXPECT_THAT(failure({{"pictures/rest.png", "picture"}}), HasSubstr("leads outside the output folder"));
  EXPECT_TRUE(fs::is_empty(folder / "elsewhere"));
}

TEST_F(Publish, ReplacesALinkInsteadOfFollowingIt) {
  fs::create_directories(folder / "out");
  std::ofstream(folder / "target") << "old";
  fs::create_symlink(folder / "target", folder / "out/a.glb");
  publish(engine, std::vector<OutputFile>{{"a.glb", "glb"}}, folder / "out");
  EXPECT_EQ(read_text(folder / "target"), "old");
  EXPECT_EQ(read_text(folder / "out/a.glb"), "GLB");
}

TEST_F(Publish, RemovesWhatKilledBuildsLeft) {
  fs::create_directories(folder / "out");
  std::ofstream(folder / "out/.skinforge-1-2") << "half";
  publish(engine, std::vector<OutputFile>{{"a.glb", "glb"}}, folder / "out");
  EXPECT_FALSE(fs::exists(folder / "out/.skinforge-1-2"));
  EXPECT_TRUE(fs::exists(folder / "out/a.glb"));
}

// Folders that cannot be made, files that cannot replace what is there: the message says why.
TEST_F(Publish, SaysWhyItCannotWrite) {
  std::filesystem::create_directories(folder / "out/full.txt/inside");
  try {
    write_output(folder / "out/full.txt", bytes_of("x"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::StageFailed);
    EXPECT_THAT(error.what(), ::testing::EndsWith("out/full.txt: cannot be written: Is a directory"));
  }
  EXPECT_THROW(write_output(folder / "nowhere/x", bytes_of("x")), Error);
  EXPECT_FALSE(std::filesystem::exists(folder / "nowhere"));
  for (const auto& item : std::filesystem::directory_iterator(folder / "out"))
    EXPECT_FALSE(item.path().filename().string().starts_with(".skinforge-")) << item.path();
}

TEST_F(Publish, NeverOverwritesAnInputOrWritesTwice) {
  fs::create_directories(folder / "out");
  std::ofstream(folder / "out/horse.glb") << "input";
  EXPECT_THAT(failure({{"horse.glb", "glb"}}, {folder / "out/horse.glb"}),
              HasSubstr("would overwrite an input"));
  EXPECT_EQ(read_text(folder / "out/horse.glb"), "input");
  EXPECT_THAT(failure({{"a", "glb"}, {"a", "picture"}}), HasSubstr("is written twice"));
}

// The blob of an output is damaged after the build: its stage runs again, the file is right.
TEST_F(Publish, RepairsADamagedBlob) {
  struct RawStage final : Stage {
    StageInfo info() const override { return {.name = "raw", .writes = {"file"}}; }
    void add_to_key(Hasher&) const override {}
    void run(const StageInput&, StageOutput& out, IssueSink&) const override {
      out.put("file", bytes_of("xyz"));
    }
  };
  for (int build = 0; build < 2; ++build) {
    Engine again(cache, {});
    again.add(std::make_unique<RawStage>());
    again.run();
    const fs::path out = folder / ("out" + std::to_string(build));
    publish(again, std::vector<OutputFile>{{"f", "file"}}, out);
    EXPECT_EQ(read_text(out / "f"), "xyz");
    for (auto& [path, bytes] : store.entries)
      if (path.starts_with("cas/")) bytes[0] = std::byte{'?'};
  }
}

}  // namespace
}  // namespace skinforge
