// Broken and odd files: what must be refused is refused in one line, what is valid is read.
#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "base/error.h"
#include "io/gltf_reader.h"
#include "testing/assets.h"

namespace skinforge {
namespace {

enum class Verdict { Reject, Accept, AcceptWarn };

struct Outcome {
  Verdict verdict = Verdict::Reject;
  std::string message;
};

Outcome read(const std::string& path) {
  try {
    const RawScene scene = read_gltf(read_input_files(path));
    for (const Issue& issue : scene.issues)
      if (issue.severity == Severity::Warning) return {Verdict::AcceptWarn, issue.message};
    return {Verdict::Accept, ""};
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::BadInput) << path;
    return {Verdict::Reject, error.what()};
  }
}

/// Cases whose fault is no fault of the file format: `build_character` notices them.
const std::set<std::string> kLeftToTheBuild = {
    "gen/geometry/triangles_duplicate.glb", "gen/geometry/pos_1e38.glb",
    "gen/geometry/pos_all_equal.glb",       "gen/geometry/normals_zero.glb",
    "gen/nodes/scale_negative.glb",         "gen/nodes/scale_zero.glb",
    "gen/nodes/bone_zero_length.glb",       "gen/nodes/names_duplicate_two.glb",
    "gen/skin/weights_sum_half.glb",        "gen/skin/weights_all_zero.glb",
    "gen/skin/weights_negative.glb",        "gen/skin/influences_8.glb"};

bool is_as_expected(Verdict verdict, const std::string& expect, bool left_to_the_build) {
  if (left_to_the_build) return verdict == Verdict::Accept;
  if (expect == "reject") return verdict == Verdict::Reject;
  if (expect == "accept") return verdict == Verdict::Accept;
  if (expect == "accept-warn") return verdict == Verdict::AcceptWarn;
  return expect == "reject-or-warn" && verdict != Verdict::Accept;
}

TEST(GltfHostile, EveryCaseGetsItsVerdict) {
  SKINFORGE_NEEDS_SHARED();
  const auto index = nlohmann::json::parse(std::ifstream(testing::shared_file("hostile/index.json")));
  int seen = 0;
  for (const auto& entry : index) {
    const std::string kind = entry["kind"], file = entry["file"], expect = entry["expect"];
    if (kind != "glb" && kind != "gltf") continue;
    ++seen;
    const std::string path = testing::shared_file("hostile/" + file);
    const Outcome outcome = read(path);
    if (outcome.verdict == Verdict::Reject) {
      EXPECT_TRUE(outcome.message.starts_with(path + ": ")) << outcome.message;
      EXPECT_EQ(outcome.message.find('\n'), std::string::npos) << outcome.message;
    }
    EXPECT_TRUE(is_as_expected(outcome.verdict, expect, kLeftToTheBuild.contains(file)))
        << file << " is to be " << expect << ": " << outcome.message;
  }
  EXPECT_EQ(seen, 148);
}

TEST(GltfHostile, NormalisedIntegersReadAsTheFloatsTheyStandFor) {
  SKINFORGE_NEEDS_SHARED();
  const auto scene = [](const char* file) {
    return read_gltf(read_input_files(testing::shared_file(std::string("hostile/gen/") + file)));
  };
  const RawScene floats = scene("assets/base_a.glb"), weights = scene("control/valid_weights_u16.glb"),
                 turned = scene("control/valid_rotation_s16.glb");
  const auto& a = floats.meshes[0].primitives[0].weight_value;
  const auto& b = weights.meshes[0].primitives[0].weight_value;
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1.0 / 65535);
  ASSERT_EQ(floats.animations.size(), turned.animations.size());
  for (std::size_t n = 0; n < floats.animations[0].nodes.size(); ++n) {
    const auto& keys = floats.animations[0].nodes[n].rotation.values;
    for (std::size_t k = 0; k < keys.size(); ++k)
      EXPECT_LE((keys[k].coeffs() - turned.animations[0].nodes[n].rotation.values[k].coeffs()).norm(),
                2.0 / 32767);
  }
}

/// Random damage must end in a scene or in an error, never in anything else; the sanitisers of the dev preset
/// watch.
TEST(GltfHostile, RandomDamageNeverDoesWorseThanAnError) {
  SKINFORGE_NEEDS_SHARED();
  const std::vector<InputFile> sound =
      read_input_files(testing::shared_file("hostile/gen/assets/base_a.glb"));
  std::mt19937 random(20);
  int refused = 0;
  for (int round = 0; round < 3000; ++round) {
    std::vector<InputFile> files = sound;
    Bytes& bytes = files[0].bytes;
    for (unsigned k = 0; k <= random() % 4; ++k)
      bytes[random() % bytes.size()] ^= static_cast<std::byte>(1u << random() % 8);
    try {
      read_gltf(files);
    } catch (const Error& error) {
      ASSERT_EQ(error.code(), ExitCode::BadInput) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(refused, 300);  // most bytes of the file are vertex data, where a flip is a legal value
}

}  // namespace
}  // namespace skinforge
