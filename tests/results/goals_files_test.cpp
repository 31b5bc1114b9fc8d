#include <functional>
#include <map>
#include <set>

#include "io/import.h"
#include "results/goal_test.h"

// Goals of the build tool about files: valid output (10), a complete ledger (11), keys and size (12), faults
// told (15).
namespace skinforge {
namespace {
using namespace testing;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class GoalsOfFiles : public GoalTest {};
class GoalsOfFaults : public TailTest {};

std::vector<fs::path> shared_models() {
  std::vector<fs::path> models;
  for (const auto& item :
       fs::recursive_directory_iterator(fs::absolute(testing::shared_folder() / "assets"))) {
    const std::string ending = item.path().extension();
    if (ending == ".glb" || ending == ".gltf" || ending == ".fbx") models.push_back(item.path());
  }
  std::sort(models.begin(), models.end());
  return models;
}

// Every model comes out without error and warning, whatever it went in with, as the same character, and each
// repair is said.
TEST_F(GoalsOfFiles, Goal10EveryModelComesOutValid) {
  SKINFORGE_NEEDS_SHARED();
  std::size_t broken = 0;
  for (const fs::path& model : shared_models()) {
    const json repaired = answer({"repair", model, "-o", "out.glb"});
    ASSERT_EQ(repaired.at("exit_code"), 0) << model;
    const json after = answer({"validate", "out.glb", "--strict"});
    EXPECT_THAT(after.at("findings"), IsEmpty()) << model << after;
    for (const json& finding : answer({"diff", model, "out.glb"}).at("findings"))
      EXPECT_FALSE(finding.at("is_over").get<bool>()) << model << finding;
    if (model.extension() == ".fbx") continue;
    const json before = json::parse(call({"validate", model, "--json"}).out);
    const bool is_clean = before.at("errors") == 0 && before.at("warnings") == 0;
    broken += !is_clean;
    EXPECT_TRUE(is_clean || !repaired.at("repairs").empty()) << model << before;
  }
  EXPECT_GE(broken, 3U);  // the material has some
}

// Our rules say nothing that the Khronos validator does not say of the same place.
TEST_F(GoalsOfFiles, Goal10OwnRulesAgreeWithTheKhronosValidator) {
  SKINFORGE_NEEDS_SHARED();
  for (const fs::path& model : shared_models()) {
    if (model.extension() == ".fbx") continue;
    const json own = json::parse(call({"validate", model, "--own-rules", "--json"}).out);
    const json both = json::parse(call({"validate", model, "--json"}).out);
    if (both.at("khronos_validator") != "ran")
      GTEST_SKIP()
          << "KHRONOS VALIDATOR ABSENT: npm install gltf-validator into build/node, or set NODE_PATH";
    std::set<std::string> own_codes, all_codes;
    for (const json& finding : own.at("findings")) own_codes.insert(finding.at("code"));
    for (const json& finding : both.at("findings")) all_codes.insert(finding.at("code"));
    EXPECT_EQ(own_codes, all_codes) << model;
  }
}

TEST_F(GoalsOfFiles, Goal10RepairDoesNotTouchItsInput) {
  fs::copy_file(testing::repository_file("data/human.glb"), folder / "human.glb");
  EXPECT_EQ(call({"repair", "human.glb", "-o", "human.glb"}).status, 2);
  EXPECT_EQ(fs::file_size(folder / "human.glb"), fs::file_size(testing::repository_file("data/human.glb")));
  EXPECT_EQ(call({"repair", "human.glb"}).status, 0);
  EXPECT_TRUE(fs::exists(folder / "human.repaired.glb"));
}

// Each clip, joint, material and image of each input stands in the ledger once.
TEST_F(GoalsOfFiles, Goal11TheLedgerIsComplete) {
  const std::string recipe = testing::repository_file("recipes/centaur.json");
  ASSERT_EQ(call({"build", recipe, "--out", "out", "--cache", "cache", "--report", "json"}).status, 0);
  const json report = json::parse(std::ifstream(folder / "out/report.json"));
  for (const json& input : report.at("inputs")) {
    std::map<std::string, std::set<std::string>> items;
    std::map<std::string, std::int64_t> counts;
    for (const json& entry : report.at("ledger")) {
      if (entry.at("input") != input.at("name")) continue;
      ++counts[entry.at("kind")];
      EXPECT_TRUE(items[entry.at("kind")].insert(entry.at("item")).second) << entry;
      const bool is_dropped = entry.at("state") == "dropped";
      EXPECT_TRUE(!is_dropped || entry.at("reason") != "") << entry;
      EXPECT_TRUE(!is_dropped || entry.at("kind") != "clip") << entry;
    }
    EXPECT_EQ(counts["clip"], input.at("clips"));
    EXPECT_EQ(counts["joint"], input.at("joints"));
    EXPECT_EQ(counts["material"], input.at("materials"));
    EXPECT_EQ(counts["image"], input.at("images"));
    const fs::path model = fs::path(recipe).parent_path() / "../data" / input.at("file").get<std::string>();
    for (const json& clip : answer({"inspect", model}).at("clips"))
      EXPECT_TRUE(items["clip"].contains(clip.at("name"))) << clip;
  }
}

// Tracks of joints by "clip/joint", without those named in `but`.
std::map<std::string, RawScene::NodeTracks> tracks_of(const fs::path& file,
                                                      const std::set<std::string>& but = {}) {
  const RawScene scene = read_scene(read_input_files(file.string()));
  std::map<std::string, RawScene::NodeTracks> tracks;
  for (const RawScene::Animation& clip : scene.animations)
    for (const RawScene::NodeTracks& track : clip.nodes) {
      const std::string& joint = scene.nodes[static_cast<std::size_t>(track.node)].name;
      if (!but.contains(joint)) tracks[clip.name + "/" + joint] = track;
    }
  return tracks;
}

std::set<std::string> node_names(const fs::path& file) {
  std::set<std::string> names;
  for (const RawScene::Node& node : read_scene(read_input_files(file.string())).nodes)
    names.insert(node.name);
  return names;
}

// Joints that no graft touches have the keys they came with, to the bit, and the file is no larger than what
// went into it, though every clip moves twice as many joints now.
TEST_F(GoalsOfFiles, Goal12KeysStayAndTheFileIsSmall) {
  const fs::path data = testing::repository_file("data");
  ASSERT_EQ(call({"build", testing::repository_file("recipes/centaur.json"), "--out", "out", "--cache",
                  "cache", "--report", "none"})
                .status,
            0);
  const fs::path made = folder / "out/centaur.glb";
  EXPECT_LE(fs::file_size(made),
            1.2 * static_cast<double>(fs::file_size(data / "horse.glb") + fs::file_size(data / "human.glb")));

  const auto after = tracks_of(made);
  std::size_t compared = 0;
  for (const auto& [name, track] : tracks_of(data / "horse.glb", node_names(data / "human.glb"))) {
    const auto found = after.find(name);
    if (found == after.end()) continue;  // of the neck and the head, which are gone
    ++compared;
    EXPECT_EQ(track.rotation.times, found->second.rotation.times) << name;
    EXPECT_TRUE(track.rotation.values == found->second.rotation.values) << name;
    EXPECT_EQ(track.translation.times, found->second.translation.times) << name;
    EXPECT_TRUE(track.translation.values == found->second.translation.values) << name;
  }
  EXPECT_GT(compared, 50U);
}

// One thing that is wrong with a recipe or a file.
struct Fault {
  std::string name;
  std::function<void(json& recipe)> change;
  int status = 2;
  std::string cause;  // what the message must say
};

std::vector<Fault> recipe_faults() {
  const auto op = [](json& recipe) -> json& { return recipe.at("ops").at(0); };
  return {
      {"unknown key", [](json& r) { r["inputz"] = 1; }, 2, "nearest: \"inputs\""},
      {"no version", [](json& r) { r.erase("recipe_version"); }, 2, "missing key \"recipe_version\""},
      {"future version", [](json& r) { r["recipe_version"] = 2; }, 2, "expected recipe version 1"},
      {"no name", [](json& r) { r.erase("name"); }, 2, "name"},
      {"name with a slash", [](json& r) { r["name"] = "a/b"; }, 2, "cannot be a file name"},
      {"name of a wrong kind", [](json& r) { r["name"] = 3; }, 2, "expected a string"},
      {"no inputs", [](json& r) { r["inputs"] = json::object(); }, 2, "at least one input"},
      {"base unknown", [](json& r) { r["base"] = "humen"; }, 2, "nearest: \"human\""},
      {"from unknown", [&](json& r) { op(r)["from"] = "grifin"; }, 2, "nearest: \"griffin\""},
      {"op unknown", [&](json& r) { op(r)["op"] = "replce"; }, 2, "replace"},
      {"at missing", [&](json& r) { op(r).erase("at"); }, 2, "at"},
      {"at empty", [&](json& r) { op(r)["at"] = json::array(); }, 2, "at least one joint"},
      {"at twice",
       [&](json& r) {
         op(r)["at"] = {"Hips", "Hips"};
       },
       2, "listed twice"},
      {"scale 0", [&](json& r) { op(r)["place"]["scale"] = 0; }, 2, "above 0"},
      {"scale of a wrong kind", [&](json& r) { op(r)["place"]["scale"] = "big"; }, 2, "expected"},
      {"offset of two",
       [&](json& r) {
         op(r)["place"]["offset"] = {1, 2};
       },
       2, "three numbers"},
      {"blend unknown", [&](json& r) { op(r)["blend"] = "smoth"; }, 2, "smin"},
      {"radius of paper",
       [&](json& r) {
         op(r)["blend"] = {{"operator", "paper"}, {"radius", 1}};
       },
       2, "fillet"},
      {"hardness above 1",
       [](json& r) {
         r["surface"] = {{"hardness", 3}};
       },
       2, "0.9"},
      {"two voxel sizes",
       [](json& r) {
         r["surface"] = {{"voxel", 1}, {"voxel_factor", 1}};
       },
       2, "one of"},
      {"rate 0",
       [](json& r) {
         r["animation"] = {{"rate_hz", 0}};
       },
       2, "240"},
      {"clip unknown",
       [](json& r) {
         r["animation"] = {{"clips", {"Wolk"}}};
       },
       2, "nearest: \"Walk\""},
      {"five influences",
       [](json& r) {
         r["output"] = {{"influences", 5}};
       },
       2, "4 or 8"},
      {"output outside",
       [](json& r) {
         r["output"] = {{"glb", "../x.glb"}};
       },
       2, "inside the output folder"},
      {"output of another kind",
       [](json& r) {
         r["output"] = {{"glb", "x.fbx"}};
       },
       2, "must end in .glb"},
      {"absolute path", [](json& r) { r["inputs"]["human"] = "/human.glb"; }, 2, "relative"},
      {"an address", [](json& r) { r["inputs"]["human"] = "http://x/human.glb"; }, 2, "address"},
      {"no such file", [](json& r) { r["inputs"]["human"] = "humon.glb"; }, 3,
       "no such file (nearest: \"human.glb\""},
      {"joint unknown", [&](json& r) { op(r)["joint"] = "Tial1"; }, 2, "no joint"},
      {"truncated GLB", [](json& r) { r["inputs"]["human"] = "short.glb"; }, 3, "file has 20000"},
      {"text as GLB", [](json& r) { r["inputs"]["human"] = "text.glb"; }, 3, "text.glb: not a GLB file"},
      {"empty range",
       [](json& r) {
         r["expect"] = {{"joints", {{"min", 9}, {"max", 3}}}};
       },
       2, "above"},
  };
}

// A hint is what was expected and found, the nearest word, an example, or what to do.
constexpr const char* kHint = "expected .+, found |\\(nearest: \"|, such as |; |must |\\(this tool reads ";

// Thirty faults: each has its status, its id, one line with the place, the cause and a hint.
TEST_F(GoalsOfFaults, Goal15ThirtyFaultsAreTold) {
  fs::copy_file(folder / "human.glb", folder / "short.glb");
  fs::resize_file(folder / "short.glb", 20000);
  std::ofstream(folder / "text.glb") << "no model";
  const auto faults = recipe_faults();
  EXPECT_GE(faults.size(), 30U);
  for (const Fault& fault : faults) {
    json bad = recipe;
    fault.change(bad);
    std::ofstream(folder / "bad.json") << bad.dump(1);
    const ProgramResult result = call({"check", "bad.json", "--cache", "cache", "--json"});
    EXPECT_EQ(result.status, fault.status) << fault.name << result.err;
    const json told = json::parse(result.out).at("recipes").at(0);
    EXPECT_EQ(told.value("id", ""), fault.status == 2 ? "recipe" : "bad-input") << fault.name << told;
    const std::string error = told.value("error", "");
    EXPECT_THAT(error, HasSubstr(fault.cause)) << fault.name;
    EXPECT_THAT(error, ContainsRegex("bad\\.json:[0-9]+:[0-9]+: ")) << fault.name;
    EXPECT_THAT(error, ContainsRegex(kHint)) << fault.name;
    EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 0) << fault.name;
  }
}

}  // namespace
}  // namespace skinforge
