#include "diff/picture_diff.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/parallel.h"
#include "diff/diff_text.h"
#include "testing/toy_character.h"

namespace skinforge {
namespace {
using ::testing::HasSubstr;
using testing::ToyCharacter;

std::vector<PictureDiff> pictures_of(const Character& a, const Character& b, bool keeps = false) {
  return compare_pictures({a, {}}, {b, {}}, compare_characters(a, b), keeps);
}

// A black square of one bone, unlit, 2 m wide, that its clip turns by 90 degrees to the side.
Character board() {
  Character c;
  for (const Vec3& p : {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0)})
    c.mesh.positions.push_back(p);
  c.mesh.corners = {VertexId(0), VertexId(1), VertexId(2), VertexId(3)};
  c.mesh.face_begin = {0, 4};
  c.mesh.face_material = {MaterialId(0)};
  c.mesh.face_part = {PartId(0)};
  c.mesh.normals.assign(4, Vec3::UnitZ());
  c.mesh.parts = {{"board", 0, true, false}};
  Material black;
  black.name = "black";
  black.base_color = Vec4(0, 0, 0, 1);
  black.unlit = black.double_sided = true;
  c.materials = {black};
  Joint root;
  root.name = "root";
  c.skeleton.joints = {root};
  for (int v = 0; v < 4; ++v) c.weights.push_row(std::vector<Influence>{{JointId(0), 1}});
  Clip clip{"Turn", 1, {JointTracks{JointId(0), {}, {}, {}}}, {}};
  clip.joints[0].rotation.times = {0, 1};
  clip.joints[0].rotation.values = {Quat::Identity(), Quat(Eigen::AngleAxisd(radians(90), Vec3::UnitY()))};
  c.clips = {clip};
  validate(c);
  return c;
}

const PictureDifference& of(const std::vector<PictureDiff>& pictures, const std::string& clip,
                            const std::string& camera) {
  for (const PictureDiff& picture : pictures)
    if (picture.clip == clip && picture.camera == camera) return picture.difference;
  throw std::runtime_error("no such picture");
}

// Law: nothing differs, in the bind pose from four sides and in the middle of clips.
TEST(PictureDiff, OfACharacterAndItselfIsNothing) {
  const Character toy = ToyCharacter::make();
  const auto pictures = pictures_of(toy, toy);
  ASSERT_EQ(pictures.size(), 4U + 3U + 2U);
  EXPECT_EQ(pictures[4].clip, "bend");
  EXPECT_EQ(pictures[4].time, 0.5);
  for (const PictureDiff& picture : pictures) {
    EXPECT_EQ(picture.difference.changed + picture.difference.mean_error, 0) << title_of(picture);
    EXPECT_EQ(picture.difference.ssim, 1) << title_of(picture);
    EXPECT_TRUE(picture.a.rgba.empty());
  }
  EXPECT_TRUE(draw_alike(toy, toy));
}

// By hand: black becomes red, which changes one channel of three by all of its range, but for the soft rim.
TEST(PictureDiff, SeesAnotherColor) {
  const Character a = board();
  Character b = a;
  b.materials[0].base_color = Vec4(1, 0, 0, 1);
  EXPECT_FALSE(draw_alike(a, b));
  const auto pictures = pictures_of(a, b, true);
  const PictureDifference& front = of(pictures, "", "front");
  constexpr double kRim = 0.03;  // 4 sides of some 220 pixels, of which the rim pixel shows the backdrop, too
  EXPECT_NEAR(front.changed, 1, kRim);
  EXPECT_NEAR(front.mean_error, 1.0 / 3, kRim);
  EXPECT_EQ(front.overlap, 1);
  EXPECT_EQ(pictures[0].a.width, 256);
  CharacterDiff diff = compare_characters(a, b);
  diff.pictures = pictures;
  const auto findings = judge(diff, {});
  EXPECT_EQ(findings.back().group, "picture");
  EXPECT_TRUE(findings.back().is_over);
  EXPECT_THAT(findings.back().text, HasSubstr("the bind pose, front"));
  EXPECT_FALSE(judge(diff, {.picture = 1}).back().is_over);
  EXPECT_THAT(to_text(diff, findings), HasSubstr("Turn at 0.500 s, side"));
}

// By hand: at the end of its clip the board of A is seen from its edge, that of B stays as it is.
TEST(PictureDiff, SeesTheWorstMomentOfAClip) {
  const Character a = board();
  Character b = a;
  b.clips[0].joints[0].rotation.values[1] = Quat::Identity();
  const auto pictures = pictures_of(a, b);
  EXPECT_EQ(of(pictures, "", "front").changed, 0);
  EXPECT_EQ(pictures.back().time, 1);
  EXPECT_LT(of(pictures, "Turn", "front").overlap, 0.1);
  EXPECT_GT(of(pictures, "Turn", "front").changed, 0.5);
  EXPECT_LT(of(pictures, "Turn", "side").overlap, 0.1);
}

// What is lit otherwise is seen, whatever its normals are called.
TEST(PictureDiff, SeesTurnedNormals) {
  const Character a = ToyCharacter::make();
  Character b = a;
  for (Vec3& normal : b.mesh.normals) normal = Quat(Eigen::AngleAxisd(0.5, Vec3::UnitX())) * normal;
  double most = 0;
  for (const PictureDiff& picture : pictures_of(a, b)) most = std::max(most, picture.difference.changed);
  EXPECT_GT(most, 0.05);
}

// Law: the same bytes for any number of threads.
TEST(PictureDiff, IsTheSameForAnyNumberOfThreads) {
  const Character a = ToyCharacter::make();
  Character b = a;
  for (Vec3& p : b.mesh.positions) p.y() += 0.02 * p.x();
  std::vector<std::vector<PictureDiff>> runs;
  for (const std::size_t threads : {1, 4}) {
    set_thread_limit(threads);
    runs.push_back(pictures_of(a, b, true));
  }
  for (std::size_t i = 0; i < runs[0].size(); ++i) {
    EXPECT_EQ(runs[0][i].a.rgba, runs[1][i].a.rgba);
    EXPECT_EQ(runs[0][i].b.rgba, runs[1][i].b.rgba);
    EXPECT_EQ(runs[0][i].difference.ssim, runs[1][i].difference.ssim);
  }
}

TEST(PictureDiff, NothingIsNotDrawn) {
  EXPECT_TRUE(pictures_of(Character(), Character()).empty());
  EXPECT_EQ(of(pictures_of(board(), Character()), "", "front").overlap, 0);
}

}  // namespace
}  // namespace skinforge
