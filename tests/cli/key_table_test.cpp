// What makes a stage run again, and what does not: changes to a build that was made once, judged by `plan`,
// which runs nothing. That each property of a recipe moves its own stages is
// tests/stages/stage_settings_test.cpp.
#include <gmock/gmock.h>

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "testing/assets.h"
#include "testing/program.h"
#include "testing/temporary_folder.h"

namespace skinforge {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using testing::Program;
using testing::TemporaryFolder;

std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_text(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

/// A folder with recipe and inputs: a human in one file, a griffin as .gltf with buffer and picture beside
/// it, clips from a third file, the placing in a file that the recipe extends.
void write_project(const fs::path& root) {
  const auto data = [](const char* name) { return testing::repository_file(std::string("data/") + name); };
  for (const char* name : {"human.glb", "horse.glb"}) {
    fs::create_directories(root / "models");
    fs::copy_file(data(name), root / "models" / name);
  }
  const std::string glb = read_text(data("griffin.glb"));
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, sizeof length);
  json document = json::parse(glb.substr(20, length));
  write_text(root / "models/griffin.bin", glb.substr(20 + length + 8));
  document.at("buffers").at(0)["uri"] = "griffin.bin";
  document["images"] = json::array({{{"uri", "skin.png"}}});
  document["textures"] = json::array({{{"source", 0}}});
  write_text(root / "models/griffin.gltf", document.dump());
  fs::copy_file(data("human.png"), root / "models/skin.png");
  write_text(root / "base.json", R"({ "recipe_version": 1, "name": "mix", "base": "human",
  "inputs": { "human": { "file": "models/human.glb", "clips": ["models/human.glb"] }, "griffin": "models/griffin.gltf" } })");
  write_text(root / "mix.json",
             R"({ "recipe_version": 1, "extends": "base.json", "vars": { "size": { "default": 0.75 } },
  "ops": [ { "op": "attach", "at": "Hips", "from": "griffin", "joint": "Tail1",
             "place": { "align": "none", "scale": "${size}", "offset": [0.0, 0.194, 0.379] } } ] })");
}

using Variables = std::map<std::string, std::string>;

class KeyTable : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    root_ = new TemporaryFolder;
    write_project(*root_ / "project");
    const auto built = call({"build", "mix.json", "--report", "json"}, *root_ / "project", {});
    ASSERT_EQ(built.status, 0) << built.err;
  }
  static void TearDownTestSuite() {
    delete root_;
    root_ = nullptr;
  }

  static testing::ProgramResult call(std::vector<std::string> words, const fs::path& folder,
                                     const Variables& variables,
                                     const std::string& program = SKINFORGE_BINARY) {
    words.insert(words.end(), {"--cache", *root_ / "cache", "--json"});
    return Program(program, words, folder, variables).finish();
  }

  /// Stages that `plan` would run, "" when it finds all in the cache.
  static std::string stages_to_run(const fs::path& folder, std::vector<std::string> words = {"mix.json"},
                                   const Variables& variables = {},
                                   const std::string& program = SKINFORGE_BINARY) {
    words.insert(words.begin(), "plan");
    const auto result = call(words, folder, variables, program);
    if (result.status != 0) return "failed: " + result.err;
    std::string stages;
    const json answer = json::parse(result.out);
    for (const json& stage : answer.at("recipes").at(0).at("stages"))
      if (stage.at("state") == "run" && stage.at("stage") != "pictures" &&
          stage.at("stage") != "view")  // of a full report alone
        stages += (stages.empty() ? "" : ", ") + stage.at("stage").get<std::string>();
    return stages;
  }

  /// A copy of the project, elsewhere.
  fs::path copy() {
    const fs::path folder = *root_ / ("copy" + std::to_string(copies_++));
    fs::copy(*root_ / "project", folder, fs::copy_options::recursive);
    return folder;
  }

  static void flip(const fs::path& file, std::size_t at) {
    std::string text = read_text(file);
    text.at(at) = static_cast<char>(text.at(at) ^ 1);
    write_text(file, text);
  }
  static void replace(const fs::path& file, const std::string& from, const std::string& to) {
    std::string text = read_text(file);
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write_text(file, text.replace(at, from.size(), to));
  }

  static inline TemporaryFolder* root_ = nullptr;
  static inline int copies_ = 0;
};

