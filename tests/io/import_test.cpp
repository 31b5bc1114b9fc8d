// All shared assets, against their manifest (measured with other readers) and a second glTF player.
#include "io/import.h"

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "base/archive.h"
#include "testing/assets.h"
#include "testing/gltf_evaluator.h"
#include "testing/posed_points.h"

namespace skinforge {
namespace {

using Json = nlohmann::json;
using testing::CharacterPlayer;

constexpr double kManifest = 1e-3;  // of the diagonal; the manifest has four decimals
constexpr double kPlayed = 1e-6;    // of the diagonal; float bind matrices against their inverses
constexpr double kBind = 5e-6;      // of the diagonal; a bind pose snapped to the file's default pose

Json manifest() {
  std::ifstream file(testing::shared_file("assets/MANIFEST.json"));
  return Json::parse(file)["assets"];
}

std::string file_of(const Json& asset, const std::string& name) {
  return testing::shared_file("assets/" + asset["id"].get<std::string>() + "/" + name);
}

std::string main_file(const Json& asset) {
  return file_of(asset, asset["main"]);
}

/// All files of an asset that are models of their own.
std::vector<std::string> model_files(const Json& asset) {
  std::vector<std::string> paths;
  for (const Json& file : asset["files"])
    if (const std::string name = file["name"]; !name.ends_with(".bin")) paths.push_back(file_of(asset, name));
  return paths;
}

Vec3 box_size(const std::vector<Vec3>& points) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : points) box.extend(p);
  return box.sizes();
}

Vec3 to_vec3(const Json& numbers) {
  return {numbers[0].get<double>(), numbers[1].get<double>(), numbers[2].get<double>()};
}

/// The vertices that faces of a part use.
std::set<VertexId> vertices_of(const Character& character, std::size_t part) {
  std::set<VertexId> vertices;
  const PolygonMesh& mesh = character.mesh;
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    if (mesh.face_part[f].index() == part)
      for (const VertexId v : mesh.face(FaceId(f))) vertices.insert(v);
  return vertices;
}

/// Two assets whose bind size the manifest measured otherwise: see RobotIsBoundInOnePose and
/// GeometricTransformOfASkinnedMesh.
bool is_measured_otherwise(const std::string& id) {
  return id == "quaternius_robot_expressive" || id == "conf_fbx_max_transformed_skin";
}

TEST(Import, BindSizesAreThoseOfTheManifest) {
  SKINFORGE_NEEDS_SHARED();
  std::size_t files = 0;
  for (const Json& asset : manifest())
    for (const std::string& path : model_files(asset)) {
      SCOPED_TRACE(path);
      ++files;
      IssueSink issues;
      const Character character = import_character(path, issues);
      if (is_measured_otherwise(asset["id"])) continue;
      const Vec3 wanted = to_vec3(asset["bind_size"]);
      EXPECT_LT((box_size(character.mesh.positions) - wanted).cwiseAbs().maxCoeff(),
                kManifest * wanted.norm());
    }
  EXPECT_EQ(manifest().size(), 17u);
  EXPECT_EQ(files, 18u);
}

TEST(Import, WeldedCountsAreThoseOfTheManifest) {
  SKINFORGE_NEEDS_SHARED();
  for (const Json& asset : manifest()) {
    SCOPED_TRACE(asset["id"].get<std::string>());
    IssueSink issues;
    const Character character = import_character(main_file(asset), issues);
    std::multiset<std::size_t> wanted, found;
    for (const Json& mesh : asset["meshes"]) wanted.insert(mesh["welded"].get<std::size_t>());
    for (std::size_t p = 0; p < character.mesh.parts.size(); ++p)
      found.insert(vertices_of(character, p).size());
    EXPECT_EQ(found, wanted);
  }
}

