#include "render/pictures.h"

#include <gmock/gmock.h>

#include "render/shapes.h"

namespace skinforge {
namespace {

using testing::pixel;
using testing::torus;

bool differ(const Raster& a, const Raster& b) {
  return a.rgba != b.rgba;
}

int reddish(const Raster& raster) {
  int count = 0;
  for (int y = 0; y < raster.height; ++y)
    for (int x = 0; x < raster.width; ++x) {
      const auto [r, g, b] = pixel(raster, x, y);
      count += r > 60 + b ? 1 : 0;
    }
  return count;
}

TEST(Pictures, RestHasThreeViews) {
  const PolygonMesh mesh = torus();
  const Raster picture = rest_picture(Subject(mesh, {}), {}, 50);
  EXPECT_EQ(picture.width, 3 * 50 + 4 * 4);
  EXPECT_EQ(picture.height, 50 + 2 * 4);
}

TEST(Pictures, JunctionShowsItsFaces) {
  const PolygonMesh mesh = torus();
  const Subject subject(mesh, {});
  std::vector<FaceId> faces;  // a quarter of the ring, around angle 45 degrees
  for (std::size_t f = 0; f < mesh.face_count() / 4; ++f) faces.emplace_back(f);
  const Vec3 middle = 0.7 * Vec3(std::sqrt(0.5), 0, std::sqrt(0.5));
  const JunctionShot shot{.faces = faces, .center = middle, .radius = 0.6, .title = "op 0"};
  const Raster picture = junction_picture(subject, shot, {}, 96);
  EXPECT_EQ(picture.width, 2 * 96 + 3 * 4);
  EXPECT_GT(reddish(picture), 96 * 96 / 20);
  const JunctionShot none{.faces = {}, .center = middle, .radius = 0.6, .title = ""};
  EXPECT_EQ(reddish(junction_picture(subject, none, {}, 96)), 0);
}

TEST(Pictures, WeightsShowWhichJointRules) {
  const PolygonMesh mesh = torus();
  const Subject subject(mesh, {});
  const auto rigid = [&](JointId joint) {
    SkinWeights weights;
    const Influence influence{joint, 1};
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) weights.push_row({&influence, 1});
    return weights;
  };
  EXPECT_TRUE(differ(weights_picture(subject, rigid(JointId(0)), 2, 60),
                     weights_picture(subject, rigid(JointId(1)), 2, 60)));
}

TEST(Pictures, StripHoldsEveryFrame) {
  const PolygonMesh mesh = torus();
  std::vector<ClipFrame> frames(3);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i].time = 0.5 * static_cast<double>(i);
    for (const Vec3& p : mesh.positions)
      frames[i].positions.push_back(p + Vec3(0, 0.4 * static_cast<double>(i), 0));
  }
  const StripOptions options{.width = 60, .height = 80};
  const Raster strip = clip_picture(Subject(mesh, {}), frames, "Walk", options);
  EXPECT_EQ(strip.width, 3 * 60 + 4 * 2);
  EXPECT_EQ(strip.height, 80 + 2 * 2);
}

TEST(Pictures, NoFramesGiveOnePixel) {
  const PolygonMesh mesh = torus();
  EXPECT_EQ(clip_picture(Subject(mesh, {}), {}, "Idle").width, 1);
}

TEST(Pictures, EmptyCharacterGivesEmptyPictures) {
  const PolygonMesh mesh;
  const Subject subject(mesh, {});
  EXPECT_EQ(rest_picture(subject, {}, 20).height, 28);
  EXPECT_EQ(junction_picture(subject, {}, {}, 20).height, 28);
  EXPECT_EQ(weights_picture(subject, {}, 0, 20).height, 28);
}

}  // namespace
}  // namespace skinforge