TEST_F(KeyTable, EveryRegionOfEveryInputMatters) {
  constexpr std::size_t kRegions = 8;
  int changes = 0;
  for (const auto& [file, stage] : {std::pair("models/human.glb", "import human"),
                                    {"models/griffin.gltf", "import griffin"},
                                    {"models/griffin.bin", "import griffin"},
                                    {"models/skin.png", "import griffin"}}) {
    const fs::path folder = copy();
    const std::string sound = read_text(folder / file);
    for (std::size_t region = 0; region < kRegions; ++region, ++changes) {
      // In JSON a flip may break the text or name another file: a value behind the comma of a number is safe.
      std::size_t at = region * (sound.size() - 1) / (kRegions - 1);
      if (std::string(file).ends_with(".gltf"))
        at = sound.find('.', sound.find("\"nodes\"") + region * 700) + 1;
      write_text(folder / file, sound);
      if (std::string(file).ends_with(".glb") && region == 0)
        at = 20;  // in its head it would be another format
      flip(folder / file, at);
      EXPECT_EQ(stages_to_run(folder), stage) << file << " byte " << at;
    }
  }
  EXPECT_EQ(changes, 32);
}

TEST_F(KeyTable, WhatTheRecipeSaysMatters) {
  struct Edit {
    const char* file;
    const char* from;
    const char* to;
    const char* runs;  // the first of them
  };
  const std::vector<Edit> edits = {
      {"mix.json", "0.75", "0.7501", "place"},
      {"mix.json", "0.194", "0.1941", "place"},
      {"mix.json", "\"align\": \"none\"", "\"align\": \"none\", \"rotate_deg\": [0, 1, 0]", "place"},
      {"mix.json", "\"Hips\"", "\"Chest\"", "place"},
      {"mix.json", "\"Tail1\"", "\"Tail2\"", "place"},
      {"mix.json", "\"joint\"", "\"blend\": { \"radius\": 0.05 }, \"joint\"", "turn"},
      {"mix.json", "\"joint\"", "\"surface\": { \"voxel\": 0.02 }, \"joint\"", "turn"},
      {"mix.json", "\"joint\"", "\"surface\": { \"hardness\": 0.4 }, \"joint\"", "turn"},
      {"mix.json", "\"joint\"", "\"surface\": { \"elements\": \"triangles\" }, \"joint\"", "junction"},
      {"mix.json", "\"ops\"", "\"animation\": { \"tempo\": [0.9, 1.1] }, \"ops\"", "complete_clip"},
      {"mix.json", "\"ops\"", "\"animation\": { \"limb_phase\": 0.25 }, \"ops\"", "complete_clip"},
      {"mix.json", "\"ops\"", "\"animation\": { \"limb_clearing_deg\": 0 }, \"ops\"", "complete_clip"},
      {"mix.json", "\"ops\"", "\"animation\": { \"key_tolerance\": 0.001 }, \"ops\"", "complete_clip"},
      {"mix.json", "\"ops\"", "\"output\": { \"influences\": 8 }, \"ops\"", "bind"},
      {"mix.json", "\"ops\"", "\"expect\": { \"joints\": 1 }, \"ops\"", "expect"},
      {"base.json", "\"mix\"", "\"max\"", "bind"},
      {"base.json", "[\"models/human.glb\"]", "[\"models/horse.glb\"]", "import human"},
      {"base.json", "[\"models/human.glb\"]", "[]", "import human"},
      {"base.json", "\"models/human.glb\"", "\"models/horse.glb\"", "import human"},
      {"base.json", "\"griffin\": \"models/griffin.gltf\"",
       "\"griffin\": { \"file\": \"models/griffin.gltf\", \"pose\": { \"Tail1\": { \"rotate_deg\": [5, 0, 0] "
       "} } }",
       "pose griffin"}};
  for (const Edit& edit : edits) {
    const fs::path folder = copy();
    replace(folder / edit.file, edit.from, edit.to);
    EXPECT_THAT(stages_to_run(folder), ::testing::HasSubstr(edit.runs)) << edit.file << ": " << edit.to;
  }
  const fs::path folder = copy();
  EXPECT_EQ(stages_to_run(folder, {"mix.json", "--set", "size=0.8"}), "place");
  EXPECT_THAT(stages_to_run(folder, {"mix.json", "--set", "/ops/0/place/scale=0.8"}),
              ::testing::HasSubstr("place"));
}

