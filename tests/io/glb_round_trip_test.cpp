// Real characters: imported, written, imported again.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "io/export.h"
#include "io/import.h"
#include "testing/assets.h"
#include "testing/gltf_evaluator.h"
#include "testing/posed_points.h"
#include "testing/temporary_folder.h"

namespace skinforge {
namespace {

/// Skinning by float matrices of a chain of up to 12 joints, beside exact ones; of the diagonal.
constexpr double kFloatChain = 3e-6;

class GlbRoundTrip : public ::testing::TestWithParam<const char*> {
 protected:
  /// Once per asset; the FBX ones take a child process.
  void SetUp() override {
    SKINFORGE_NEEDS_SHARED();
    IssueSink issues;
    before_ = import_character(testing::shared_file("assets/" + std::string(GetParam())), issues);
    bytes_ = write_glb(before_);
    path_ = (folder_ / "character.glb").string();
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes_.data()), std::streamsize(bytes_.size()));
    after_ = import_character(path_, issues);
  }

  testing::TemporaryFolder folder_;
  Character before_, after_;
  Bytes bytes_;
  std::string path_;
};

using Corner = std::array<float, 3>;
using Polygon = std::vector<Corner>;

/// Polygons by the positions of their corners, each begun at its least corner, sorted.
std::vector<Polygon> polygons(const PolygonMesh& mesh) {
  std::vector<Polygon> list;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    Polygon polygon;
    for (const VertexId v : mesh.face(FaceId(f))) {
      const Eigen::Vector3f p = mesh.positions[v.index()].cast<float>();
      polygon.push_back({p.x(), p.y(), p.z()});
    }
    std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
    list.push_back(polygon);
  }
  std::sort(list.begin(), list.end());
  return list;
}

TEST_P(GlbRoundTrip, PolygonsJointsMaterialsAndImagesComeBack) {
  EXPECT_EQ(polygons(after_.mesh), polygons(before_.mesh));
  EXPECT_EQ(after_.skeleton.names(), before_.skeleton.names());
  for (std::size_t j = 0; j < before_.skeleton.size(); ++j) {
    const Joint &a = before_.skeleton.joints[j], &b = after_.skeleton.joints[j];
    EXPECT_EQ(a.parent, b.parent);
    EXPECT_EQ(a.joint_from_model.matrix().cast<float>(), b.joint_from_model.matrix().cast<float>()) << a.name;
  }
  ASSERT_EQ(after_.images.size(), before_.images.size());
  for (std::size_t i = 0; i < before_.images.size(); ++i)
    EXPECT_EQ(after_.images[i].bytes, before_.images[i].bytes);
  ASSERT_EQ(after_.materials.size(), before_.materials.size());
  for (std::size_t m = 0; m < before_.materials.size(); ++m) {
    EXPECT_EQ(after_.materials[m].name, before_.materials[m].name);
    EXPECT_EQ(after_.materials[m].base_color.cast<float>(), before_.materials[m].base_color.cast<float>());
  }
}

/// What stands on the corners of faces, a list of floats for each: position, UV sets, colour; sorted.
std::vector<std::vector<float>> corner_values(const PolygonMesh& mesh) {
  std::vector<std::vector<float>> list;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const MeshPart& part = mesh.parts[mesh.face_part[f].index()];
    for (std::size_t c = mesh.first_corner(FaceId(f)); c < mesh.first_corner(FaceId(f + 1)); ++c) {
      std::vector<float> values;
      const auto add = [&](const auto& vector) {
        for (const double value : vector) values.push_back(static_cast<float>(value));
      };
      add(mesh.positions[mesh.corners[c].index()]);
      for (int set = 0; set < part.uv_sets; ++set) add(mesh.uvs[static_cast<std::size_t>(set)][c]);
      if (part.has_colors) add(mesh.colors[c]);
      list.push_back(std::move(values));
    }
  }
  std::sort(list.begin(), list.end());
  return list;
}

TEST_P(GlbRoundTrip, UvsAndColoursComeBack) {
  EXPECT_EQ(corner_values(after_.mesh), corner_values(before_.mesh));
  EXPECT_EQ(after_.mesh.uvs.size(), before_.mesh.uvs.size());
}

/// Positions and offsets of a target, as floats, sorted.
std::vector<std::vector<float>> offsets(const Character& character, const MorphTarget& target) {
  std::vector<std::vector<float>> list;
  for (std::size_t i = 0; i < target.vertices.size(); ++i) {
    const Eigen::Vector3f p = character.mesh.positions[target.vertices[i].index()].cast<float>();
    const Eigen::Vector3f o = target.offsets[i].cast<float>();
    list.push_back({p.x(), p.y(), p.z(), o.x(), o.y(), o.z()});
  }
  std::sort(list.begin(), list.end());
  return list;
}

TEST_P(GlbRoundTrip, MorphTargetsComeBack) {
  ASSERT_EQ(after_.morphs.size(), before_.morphs.size());
  for (std::size_t m = 0; m < before_.morphs.size(); ++m) {
    const MorphTarget &a = before_.morphs[m], &b = after_.morphs[m];
    EXPECT_EQ(b.name, a.name);
    EXPECT_EQ(static_cast<float>(b.default_weight), static_cast<float>(a.default_weight)) << a.name;
    EXPECT_THAT(after_.mesh.parts[b.part.index()].name,  // "_mesh" behind it where a joint has the name
                ::testing::StartsWith(before_.mesh.parts[a.part.index()].name));
    EXPECT_EQ(offsets(after_, b), offsets(before_, a)) << a.name;
  }
}

