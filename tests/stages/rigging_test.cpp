#include "stages/rigging.h"

#include <gmock/gmock.h>

#include "animation/sampling.h"
#include "base/error.h"
#include "io/number_table.h"
#include "skeleton/pose.h"
#include "skinning/linear_blend.h"
#include "testing/assets.h"
#include "testing/course.h"
#include "testing/point_index.h"

namespace skinforge {
namespace {

using testing::CourseCase;
using ::testing::HasSubstr;

Rigged sample_human(RecipeBindMethod method) {
  RecipeBind bind;
  bind.method = method;
  IssueSink issues;
  return read_rigged({.model = read_input_files(testing::repository_file("data/human.obj")),
                      .skeleton = read_input_files(testing::repository_file("data/human.glb"))},
                     bind, issues);
}

/// Distances between two skins of one mesh over eight frames of every clip, in shares of the diagonal.
struct SkinDistance {
  double largest = 0, mean = 0;
};
SkinDistance distance(const Character& bound, const Character& original) {
  const testing::PointIndex index(original.mesh.positions);
  std::vector<std::size_t> match;
  for (const Vec3& p : bound.mesh.positions) match.push_back(index.nearest(p));
  SkinDistance d;
  std::size_t count = 0;
  for (const Clip& clip : original.clips)
    for (int i = 0; i < 8; ++i) {
      const auto palette =
          skinning_palette(original.skeleton, sample(original.skeleton, clip, clip.duration * i / 8));
      const auto a = linear_blend(bound.mesh.positions, bound.weights, palette);
      const auto b = linear_blend(original.mesh.positions, original.weights, palette);
      for (std::size_t v = 0; v < a.size(); ++v) {
        const double here = (a[v] - b[match[v]]).norm() / original.mesh.diagonal();
        d.largest = std::max(d.largest, here);
        d.mean += here;
        ++count;
      }
    }
  d.mean /= static_cast<double>(count);
  return d;
}

// The sample human without its skin against the sample human: how far weights made here are from those made
// by hand, in all its clips.
TEST(Rigging, BoundHumanMovesLikeTheOriginal) {
  IssueSink issues;
  const Character original = import_character(testing::repository_file("data/human.glb"), issues);
  for (const auto method : {RecipeBindMethod::Heat, RecipeBindMethod::Harmonic}) {
    const SkinDistance d = distance(sample_human(method).character, original);
    EXPECT_LT(d.mean, method == RecipeBindMethod::Heat ? 0.0018 : 0.002);
    EXPECT_LT(d.largest, method == RecipeBindMethod::Heat ? 0.045 : 0.06);
  }
}

// The door that welds and reorders changes nothing: weights by vertex of the file are those of the reference.
TEST(Rigging, CourseWeightsByVertexOfTheFile) {
  SKINFORGE_NEEDS_SHARED();
  const CourseCase course("hand_sequence");
  IssueSink issues;
  const Rigged hand = read_rigged({.model = {CourseCase::file("hand/rest.obj")},
                                   .skeleton = {CourseCase::file("hand/skeleton.tgf")},
                                   .handles = CourseCase::file("hand/handles.dmat"),
                                   .poses = {CourseCase::file("hand/pose.dmat")}},
                                  RecipeBind(), issues);
  const Eigen::MatrixXd table = weight_table(hand);
  const auto& ids = course.given()["vertex_ids"];
  for (std::size_t i = 0; i < ids.size(); ++i)
    for (Eigen::Index k = 0; k < table.cols(); ++k)  // importers keep float positions, so not 1e-9
      EXPECT_NEAR(table(ids[i].get<Eigen::Index>(), k),
                  course.given()["weights"][i][static_cast<std::size_t>(k)].get<double>(), 1e-4);
  EXPECT_EQ(handle_table(hand), read_dmat(CourseCase::file("hand/handles.dmat")));
  EXPECT_EQ(hand.character.clips.at(0).name, "pose");
  const auto flips = std::find_if(issues.issues().begin(), issues.issues().end(),
                                  [](const Issue& issue) { return issue.code == "rotation-signs-flipped"; });
  ASSERT_NE(flips, issues.issues().end());
}

InputFile text_file(const std::string& name, const std::string& text) {
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return {name, Bytes(begin, begin + text.size()), {}};
}

const char* const kMesh = "OFF 4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
const char* const kBones = "1 0 0 0\n2 1 0 0\n3 2 0 0\n#\n1 2\n2 3\n";

std::string refusal(RigFiles files) {
  try {
    IssueSink issues;
    read_rigged(files, RecipeBind(), issues);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::BadInput);
    return error.what();
  }
  return "nothing was refused";
}

TEST(Rigging, RefusesWhatDoesNotFit) {
  const RigFiles good{.model = {text_file("a.off", kMesh)}, .skeleton = {text_file("b.tgf", kBones)}};
  RigFiles files = good;
  files.skeleton = {text_file("b.tgf", "1 0 0 0\n2 1 0 0\n3 2 0 0\n#\n1 2\n2 3\n3 1\n")};
  EXPECT_EQ(refusal(files),
            "b.tgf: bones form a cycle: bone 1 (joint 1 to 2) hangs under itself or under such a bone");
  files.skeleton = {text_file("b.tgf", "1 0 0 0\n2 1 0 0\n3 2 0 0\n#\n1 2\n3 2\n")};
  EXPECT_EQ(refusal(files), "b.tgf: joint 2 has two parents: bones 1 and 2 end there");
  files = good;
  files.poses = {text_file("p.dmat", "4 3\n0 0 0 0 0 0 0 0 0 1 1 1\n")};
  EXPECT_EQ(refusal(files), "p.dmat: 3 rows are no whole frames of 2 bones");
  files.poses = {text_file("p.dmat", "4 2\n0 0 0 0 0 0 nan 1\n")};
  EXPECT_EQ(refusal(files), "p.dmat: line 2: a value is not finite");
  files = good;
  files.handles = text_file("h.dmat", "1 4\n0 1 2 -1\n");
  EXPECT_EQ(refusal(files), "h.dmat: label 2 of vertex 2: labels are -1 (free) or a bone from 0 to 1");
  files.handles = text_file("h.dmat", "1 3\n0 1 -1\n");
  EXPECT_EQ(refusal(files), "h.dmat: 3 x 1 labels; the mesh has 4 vertices, each with one label");
  files.handles = text_file("h.json", "{\"bone7\": [0]}");
  EXPECT_THAT(refusal(files), HasSubstr("h.json: no joint \"bone7\" (nearest: "));
  files.handles = text_file("h.json", "{\"bone0\": [4]}");
  EXPECT_EQ(refusal(files), "h.json: \"bone0\": vertices are numbers from 0 to 3");
  files.handles = text_file("h.json", "{\"bone0\": [1], \"bone1\": [1]}");
  EXPECT_EQ(refusal(files), "h.json: vertex 1 is held by \"bone0\" and by \"bone1\"");
}

}  // namespace
}  // namespace skinforge