/// Another program, another library: nothing of the cache is believed.
TEST_F(KeyTable, TheProgramAndItsLibrariesMatter) {
  const fs::path folder = copy(), other = folder / "bin";
  fs::create_directories(other);
  const fs::path binary = SKINFORGE_BINARY;
  for (const char* name : {"skinforge", "libskinforge_vdb.so"})
    fs::copy_file(binary.parent_path() / name, other / name);
  EXPECT_EQ(stages_to_run(folder, {"mix.json"}, {}, other / "skinforge"), "");
  for (const char* library : {"libassimp.so.5", "libm.so.6", "libopenvdb.so.10.0"}) {
    const fs::path found = fs::path("/usr/lib/x86_64-linux-gnu") / library;
    if (!fs::exists(found)) continue;
    const fs::path libraries = folder / ("with-" + std::string(library));
    std::string text = read_text(found);
    const auto note = text.find(std::string("GNU\0", 4));  // name of the build-id note; the id follows
    ASSERT_NE(note, std::string::npos);
    const auto id = text.find(std::string("\x03\0\0\0GNU\0", 8));
    ASSERT_NE(id, std::string::npos);
    text[id + 8] = static_cast<char>(text[id + 8] ^ 1);
    write_text(libraries / library, text);
    EXPECT_THAT(stages_to_run(folder, {"mix.json"}, {{"LD_LIBRARY_PATH", libraries}}),
                ::testing::HasSubstr("import human"))
        << library;
  }
}

TEST_F(KeyTable, WhatDoesNotChangeTheResultDoesNotMatter) {
  const fs::path folder = copy();  // another path
  const auto expect_hit = [&](const char* what, std::vector<std::string> words = {"mix.json"},
                              const Variables& variables = {}, const fs::path& from = {}) {
    EXPECT_EQ(stages_to_run(from.empty() ? folder : from, std::move(words), variables), "") << what;
  };
  expect_hit("path");
  expect_hit("absolute recipe", {folder / "mix.json"});
  fs::create_directories(folder / "elsewhere");
  expect_hit("folder of the call", {"../mix.json"}, {}, folder / "elsewhere");
  for (const char* jobs : {"1", "2", "8"}) expect_hit("threads", {"mix.json", "-j", jobs});
  expect_hit("talk", {"mix.json", "-v"});
  expect_hit("limits", {"mix.json", "--limit", "vertices=20M"});
  for (const auto& [name, value] : Variables{{"LC_ALL", "de_DE.UTF-8"},
                                             {"LANG", "tr_TR.UTF-8"},
                                             {"TZ", "Asia/Kolkata"},
                                             {"HOME", "/nowhere"},
                                             {"NO_COLOR", "1"},
                                             {"CI", "true"},
                                             {"TERM", "dumb"},
                                             {"USER", "somebody"},
                                             {"TMPDIR", "/var/tmp"},
                                             {"OMP_NUM_THREADS", "3"}})
    expect_hit(name.c_str(), {"mix.json"}, {{name, value}});
  for (const auto& item : fs::recursive_directory_iterator(folder))
    fs::last_write_time(item.path(), fs::file_time_type::clock::now() + std::chrono::hours(24 * 365 * 50));
  expect_hit("times of 50 years ahead");
  fs::permissions(folder / "models/human.glb", fs::perms::owner_read);
  expect_hit("permissions");
  fs::rename(folder / "models/griffin.bin", folder / "real.bin");
  fs::create_hard_link(folder / "real.bin", folder / "models/griffin.bin");
  expect_hit("hard links");
  write_text(folder / "models/notes.txt", "a file that nobody names");
  expect_hit("other files");
  const json recipe = json::parse(read_text(folder / "mix.json"));
  write_text(folder / "mix.json", recipe.dump(4));
  expect_hit("order of keys and white space");
  write_text(folder / "mix.json", "// a comment\n" + recipe.dump() + " /* another */");
  expect_hit("comments");
  replace(folder / "mix.json", "0.75", "7.5e-1");
  expect_hit("another spelling of a number");
  replace(folder / "mix.json", "\"default\":7.5e-1", "\"default\":9");
  expect_hit("a value that --set brings instead", {"mix.json", "--set", "size=0.75"});
  write_text(folder / "mix.yaml", recipe.dump());  // JSON is YAML
  expect_hit("YAML", {"mix.yaml"});
  fs::rename(folder / "mix.yaml", folder / "renamed.yaml");
  expect_hit("name of the recipe's file", {"renamed.yaml"});
}

}  // namespace
}  // namespace skinforge
