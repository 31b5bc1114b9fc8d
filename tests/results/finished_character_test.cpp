#include "finished_character.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <fstream>
#include <set>

#include "testing/assets.h"
#include "testing/temporary_folder.h"
#include "visible_motion.h"
#include "welded_edges.h"

// What every finished character must be, one group of tests per recipe: the 7 of this repository and all of
// the shared folder.
namespace skinforge {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using testing::FinishedCharacter;
using testing::GltfEvaluator;
using testing::Origin;
using testing::PlacedSource;
using testing::Program;

constexpr double kFollows = 1e-4;    // of the source's diagonal
constexpr double kWeightSum = 1e-6;  // four floats
constexpr double kDuration = 1e-6;   // of the duration; a float
constexpr double kFastest = 1.1;     // of the fastest joint of the sources

// Recipes that graft; what only binds a skin has no sources to be compared with (tests/stages/rigging_test.cpp).
std::vector<std::string> recipes() {
  std::vector<std::string> found;
  for (const fs::path& folder :
       {fs::path(testing::repository_file("recipes")), testing::shared_folder() / "recipes"})
    if (fs::exists(folder))
      for (const auto& item : fs::directory_iterator(folder))
        if (json::parse(std::ifstream(item.path()), nullptr, true, true).contains("ops"))
          found.push_back(item.path());
  std::sort(found.begin(), found.end());
  return found;
}

// Built when it is first asked for.
const FinishedCharacter& finished(const std::string& recipe) {
  static const testing::TemporaryFolder folder;
  static std::map<std::string, std::unique_ptr<FinishedCharacter>> known;
  auto& character = known[recipe];
  if (!character) character = std::make_unique<FinishedCharacter>(recipe, folder.path());
  return *character;
}

class FinishedCharacterTest : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { ASSERT_EQ(result().run().status, 0) << result().run().err; }
  const FinishedCharacter& result() const { return finished(GetParam()); }
  const GltfEvaluator& glb() const { return result().glb(); }
  const json& report() const { return result().report(); }
};

TEST_P(FinishedCharacterTest, TheKhronosValidatorFindsNothing) {
  const auto run =
      Program("/usr/bin/env",
              {"node", testing::repository_file("scripts/validate_gltf.mjs"), result().glb_path()},
              fs::temp_directory_path())
          .finish();
  if (run.status == 127 || run.status == 2) GTEST_SKIP() << "NO VALIDATOR: " << run.err;
  EXPECT_EQ(run.status, 0) << run.out << run.err;
}

TEST_P(FinishedCharacterTest, HasOneRootJoint) {
  const json& skins = glb().json().at("skins");
  ASSERT_EQ(skins.size(), 1U);
  std::set<int> below;
  for (const int joint : skins[0].at("joints"))
    for (const int child : glb().json()["nodes"][joint].value("children", std::vector<int>()))
      below.insert(child);
  int roots = 0;
  for (const int joint : skins[0].at("joints")) roots += !below.contains(joint);
  EXPECT_EQ(roots, 1);
}

TEST_P(FinishedCharacterTest, WeightsAreSound) {
  for (const json& primitive : glb().json()["meshes"][0]["primitives"])
    EXPECT_FALSE(primitive["attributes"].contains("JOINTS_1"));
  for (const auto& row : glb().attribute("WEIGHTS_0")) {
    ASSERT_EQ(row.size(), 4U);
    EXPECT_NEAR(row[0] + row[1] + row[2] + row[3], 1, kWeightSum);
    EXPECT_TRUE(std::is_sorted(row.rbegin(), row.rend()) && row[3] >= 0);
  }
}

// Every edge of a junction's face has two faces that run along it in opposite directions.
TEST_P(FinishedCharacterTest, JunctionsAreClosedAndManifold) {
  const testing::WeldedEdges edges(glb());
  EXPECT_EQ(edges.open_at_junctions(), 0U);
  EXPECT_EQ(edges.crowded_at_junctions(), 0U);
  EXPECT_EQ(edges.turned_at_junctions(), 0U);
  for (const json& junction : report().at("junctions")) {
    EXPECT_EQ(junction.at("boundary_edges"), 0) << junction;
    EXPECT_EQ(junction.at("non_manifold_edges"), 0) << junction;
  }
}

