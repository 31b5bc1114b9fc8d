#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include "animation/sampling.h"
#include "io/export.h"
#include "skinning/linear_blend.h"
#include "stages/corrective_bake.h"
#include "stages/rig_tables.h"
#include "testing/assets.h"
#include "testing/gltf_evaluator.h"
#include "testing/temporary_folder.h"
#include "testing/toy_character.h"

namespace skinforge {
namespace {

InputFile course_file(const std::string& name) {
  return read_input_file(testing::shared_file("assignment6/" + name));
}

/// A character of the course, bound by its own handles; only every `step`th key of its clip is kept.
Rigged course_character(const std::string& folder, std::size_t step) {
  RigFiles files{.model = {course_file(folder + "/rest.obj")},
                 .skeleton = {course_file(folder + "/skeleton.tgf")}};
  files.handles = {course_file(folder + "/handles.dmat")};
  files.clips = {{course_file(folder + "/pose.dmat")}};
  RecipeBind bind;
  bind.handles = RecipeHandles::Labels;
  IssueSink issues;
  Rigged rigged = read_rigged(files, bind, issues);
  for (JointTracks& tracks : rigged.character.clips[0].joints) {
    QuatTrack kept;
    for (std::size_t i = 0; i < tracks.rotation.times.size(); i += step) {
      kept.times.push_back(static_cast<double>(kept.times.size()) / 30);
      kept.values.push_back(tracks.rotation.values[i]);
    }
    rigged.character.clips[0].duration = kept.times.back();
    tracks.rotation = std::move(kept);
  }
  return rigged;
}

/// Vertex of the character that each point of the file shows, found by its float position.
std::vector<std::size_t> shown_vertices(const Character& character, const testing::GltfEvaluator& file) {
  std::map<std::array<float, 3>, std::size_t> at;
  const auto key = [](const Vec3& p) {
    return std::array{static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
  };
  for (std::size_t v = 0; v < character.mesh.vertex_count(); ++v) at[key(character.mesh.positions[v])] = v;
  std::vector<std::size_t> shown;
  for (const Vec3& p : file.bind_pose()) shown.push_back(at.at(key(p)));
  return shown;
}

/// Writes the character with correctives, plays the file by an evaluator that shares no code with the tool,
/// and returns the largest distance from the method itself over all keys, in shares of the diagonal.
double replayed_error(Character character, const BakeRequest& request) {
  IssueSink issues;
  const Character plain = character;
  const BakedCorrectives baked = bake_character(character, request, "test", issues);
  add_correctives(character, baked);
  validate(character);
  const testing::TemporaryFolder folder;
  const std::string path = (folder / "baked.glb").string();
  const Bytes glb = write_glb(character, {.max_influences = request.influences, .extras_json = {}});
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(glb.data()), static_cast<std::streamsize>(glb.size()));
  const testing::GltfEvaluator file(path);
  const auto shown = shown_vertices(character, file);
  DeformOptions options;
  for (const PosedShape& example : request.examples)
    options.examples.push_back({example.shape, posed_bones(plain.skeleton, example.pose)});
  const Deformer deformer(plain.mesh, plain.skeleton, plain.weights, request.method, options, "test", issues);
  double largest = 0;
  const Clip& clip = plain.clips[0];
  for (const double time : clip.joints[0].rotation.times) {
    const auto goal = deformer(posed_bones(plain.skeleton, sample(plain.skeleton, clip, time)));
    const auto played = file.pose(0, static_cast<double>(static_cast<float>(time)));
    for (std::size_t i = 0; i < played.size(); ++i)
      largest = std::max(largest, (played[i] - goal[shown[i]]).norm());
  }
  return largest / plain.mesh.diagonal();
}

// The bars of the toolkit: hand, 34 frames; human, 27 frames.
TEST(Correctives, HandByDualQuaternions) {
  SKINFORGE_NEEDS_SHARED();
  const Rigged hand = course_character("hand", 1);
  EXPECT_LT(
      replayed_error(hand.character,
                     {.method = DeformMethod::DualQuaternion, .targets = 4, .enough = 0, .influences = 8}),
      1e-4);
}

TEST(Correctives, HandByPoissonStitching) {
  SKINFORGE_NEEDS_SHARED();
  const Rigged hand = course_character("hand", 1);
  EXPECT_LT(replayed_error(hand.character,
                           {.method = DeformMethod::Poisson, .targets = 6, .enough = 0, .influences = 8}),
            2e-4);
}

TEST(Correctives, HumanClip) {
  SKINFORGE_NEEDS_SHARED();
  const Rigged human = course_character("context-aware", 15);
  for (const DeformMethod method : {DeformMethod::DualQuaternion, DeformMethod::Poisson})
    EXPECT_LT(
        replayed_error(human.character, {.method = method, .targets = 16, .enough = 0, .influences = 8}),
        5e-4);
}

// The clip as it is, 394 frames of which 154 differ, measured half way between keys as well.
TEST(Correctives, WholeClipOfTheHuman) {
  SKINFORGE_NEEDS_SHARED();
  const Rigged human = course_character("context-aware", 1);
  const double diagonal = human.character.mesh.diagonal();
  for (const DeformMethod method : {DeformMethod::DualQuaternion, DeformMethod::Poisson}) {
    IssueSink issues;
    const BakedCorrectives baked = bake_character(
        human.character, {.method = method, .targets = 16, .enough = 0, .influences = 8}, "test", issues);
    EXPECT_LT(baked.largest, 5e-4 * diagonal) << name_of(method);
    EXPECT_LT(baked.between, 5e-4 * diagonal) << name_of(method);
    EXPECT_EQ(baked.tracks[0][0].weights.times.size(), 394u);
  }
}

// Morph targets are the deltas, the weights a_j: at the pose of an example the file shows the example.
TEST(Correctives, ExamplesComeBackFromTheFile) {
  SKINFORGE_NEEDS_SHARED();
  Rigged human = course_character("context-aware", 15);
  BakeRequest request{.method = DeformMethod::Context, .influences = 4};
  Clip& clip = human.character.clips[0];
  for (JointTracks& tracks : clip.joints) tracks.rotation = {};
  for (int j = 0; j < 4; ++j) {
    const std::string name = "context-aware/eg" + std::to_string(j);
    request.examples.push_back(
        {read_shape(course_file(name + ".obj"), human), read_pose(course_file(name + ".dmat"), human)});
    for (JointTracks& tracks : clip.joints) {
      tracks.rotation.times.push_back(j);
      tracks.rotation.values.push_back(request.examples.back().pose[tracks.joint.index()].rotation);
    }
  }
  clip.duration = 3;
  IssueSink issues;
  Character character = human.character;
  const BakedCorrectives baked = bake_character(character, request, "test", issues);
  EXPECT_NE(baked.driver_json.find("\"coefficients\""), std::string::npos);
  add_correctives(character, baked);
  const testing::TemporaryFolder folder;
  const std::string path = (folder / "baked.glb").string();
  const Bytes glb = write_glb(character);
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(glb.data()), static_cast<std::streamsize>(glb.size()));
  const testing::GltfEvaluator file(path);
  const auto shown = shown_vertices(character, file);
  for (int j = 0; j < 4; ++j) {
    const auto played = file.pose(0, j);
    double largest = 0;
    for (std::size_t i = 0; i < played.size(); ++i)
      largest = std::max(largest,
                         (played[i] - request.examples[static_cast<std::size_t>(j)].shape[shown[i]]).norm());
    EXPECT_LT(largest, 1e-6) << "example " << j;
  }
}

// A character with morph targets and tracks of its own keeps them in front.
TEST(Correctives, JoinTargetsThatAreThere) {
  Character toy = testing::ToyCharacter::make();
  const std::size_t before = toy.morphs.size();
  const std::string first = toy.morphs.front().name;
  IssueSink issues;
  const BakedCorrectives baked = bake_character(toy, {.targets = 2, .enough = 0}, "test", issues);
  add_correctives(toy, baked);
  EXPECT_GT(toy.morphs.size(), before);
  EXPECT_NO_THROW(validate(toy));
}

TEST(Correctives, TimesHoldEveryKeyAndNoLongGap) {
  Clip clip;
  clip.duration = 0.5;
  clip.joints.resize(1);
  clip.joints[0].rotation.times = {0.25, 0.3};
  const auto times = corrective_times(clip);
  EXPECT_EQ(times.front(), 0);
  EXPECT_EQ(times.back(), 0.5);
  EXPECT_NE(std::find(times.begin(), times.end(), 0.3), times.end());
  for (std::size_t i = 1; i < times.size(); ++i) EXPECT_LE(times[i] - times[i - 1], 1.0 / 30 + 1e-6);
}

}  // namespace
}  // namespace skinforge
