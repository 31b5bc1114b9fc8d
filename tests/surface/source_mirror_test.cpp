#include "surface/source_mirror.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "surface/shapes.h"

namespace skinforge {
namespace {

using ::testing::ElementsAre;

PreservedSource whole(const PolygonMesh& mesh) {
  PreservedSource source{&mesh, {}};
  source.selection.kept.assign(mesh.face_count(), 1);
  source.selection.face_site.assign(mesh.face_count(), -1);
  return source;
}

// 4 by 2 squares about x = 2, and on either side of them a strip of 2 squares.
struct Scene {
  PolygonMesh base = testing::quad_grid(4, 2), left = testing::quad_grid(2, 1), right = left;
  std::vector<PreservedSource> sources;

  explicit Scene(double off = 0) {
    for (Vec3& p : left.positions) p += Vec3(-6, 0, 0);
    for (std::size_t v = 0; v < left.vertex_count(); ++v)
      right.positions[v] = Vec3(4 - left.positions[v].x(), left.positions[v].y() + off, 0);
    sources = {whole(base), whole(left), whole(right)};
  }
};

TEST(SourceMirror, PlaneAndImagesByHand) {
  const Scene scene;
  const auto mirror = find_source_mirror(scene.sources);
  ASSERT_TRUE(mirror);
  EXPECT_EQ(mirror->plane.normal, Vec3::UnitX());
  EXPECT_EQ(mirror->plane.offset, 2);
  EXPECT_EQ(mirror->matched, 1);
  EXPECT_THAT(mirror->image, ElementsAre(SourceId(0), SourceId(2), SourceId(1)));
  EXPECT_EQ(mirror->vertex[0][0], VertexId(4));
  EXPECT_EQ(mirror->vertex[0][2], VertexId(2));
  EXPECT_EQ(mirror->vertex[1][5], VertexId(5));
  EXPECT_EQ(mirror->face[0][4], FaceId(7));
  EXPECT_EQ(mirror->face[1][1], FaceId(1));
}

// A part that stands an eighth of an edge beside the image has none.
TEST(SourceMirror, PlacedBesideTheImage) {
  const Scene near(0.05), far(0.125);
  EXPECT_EQ(find_source_mirror(near.sources)->image[1], SourceId(2));
  EXPECT_FALSE(find_source_mirror(far.sources)->image[1].is_valid());
  EXPECT_FALSE(find_source_mirror({}));
}

TEST(SourceMirror, DiscardsImages) {
  Scene scene;
  const auto mirror = find_source_mirror(scene.sources);
  scene.sources[0].selection.kept[0] = 0;
  scene.sources[0].selection.face_site[0] = 0;
  scene.sources[1].selection.kept[1] = 0;
  scene.sources[1].selection.face_site[1] = 1;
  const std::vector<std::int32_t> none = {-1, -1}, images = {0, 1};
  EXPECT_EQ(discard_images(scene.sources, *mirror, none), 0u);
  EXPECT_EQ(discard_images(scene.sources, *mirror, images), 2u);
  EXPECT_EQ(scene.sources[0].selection.kept[3], 0);
  EXPECT_EQ(scene.sources[0].selection.face_site[3], 0);
  EXPECT_EQ(scene.sources[2].selection.kept[1], 0);
  EXPECT_EQ(scene.sources[2].selection.face_site[1], 1);
  EXPECT_EQ(discard_images(scene.sources, *mirror, images), 0u);
}

// The border of the two middle squares of the lower row runs back along itself; that of the first one has no
// image.
TEST(SourceMirror, BorderImages) {
  const Scene scene;
  const auto mirror = find_source_mirror(scene.sources);
  JunctionLoop middle{SourceId(0), true, {}, {}, {}}, first = middle;
  for (const int v : {1, 2, 3, 8, 7, 6}) middle.vertices.emplace_back(v);
  for (const int v : {0, 1, 6, 5}) first.vertices.emplace_back(v);
  const auto images = border_images(*mirror, {middle}, {middle});
  ASSERT_TRUE(images);
  EXPECT_THAT(*images, ElementsAre(2, 1, 0, 5, 4, 3));
  EXPECT_FALSE(border_images(*mirror, {first}, {first}));
  EXPECT_FALSE(border_images(*mirror, {middle}, {middle, first}));
}

// The same operation on both arms is symmetric, one on the left arm alone is not.
TEST(SourceMirror, PresenceDecidesWhatIsAnImage) {
  const Scene scene;
  const auto mirror = find_source_mirror(scene.sources);
  SiteParticipant both{SourceId(0), true, false, std::vector<double>(15, 1.0), FaceSet(8, 1)};
  for (const int v : {0, 5, 10}) both.presence[static_cast<std::size_t>(v)] = 0;
  const SiteParticipant one = both;
  for (const int v : {4, 9, 14}) both.presence[static_cast<std::size_t>(v)] = 0;
  EXPECT_TRUE(are_mirror_images(*mirror, std::vector{both}, std::vector{both}));
  EXPECT_FALSE(are_mirror_images(*mirror, std::vector{one}, std::vector{one}));
  SiteParticipant other = one;  // the other arm alone
  other.presence.assign(15, 1.0);
  for (const int v : {4, 9, 14}) other.presence[static_cast<std::size_t>(v)] = 0;
  EXPECT_TRUE(are_mirror_images(*mirror, std::vector{one}, std::vector{other}));
}

}  // namespace
}  // namespace skinforge