Character with_four_influences(Character character) {
  SkinWeights weights;
  for (std::size_t v = 0; v < character.mesh.vertex_count(); ++v) {
    const auto row = character.weights.of(VertexId(v));
    weights.push_row(normalised_row({row.begin(), row.end()}, 4));
  }
  character.weights = weights;
  return character;
}

// All skins, weights, morph targets and keys at once.
TEST_P(GlbRoundTrip, ClipsMoveTheMeshAsBefore) {
  const Character before = with_four_influences(before_);
  const testing::CharacterPlayer first(before), second(after_);
  ASSERT_EQ(after_.clips.size(), before_.clips.size());
  for (std::size_t c = 0; c < before_.clips.size(); ++c)
    for (const double part : {0.0, 0.37, 1.0}) {
      const double time = part * before_.clips[c].duration;
      EXPECT_LT(testing::set_distance(first.pose(before_.clips[c], time), second.pose(after_.clips[c], time)),
                kFloatChain * before_.mesh.diagonal())
          << before_.clips[c].name << " at " << time;
    }
}

template <class Value>
void expect_same_keys(const Track<Value>& a, const Track<Value>& b, const std::string& where) {
  EXPECT_EQ(a.interpolation, b.interpolation) << where;
  ASSERT_EQ(a.times.size(), b.times.size()) << where;
  for (std::size_t k = 0; k < a.times.size(); ++k)
    ASSERT_EQ(static_cast<float>(a.times[k]), static_cast<float>(b.times[k])) << where;
  for (std::size_t k = 0; k < a.values.size(); ++k) {
    if constexpr (std::is_same_v<Value, Quat>)
      ASSERT_EQ(a.values[k].coeffs().template cast<float>(), b.values[k].coeffs().template cast<float>())
          << where;
    else
      ASSERT_EQ(a.values[k].template cast<float>(), b.values[k].template cast<float>()) << where;
  }
}

TEST_P(GlbRoundTrip, KeysComeBackToTheBitOfAFloat) {
  ASSERT_EQ(after_.clips.size(), before_.clips.size());
  for (std::size_t c = 0; c < before_.clips.size(); ++c) {
    const Clip &a = before_.clips[c], &b = after_.clips[c];
    EXPECT_EQ(a.name, b.name);
    ASSERT_EQ(a.joints.size(), b.joints.size()) << a.name;
    for (std::size_t j = 0; j < a.joints.size(); ++j) {
      const std::string where = a.name + " " + before_.skeleton[a.joints[j].joint].name;
      EXPECT_EQ(a.joints[j].joint, b.joints[j].joint) << where;
      expect_same_keys(a.joints[j].translation, b.joints[j].translation, where);
      expect_same_keys(a.joints[j].rotation, b.joints[j].rotation, where);
      expect_same_keys(a.joints[j].scale, b.joints[j].scale, where);
    }
  }
}

TEST_P(GlbRoundTrip, TheSecondWritingGivesTheSameSizeOfEverything) {
  const Bytes again = write_glb(after_);
  const testing::TemporaryFolder folder;
  const std::string path = (folder / "again.glb").string();
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(again.data()), std::streamsize(again.size()));
  const auto first = testing::GltfEvaluator(path_).json(), second = testing::GltfEvaluator(path).json();
  for (const char* table : {"nodes", "meshes", "skins", "animations", "materials"})
    EXPECT_EQ(first.value(table, nlohmann::json::array()).size(),
              second.value(table, nlohmann::json::array()).size())
        << table;
}

TEST_P(GlbRoundTrip, TheDefaultPoseOfTheFileIsTheBindPose) {
  Character still = before_;
  still.morphs.clear();
  const Bytes bytes = write_glb(still);
  const std::string path = (folder_ / "still.glb").string();
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  const testing::GltfEvaluator file(path);
  const auto bind = file.bind_pose(), pose = file.default_pose();
  ASSERT_EQ(bind.size(), pose.size());
  double largest = 0;
  for (std::size_t v = 0; v < bind.size(); ++v) largest = std::max(largest, (bind[v] - pose[v]).norm());
  EXPECT_LE(largest, kFloatChain * before_.mesh.diagonal());
}

INSTANTIATE_TEST_SUITE_P(Assets, GlbRoundTrip,
                         ::testing::Values("conf_morph_cube/AnimatedMorphCube.gltf",
                                           "conf_interpolation/interpolation_test.gltf",
                                           "quaternius_woman/woman.fbx", "kaykit_knight/knight.glb",
                                           "khronos_cesium_man/cesium_man.gltf", "khronos_fox/fox.glb",
                                           "quaternius_horse/horse.glb",
                                           "quaternius_robot_expressive/robot_expressive.glb",
                                           "quaternius_woman_adventurer_nan/adventurer_nan.glb",
                                           "quaternius_dragon/dragon.fbx", "quaternius_man/man.fbx"),
                         [](const auto& instance) {
                           const std::string name = instance.param;
                           return name.substr(0, name.find('/'));
                         });

}  // namespace
}  // namespace skinforge