TEST(Import, AllFacesComeInExceptCollapsedOnes) {
  SKINFORGE_NEEDS_SHARED();
  for (const Json& asset : manifest()) {
    SCOPED_TRACE(asset["id"].get<std::string>());
    IssueSink issues;
    const Character character = import_character(main_file(asset), issues);
    std::size_t wanted = asset["totals"]["faces"];
    for (const Json& mesh : asset["meshes"]) wanted -= mesh["degenerate_faces"].get<std::size_t>();
    EXPECT_EQ(character.mesh.face_count(), wanted);
  }
}

TEST(Import, AllJointsOfTheManifestAreThere) {
  SKINFORGE_NEEDS_SHARED();
  for (const Json& asset : manifest()) {
    SCOPED_TRACE(asset["id"].get<std::string>());
    IssueSink issues;
    const Character character = import_character(main_file(asset), issues);
    for (const Json& name : asset["joint_names"])
      EXPECT_TRUE(character.skeleton.find(name.get<std::string>())) << name;
  }
}

TEST(Import, AllClipsComeInWithTheirLength) {
  SKINFORGE_NEEDS_SHARED();
  constexpr double kFrame = 1.0 / 24 + 1e-3;  // the manifest's own rounding of starts and ends, up to a frame
  for (const Json& asset : manifest()) {
    SCOPED_TRACE(asset["id"].get<std::string>());
    IssueSink issues;
    const Character character = import_character(main_file(asset), issues);
    ASSERT_EQ(character.clips.size(), asset["animations"].size());
    for (std::size_t c = 0; c < character.clips.size(); ++c)
      EXPECT_NEAR(character.clips[c].duration, asset["animations"][c]["duration"].get<double>(), kFrame)
          << character.clips[c].name;
  }
}

TEST(Import, TheBindPoseOfTheJointsLeavesTheMeshWhereItIs) {
  SKINFORGE_NEEDS_SHARED();
  for (const Json& asset : manifest()) {
    SCOPED_TRACE(asset["id"].get<std::string>());
    IssueSink issues;
    Character character = import_character(main_file(asset), issues);
    for (MorphTarget& target : character.morphs) target.default_weight = 0;
    const auto posed = CharacterPlayer(character).bind_pose();
    double worst = 0;
    for (std::size_t v = 0; v < posed.size(); ++v)
      worst = std::max(worst, (posed[v] - character.mesh.positions[v]).norm());
    EXPECT_LT(worst, kBind * character.mesh.diagonal());
  }
}

TEST(Import, ClipsOfGltfFilesPlayAsTheFileDoes) {
  SKINFORGE_NEEDS_SHARED();
  for (const Json& asset : manifest()) {
    if (asset["format"].get<std::string>().starts_with("fbx")) continue;
    IssueSink issues;
    const Character character = import_character(main_file(asset), issues);
    const CharacterPlayer player(character);
    const testing::GltfEvaluator file(main_file(asset));
    for (std::size_t c = 0; c < character.clips.size(); ++c) {
      SCOPED_TRACE(asset["id"].get<std::string>() + " " + character.clips[c].name);
      for (const double part : {0.0, 0.13, 0.41, 0.77, 1.0}) {
        const double time = part * character.clips[c].duration;
        EXPECT_LT(testing::set_distance(player.pose(character.clips[c], time), file.pose(int(c), time)),
                  kPlayed * character.mesh.diagonal())
            << "at " << time;
      }
    }
  }
}

// The manifest placed the robot's rigid parts where the file's default pose has them, and its skinned hands
// where they are bound. That mixture is not a pose; both halves of it can be checked.
TEST(Import, RobotIsBoundInOnePose) {
  SKINFORGE_NEEDS_SHARED();
  const std::string path = testing::shared_file("assets/quaternius_robot_expressive/robot_expressive.glb");
  RawScene scene = read_scene(read_input_files(path));
  scene.animations.push_back({"default pose", {}});
  IssueSink issues;
  const Character robot = build_character(scene, "robot", issues);
  const auto posed = CharacterPlayer(robot).pose(robot.clips.back(), 0);
  std::vector<Vec3> mixture;
  for (std::size_t p = 0; p < robot.mesh.parts.size(); ++p)
    for (const VertexId v : vertices_of(robot, p))
      mixture.push_back(robot.mesh.parts[p].name.starts_with("Hand") ? robot.mesh.positions[v.index()]
                                                                     : posed[v.index()]);
  const Vec3 wanted(6.6185, 4.4624, 2.6558);
  EXPECT_LT((box_size(mixture) - wanted).cwiseAbs().maxCoeff(), kManifest * wanted.norm());
}

