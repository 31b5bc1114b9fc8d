// Clips of FBX files against two readers that are not ours. Both are programs that need not be there.
#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

#include "io/import.h"
#include "testing/assets.h"
#include "testing/gltf_evaluator.h"
#include "testing/posed_points.h"
#include "testing/temporary_folder.h"

namespace skinforge {
namespace {

namespace fs = std::filesystem;
using testing::CharacterPlayer;

constexpr double kColor = 1e-6;      // floats on both sides
constexpr double kReference = 1e-4;  // of the diagonal: two readers, float keys, other orders of products
/// FBX2glTF 0.9.7 writes inverse bind matrices for man and woman that differ by up to 0.8 degrees from the
/// Transform of the file's clusters, which times TransformLink gives the mesh node's transform to 1e-4 for
/// every joint. Blender agrees with the file.
constexpr double kTurnedBinds = 3e-3;

std::optional<std::string> fbx2gltf() {
  if (const char* path = std::getenv("SKINFORGE_FBX2GLTF")) return std::string(path);
  const std::string installed =
      testing::repository_file("build/node/node_modules/fbx2gltf/bin/Linux/FBX2glTF");
  if (fs::exists(installed)) return installed;
  return std::nullopt;
}

/// The file as a GLB, made by FBX2glTF.
std::string converted(const std::string& tool, const std::string& fbx, const fs::path& glb) {
  const std::string command =
      "timeout 120 '" + tool + "' -b -i '" + fbx + "' -o '" + glb.string() + "' > /dev/null 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  return glb.string();
}

std::string short_name(const std::string& name) {
  const auto bar = name.rfind('|');
  return bar == std::string::npos ? name : name.substr(bar + 1);
}

/// FBX2glTF keeps the four largest influences of a vertex.
Character with_four_influences(Character character) {
  SkinWeights weights;
  for (std::size_t v = 0; v < character.mesh.vertex_count(); ++v) {
    const auto row = character.weights.of(VertexId(v));
    weights.push_row(normalised_row({row.begin(), row.end()}, 4));
  }
  character.weights = weights;
  return character;
}

/// The animation of that name, with or without what stands before the bar; none when FBX2glTF left it out.
std::optional<int> animation_of(const testing::GltfEvaluator& file, const std::string& clip) {
  for (int a = 0; a < file.animation_count(); ++a)
    if (file.animation_name(a) == clip || short_name(file.animation_name(a)) == clip) return a;
  return std::nullopt;
}

/// Compares all clips at times on FBX2glTF's own keys; returns how many.
std::size_t compare(const std::string& asset, double tolerance) {
  const std::string path = testing::shared_file("assets/" + asset);
  const testing::TemporaryFolder folder;
  const testing::GltfEvaluator file(converted(*fbx2gltf(), path, folder / "reference.glb"));
  IssueSink issues;
  const Character character = with_four_influences(import_character(path, issues));
  const CharacterPlayer player(character);
  std::size_t compared = 0;
  for (const Clip& clip : character.clips) {
    const auto animation = animation_of(file, clip.name);
    if (!animation) continue;
    ++compared;
    const double frames = std::floor(clip.duration * 24 + 1e-6);
    for (const double part : {0.0, 0.2, 0.5, 0.8, 1.0}) {
      const double time = std::round(part * frames) / 24;
      EXPECT_LT(testing::set_distance(player.pose(clip, time), file.pose(*animation, time)),
                tolerance * character.mesh.diagonal())
          << asset << " " << clip.name << " at " << time;
    }
  }
  return compared;
}

#define SKINFORGE_NEEDS_FBX2GLTF() \
  if (!fbx2gltf()) GTEST_SKIP() << "FBX2GLTF ABSENT: set SKINFORGE_FBX2GLTF to its program (npm fbx2gltf)"

TEST(FbxReference, PlaysAsFbx2gltf) {
  SKINFORGE_NEEDS_SHARED();
  SKINFORGE_NEEDS_FBX2GLTF();
  EXPECT_EQ(compare("quaternius_dragon/dragon.fbx", kReference), 5u);
  EXPECT_EQ(compare("quaternius_eagle/eagle.fbx", kReference), 2u);  // the third drives no joint
  EXPECT_EQ(compare("quaternius_man/man.fbx", kTurnedBinds), 8u);    // the ninth lasts one frame
  EXPECT_EQ(compare("quaternius_woman/woman.fbx", kTurnedBinds), 10u);
}

TEST(FbxReference, CubicKeysPlayAsFbx2gltf) {
  SKINFORGE_NEEDS_SHARED();
  SKINFORGE_NEEDS_FBX2GLTF();
  const std::string folder = "conf_fbx_max_transformed_skin/max_transformed_skin_7500_";
  EXPECT_EQ(compare(folder + "ascii.fbx", kReference), 1u);
  EXPECT_EQ(compare(folder + "binary.fbx", kReference), 1u);
}

/// Base colours by material, of a file made by FBX2glTF.
std::map<std::string, std::vector<double>> base_colors(const nlohmann::json& gltf) {
  std::map<std::string, std::vector<double>> colors;
  for (const auto& material : gltf["materials"])
    colors[material["name"]] = material["pbrMetallicRoughness"]["baseColorFactor"].get<std::vector<double>>();
  return colors;
}

TEST(FbxReference, BaseColoursAsFbx2gltf) {
  SKINFORGE_NEEDS_SHARED();
  SKINFORGE_NEEDS_FBX2GLTF();
  for (const std::string asset :
       {"quaternius_dragon/dragon.fbx", "quaternius_eagle/eagle.fbx", "quaternius_man/man.fbx"}) {
    SCOPED_TRACE(asset);
    const std::string path = testing::shared_file("assets/" + asset);
    const testing::TemporaryFolder folder;
    const testing::GltfEvaluator file(converted(*fbx2gltf(), path, folder / "reference.glb"));
    const auto wanted = base_colors(file.json());
    IssueSink issues;
    const Character character = import_character(path, issues);
    ASSERT_EQ(character.materials.size(), wanted.size());
    for (const Material& m : character.materials)
      for (int i = 0; i < 4; ++i)
        EXPECT_NEAR(m.base_color[i], wanted.at(m.name)[static_cast<std::size_t>(i)], kColor) << m.name;
  }
}

/// Positions by clip and frame, as evaluate_fbx.py prints them.
using Frames = std::map<std::pair<std::string, int>, std::vector<Vec3>>;

Frames read_frames(const fs::path& path) {
  Frames frames;
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    std::string clip, frame, x, y, z;
    std::getline(fields, clip, '\t');
    std::getline(fields, frame, '\t');
    fields >> x >> y >> z;
    frames[{short_name(clip), std::stoi(frame)}].emplace_back(std::stod(x), std::stod(y), std::stod(z));
  }
  return frames;
}

TEST(FbxReference, PlaysAsBlender) {
  SKINFORGE_NEEDS_SHARED();
  if (std::system("command -v blender > /dev/null 2>&1") != 0) GTEST_SKIP() << "BLENDER ABSENT";
  for (const char* asset : {"quaternius_man/man.fbx", "quaternius_woman/woman.fbx"}) {
    const std::string path = testing::shared_file(std::string("assets/") + asset);
    const testing::TemporaryFolder folder;
    const std::string output = (folder / "frames.txt").string();
    const std::string command = "timeout 300 blender --background -t 1 --python '" +
                                testing::repository_file("tests/io/evaluate_fbx.py") + "' -- '" + path +
                                "' '" + output + "' > /dev/null 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
    IssueSink issues;
    const Character character = import_character(path, issues);
    const CharacterPlayer player(character);
    const Frames frames = read_frames(output);
    std::size_t compared = 0;
    for (const auto& [key, points] : frames)
      for (const Clip& clip : character.clips) {
        if (clip.name != key.first) continue;
        ++compared;
        EXPECT_LT(testing::set_distance(player.pose(clip, key.second / 24.0), points),
                  kReference * character.mesh.diagonal())
            << asset << " " << clip.name << " frame " << key.second;
      }
    EXPECT_EQ(compared, 3 * character.clips.size());
  }
}

}  // namespace
}  // namespace skinforge