// Around the junctions, too, faces end only where they ended in the source.
TEST_P(FinishedCharacterTest, NothingIsTornAroundJunctions) {
  std::size_t inherited = 0;
  for (const PlacedSource& source : result().sources())
    inherited += testing::odd_edges(source.model->character().mesh);
  EXPECT_LE(testing::WeldedEdges(glb()).odd(), inherited);
}

TEST_P(FinishedCharacterTest, EveryClipIsThere) {
  std::size_t expected = 0;
  for (const auto& [input, model] : result().inputs()) {
    for (const Clip& clip : model->character().clips) {
      ++expected;
      const auto is_it = [&clip, name = input](const json& c) {
        return c.at("input") == name && c.at("source_clip") == clip.name;
      };
      const json& clips = report().at("clips");
      const auto found = std::find_if(clips.begin(), clips.end(), is_it);
      ASSERT_NE(found, clips.end()) << input << " " << clip.name;
      const std::string name = found->at("name");
      EXPECT_TRUE(name == clip.name || name == input + "_" + clip.name) << name;
      const int animation = result().animation(name);
      ASSERT_GE(animation, 0) << name;
      EXPECT_NEAR(glb().duration(animation), clip.duration, kDuration * clip.duration) << name;
    }
  }
  EXPECT_EQ(glb().animation_count(), static_cast<int>(expected));
}

// Of all faces but those of junctions each vertex is a corner of a source: position, normal and UV, in the
// base to the last bit.
TEST_P(FinishedCharacterTest, PreservedPartsAreExact) {
  const auto origins = result().origins();
  std::set<std::size_t> strangers;
  std::set<int> seen;
  for (const auto& triangle : glb().triangles()) {
    if (triangle.material == testing::kJunctionMaterial) continue;
    for (const std::size_t v : triangle.vertices) {
      if (origins[v].source < 0) strangers.insert(v);
      seen.insert(origins[v].source);
    }
  }
  EXPECT_EQ(strangers.size(), 0U) << "of " << origins.size() << " vertices";
  for (std::size_t s = 0; s < result().sources().size(); ++s)
    EXPECT_TRUE(seen.contains(static_cast<int>(s))) << "nothing of source " << s << " is left";
}

// Names of the joints that the result has from a source.
std::set<std::string> kept_joints(const json& report, int source) {
  std::set<std::string> kept;
  for (const json& joint : report.at("joints"))
    if (joint.at("source") == source) kept.insert(joint.at("source_joint"));
  return kept;
}

// A vertex of the result and the vertex of the source that it should follow.
struct Pair {
  std::size_t result;
  VertexId source;
};

// Vertices that only joints move which the result has from this source.
std::vector<Pair> followers(const FinishedCharacter& result, const std::vector<Origin>& origins, int source) {
  const Character& character = result.sources()[static_cast<std::size_t>(source)].model->character();
  const auto kept = kept_joints(result.report(), source);
  std::vector<Pair> pairs;
  for (std::size_t v = 0; v < origins.size(); ++v) {
    if (origins[v].source != source) continue;
    const VertexId vertex = character.mesh.corners[origins[v].corner];
    const auto row = character.weights.of(vertex);
    if (std::all_of(row.begin(), row.end(),
                    [&](const Influence& i) { return kept.contains(character.skeleton[i.joint].name); }))
      pairs.push_back({v, vertex});
  }
  return pairs;
}

// The largest distance between where vertices are and where their source has them. A part that hangs on
// another is carried by it, so there only the shape counts: both are brought together first.
double departure(const std::vector<Vec3>& now, const std::vector<Vec3>& wanted, bool is_carried) {
  if (now.empty()) return 0;
  Eigen::Matrix3Xd a(3, now.size()), b(3, now.size());
  for (std::size_t i = 0; i < now.size(); ++i) {
    a.col(static_cast<Eigen::Index>(i)) = wanted[i];
    b.col(static_cast<Eigen::Index>(i)) = now[i];
  }
  if (is_carried) {
    const Affine3 placed(Eigen::umeyama(a, b, true));
    a = placed * a;
  }
  return (a - b).colwise().norm().maxCoeff();
}