// ufbx gives 60.5 x 55.3 x 20.2 cm for the default pose (design/assets.md, quirk 14, Y up here). The bind
// size of the manifest leaves the geometric transform out: it puts the box beside its bones, 50 cm off.
TEST(Import, GeometricTransformOfASkinnedMesh) {
  SKINFORGE_NEEDS_SHARED();
  for (const char* kind : {"ascii", "binary"}) {
    SCOPED_TRACE(kind);
    const std::string path = testing::shared_file(
        std::string("assets/conf_fbx_max_transformed_skin/max_transformed_skin_7500_") + kind + ".fbx");
    RawScene scene = read_scene(read_input_files(path));
    scene.animations.push_back({"default pose", {}});
    IssueSink issues;
    const Character box = build_character(scene, "box", issues);
    const Vec3 wanted(0.605, 0.553, 0.202);
    const Vec3 found = box_size(CharacterPlayer(box).pose(box.clips.back(), 0));
    EXPECT_LT((found - wanted).cwiseAbs().maxCoeff(), kManifest * wanted.norm()) << found.transpose();
    for (const Joint& joint : box.skeleton.joints) {  // the bones run inside the box they bend
      const Vec3 place = joint.joint_from_model.inverse().translation();
      Eigen::AlignedBox3d hull;
      for (const Vec3& p : box.mesh.positions) hull.extend(p);
      EXPECT_LT(hull.exteriorDistance(place), kManifest * wanted.norm()) << joint.name;
    }
  }
}

TEST(Import, FbxUnitsAndFramesAreSettled) {
  SKINFORGE_NEEDS_SHARED();
  IssueSink issues;
  const Character man = import_character(testing::shared_file("assets/quaternius_man/man.fbx"), issues);
  EXPECT_EQ(man.skeleton[JointId(0)].name, "Human Armature");
  EXPECT_NEAR(man.skeleton[JointId(0)].bind.scale.x(), 0.691827, 1e-6);  // 69.1827 centimetres a unit
  std::vector<std::string> names;
  for (const Clip& clip : man.clips) names.push_back(clip.name);
  EXPECT_THAT(names, ::testing::ElementsAre("ArmatureAction.001", "ArmatureAction.002", "Death", "Idle",
                                            "Jump", "Punch", "Run", "Walk", "Working"));
  ASSERT_EQ(man.materials.size(), 1u);
  EXPECT_EQ(man.materials[0].alpha_mode, AlphaMode::Opaque);
}

TEST(Import, NanWeightsAreFilledAndReported) {
  SKINFORGE_NEEDS_SHARED();
  IssueSink issues;
  import_character(testing::shared_file("assets/quaternius_woman_adventurer_nan/adventurer_nan.glb"), issues);
  std::set<std::string> codes;
  for (const Issue& issue : issues.issues()) codes.insert(issue.code);
  EXPECT_TRUE(codes.count("weights-not-finite"));
  EXPECT_TRUE(codes.count("weights-filled"));
}

TEST(Import, SameFileGivesSameBytes) {
  SKINFORGE_NEEDS_SHARED();
  for (const char* file : {"quaternius_dragon/dragon.fbx", "kaykit_knight/knight.glb"}) {
    IssueSink issues;
    const std::string path = testing::shared_file(std::string("assets/") + file);
    EXPECT_EQ(to_bytes(import_character(path, issues)), to_bytes(import_character(path, issues))) << file;
  }
}

}  // namespace
}  // namespace skinforge
