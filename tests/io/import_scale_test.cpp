// The scale law: a file with all its lengths multiplied imports to the same character, as much larger.
#include <gmock/gmock.h>

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "io/import.h"
#include "testing/assets.h"
#include "testing/glb_file.h"

namespace skinforge {
namespace {

using Json = nlohmann::json;

constexpr double kFloat = 1e-6;  // the multiplied lengths are rounded to floats again

struct Glb {
  Json json;
  Bytes binary;
};

Glb open_glb(const std::string& path) {
  const Bytes bytes = read_input_file(path).bytes;
  const auto word = [&](std::size_t at) {
    std::uint32_t value;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return std::size_t{value};
  };
  const std::size_t json_size = word(12), begin = 20 + json_size + 8;
  const auto* text = reinterpret_cast<const char*>(bytes.data()) + 20;
  return {
      Json::parse(text, text + json_size),
      Bytes(bytes.begin() + std::ptrdiff_t(begin), bytes.begin() + std::ptrdiff_t(begin + word(begin - 8)))};
}

/// Multiplies numbers `first` to `last` of each element of a float accessor.
void scale_accessor(Glb& glb, std::size_t id, std::size_t first, std::size_t last, std::size_t width,
                    double factor) {
  Json& accessor = glb.json["accessors"][id];
  ASSERT_EQ(accessor["componentType"], 5126);
  ASSERT_FALSE(accessor.contains("sparse"));
  const Json& view = glb.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  const std::size_t stride = view.value("byteStride", 4 * width);
  const std::size_t begin =
      view.value("byteOffset", std::size_t{0}) + accessor.value("byteOffset", std::size_t{0});
  std::vector<float> low(width, 1e30f), high(width, -1e30f);
  for (std::size_t i = 0; i < accessor["count"].get<std::size_t>(); ++i)
    for (std::size_t c = 0; c < width; ++c) {
      std::byte* at = glb.binary.data() + begin + i * stride + 4 * c;
      float value;
      std::memcpy(&value, at, sizeof value);
      if (c >= first && c < last) value = static_cast<float>(value * factor);
      std::memcpy(at, &value, sizeof value);
      low[c] = std::min(low[c], value);
      high[c] = std::max(high[c], value);
    }
  if (accessor.contains("min")) accessor["min"] = low;
  if (accessor.contains("max")) accessor["max"] = high;
}

void scale_nodes(Json& nodes, double factor) {
  for (Json& node : nodes) {
    if (node.contains("translation"))
      for (Json& value : node["translation"]) value = value.get<double>() * factor;
    if (node.contains("matrix"))
      for (std::size_t i : {12, 13, 14}) node["matrix"][i] = node["matrix"][i].get<double>() * factor;
  }
}

/// Accessors of positions and translations.
std::set<std::size_t> length_accessors(const Json& json) {
  std::set<std::size_t> ids;
  for (const Json& mesh : json["meshes"])
    for (const Json& primitive : mesh["primitives"]) {
      ids.insert(primitive["attributes"]["POSITION"].get<std::size_t>());
      for (const Json& target : primitive.value("targets", Json::array()))
        ids.insert(target["POSITION"].get<std::size_t>());
    }
  for (const Json& animation : json.value("animations", Json::array()))
    for (const Json& channel : animation["channels"])
      if (channel["target"]["path"] == "translation")
        ids.insert(animation["samplers"][channel["sampler"].get<std::size_t>()]["output"].get<std::size_t>());
  return ids;
}

Bytes scaled(Glb glb, double factor) {
  for (const std::size_t id : length_accessors(glb.json)) scale_accessor(glb, id, 0, 3, 3, factor);
  std::set<std::size_t> binds;
  for (const Json& skin : glb.json["skins"]) binds.insert(skin["inverseBindMatrices"].get<std::size_t>());
  for (const std::size_t id : binds) scale_accessor(glb, id, 12, 15, 16, factor);
  scale_nodes(glb.json["nodes"], factor);
  return testing::glb_bytes(glb.json.dump(), glb.binary);
}

Character imported(Bytes bytes, IssueSink& issues) {
  return build_character(read_scene(testing::as_input("file.glb", std::move(bytes))), "file.glb", issues);
}

std::vector<std::pair<std::string, std::string>> told(const IssueSink& issues) {
  std::vector<std::pair<std::string, std::string>> list;
  for (const Issue& issue : issues.issues()) list.emplace_back(issue.code, issue.message);
  return list;
}

void expect_scaled(const std::vector<Vec3>& a, const std::vector<Vec3>& b, double factor, double size) {
  ASSERT_EQ(a.size(), b.size());
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, (factor * a[i] - b[i]).norm());
  EXPECT_LT(worst, kFloat * factor * size);
}

void expect_same_mesh(const Character& a, const Character& b, double factor) {
  expect_scaled(a.mesh.positions, b.mesh.positions, factor, a.mesh.diagonal());
  ASSERT_EQ(a.mesh.face_count(), b.mesh.face_count());
  for (std::size_t f = 0; f < a.mesh.face_count(); ++f) {
    const auto of_a = a.mesh.face(FaceId(f)), of_b = b.mesh.face(FaceId(f));
    ASSERT_TRUE(std::equal(of_a.begin(), of_a.end(), of_b.begin(), of_b.end())) << f;
  }
  EXPECT_EQ(to_bytes(a.weights), to_bytes(b.weights));
  ASSERT_EQ(a.morphs.size(), b.morphs.size());
  for (std::size_t m = 0; m < a.morphs.size(); ++m)
    expect_scaled(a.morphs[m].offsets, b.morphs[m].offsets, factor, a.mesh.diagonal());
}

void expect_same_skeleton(const Character& a, const Character& b, double factor) {
  ASSERT_EQ(a.skeleton.names(), b.skeleton.names());
  const double size = a.mesh.diagonal();
  for (std::size_t j = 0; j < a.skeleton.size(); ++j) {
    const Joint &of_a = a.skeleton.joints[j], &of_b = b.skeleton.joints[j];
    EXPECT_EQ(of_a.parent, of_b.parent);
    const Affine3 bind_a = of_a.joint_from_model.inverse(), bind_b = of_b.joint_from_model.inverse();
    EXPECT_LT((factor * bind_a.translation() - bind_b.translation()).norm(), kFloat * factor * size)
        << of_a.name;
    EXPECT_LT((bind_a.linear() - bind_b.linear()).norm(), kFloat * bind_a.linear().norm()) << of_a.name;
  }
}

void expect_same_clips(const Character& a, const Character& b, double factor) {
  ASSERT_EQ(a.clips.size(), b.clips.size());
  for (std::size_t c = 0; c < a.clips.size(); ++c) {
    ASSERT_EQ(a.clips[c].joints.size(), b.clips[c].joints.size()) << a.clips[c].name;
    for (std::size_t j = 0; j < a.clips[c].joints.size(); ++j) {
      const JointTracks &of_a = a.clips[c].joints[j], &of_b = b.clips[c].joints[j];
      EXPECT_EQ(of_a.joint, of_b.joint);
      EXPECT_EQ(of_a.translation.times, of_b.translation.times);
      EXPECT_EQ(of_a.rotation.times, of_b.rotation.times);
      EXPECT_EQ(of_a.scale.times, of_b.scale.times);
      double size = 0;
      for (const Vec3& v : of_a.translation.values) size = std::max(size, v.norm());
      if (size > 0) expect_scaled(of_a.translation.values, of_b.translation.values, factor, size);
    }
  }
}

class ImportScale : public ::testing::TestWithParam<const char*> {};

TEST_P(ImportScale, TheSameCharacterAsMuchLarger) {
  SKINFORGE_NEEDS_SHARED();
  const Glb glb = open_glb(testing::shared_file(std::string("assets/") + GetParam()));
  IssueSink plain_issues;
  const Character plain = imported(scaled(glb, 1), plain_issues);
  for (const double factor : {1e-4, 0.01, 100.0}) {
    SCOPED_TRACE(factor);
    IssueSink issues;
    const Character other = imported(scaled(glb, factor), issues);
    EXPECT_EQ(told(issues), told(plain_issues));
    expect_same_mesh(plain, other, factor);
    expect_same_skeleton(plain, other, factor);
    expect_same_clips(plain, other, factor);
  }
}

INSTANTIATE_TEST_SUITE_P(Assets, ImportScale,
                         ::testing::Values("quaternius_horse/horse.glb", "quaternius_dolphin/dolphin.glb",
                                           "quaternius_trex/trex.glb", "khronos_fox/fox.glb",
                                           "kaykit_knight/knight.glb",
                                           "quaternius_robot_expressive/robot_expressive.glb",
                                           "quaternius_woman_adventurer_nan/adventurer_nan.glb"),
                         [](const auto& instance) {
                           const std::string name = instance.param;
                           return name.substr(0, name.find('/'));
                         });

}  // namespace
}  // namespace skinforge