double worst_departure(const FinishedCharacter& result, const std::vector<Pair>& pairs,
                       const PlacedSource& source, const json& clip) {
  const std::size_t source_clip = result.source_clip(clip);
  const double duration = source.model->character().clips[source_clip].duration;
  const bool is_carried = !source.is_base || result.has_operation("detach");
  double worst = 0;
  for (const double time : {0.0, 0.31 * duration, 0.77 * duration, duration}) {
    const auto posed = result.glb().pose(result.animation(clip.at("name")), time);
    const auto source_posed = source.model->pose(source_clip, time);
    std::vector<Vec3> now, wanted;
    for (const Pair& pair : pairs) {
      now.push_back(posed[pair.result]);
      wanted.push_back(source.placement * source_posed[pair.source.index()]);
    }
    worst = std::max(worst, departure(now, wanted, is_carried));
  }
  return worst;
}

TEST_P(FinishedCharacterTest, TheDrivingPartFollowsItsSource) {
  const auto origins = result().origins();
  for (std::size_t s = 0; s < result().sources().size(); ++s) {
    const PlacedSource& source = result().sources()[s];
    const auto pairs = followers(result(), origins, static_cast<int>(s));
    EXPECT_FALSE(pairs.empty()) << "source " << s;
    for (const json& clip : report().at("clips")) {
      if (clip.at("input") != source.input) continue;
      EXPECT_LE(worst_departure(result(), pairs, source, clip), kFollows * source.diagonal())
          << clip.at("name") << ", source " << s << ", " << pairs.size() << " vertices";
    }
  }
}

// Inputs of which some joint turns or moves in an animation.
std::set<std::string> moving_inputs(const FinishedCharacter& result, int animation, double diagonal) {
  constexpr int kSamples = 16;
  const GltfEvaluator& glb = result.glb();
  const auto inputs = result.inputs_of_nodes();
  const auto begin = glb.local_transforms(animation, 0);
  std::set<std::string> moving;
  for (int i = 1; i <= kSamples; ++i) {
    const auto now = glb.local_transforms(animation, glb.duration(animation) * i / kSamples);
    for (std::size_t n = 0; n < now.size(); ++n)
      if (testing::turns_visibly(Quat(begin[n].rotation()), Quat(now[n].rotation())) ||
          testing::moves_visibly(begin[n].translation(), now[n].translation(), diagonal))
        moving.insert(inputs[n]);
  }
  return moving;
}

// The characters of data/ are smooth wherever they are cut, so there is no step in the shading to be seen.
TEST_P(FinishedCharacterTest, ShadingRunsAcrossBorders) {
  if (!fs::path(GetParam()).string().starts_with(testing::repository_file("recipes"))) return;
  for (const json& junction : report().at("junctions")) {
    const json& step = junction.at("border_normal_step");
    if (step.is_null()) continue;
    EXPECT_LT(step.at("max"), 1e-4) << junction.at("operation");  // degrees
  }
}

TEST_P(FinishedCharacterTest, TheOtherPartsMove) {
  const double diagonal = result().sources()[0].diagonal();
  for (const json& clip : report().at("clips")) {
    if (!result().input(clip.at("input")).moves(result().source_clip(clip))) continue;
    const auto moving = moving_inputs(result(), result().animation(clip.at("name")), diagonal);
    for (const PlacedSource& source : result().sources())
      EXPECT_TRUE(source.input == clip.at("input") || moving.contains(source.input))
          << source.input << " stands still in " << clip.at("name");
  }
}

TEST_P(FinishedCharacterTest, NoJointTurnsTooFast) {
  double fastest = 0;
  for (const auto& [name, model] : result().inputs()) fastest = std::max(fastest, model->fastest_turn());
  for (int a = 0; a < glb().animation_count(); ++a)
    for (const auto& keys : glb().rotation_keys(a)) {
      if (keys.interpolation == "STEP") continue;
      EXPECT_LE(testing::fastest_turn(keys.times, keys.values), kFastest * fastest)
          << glb().node_name(keys.node) << " in " << glb().animation_name(a);
    }
}

std::string test_name(const ::testing::TestParamInfo<std::string>& info) {
  return fs::path(info.param).stem();
}

INSTANTIATE_TEST_SUITE_P(Recipes, FinishedCharacterTest, ::testing::ValuesIn(recipes()), test_name);

}  // namespace
}  // namespace skinforge
