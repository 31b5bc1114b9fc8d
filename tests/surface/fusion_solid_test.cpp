#include "surface/fusion_solid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "surface/shapes.h"

namespace skinforge {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

// A closed tube from x = 0 to 8 whose presence grows from 0 at x = 2 to 1 at x = 4.
SiteParticipant rising_participant(const PolygonMesh& tube, bool is_added) {
  SiteParticipant participant{SourceId(0), false, is_added, {}, FaceSet(tube.face_count(), 1)};
  for (const Vec3& p : tube.positions) participant.presence.push_back(std::clamp(p.x() / 2 - 1, 0., 1.));
  return participant;
}

// Presence is 0.25 at x = 2.5, so the part that counts begins there, under a flat cap.
TEST(FusionSolid, AddedPartIsCutAndCapped) {
  const PolygonMesh tube = testing::closed_tube(17, 16, 0, 0.5, 1);
  const FusionSolid solid = fusion_solid(tube, rising_participant(tube, true));
  EXPECT_TRUE(solid.is_added);
  EXPECT_TRUE(boundary_loops(solid.triangles).empty());
  EXPECT_EQ(triangle_components(solid.triangles, solid.positions.size()).second, 1);
  for (const double p : solid.presence) EXPECT_GE(p, 0.1);
  for (const Vec3& p : solid.positions) EXPECT_GE(p.x(), 2.5);
  constexpr double kFarField = 0.02;  // accuracy of the expansion
  for (const double x : {2.7, 4., 7.8}) EXPECT_NEAR(solid.bvh.winding_number({x, 0.1, 0.2}), 1, kFarField);
  for (const double x : {-1., 1., 2.3, 9.})
    EXPECT_NEAR(solid.bvh.winding_number({x, 0.1, 0.2}), 0, kFarField);
}

// What fades by Eq. 1 stays whole, with the presence it has.
TEST(FusionSolid, ReplacedPartIsWhole) {
  const PolygonMesh tube = testing::closed_tube(17, 16, 0, 0.5, 1);
  const SiteParticipant participant = rising_participant(tube, false);
  const FusionSolid solid = fusion_solid(tube, participant);
  EXPECT_EQ(solid.positions.size(), tube.vertex_count());
  EXPECT_EQ(solid.triangles.size(), triangulate(tube).triangles.size());
  EXPECT_EQ(*std::min_element(solid.presence.begin(), solid.presence.end()), 0);
}

TEST(FusionSolid, OnlyFusedFaces) {
  const PolygonMesh cube = testing::quad_cube();
  SiteParticipant participant{SourceId(0), true, false, std::vector<double>(8, 1), {0, 1, 0, 0, 0, 0}};
  EXPECT_EQ(fusion_solid(cube, participant).triangles.size(), 2u);
  EXPECT_EQ(fusion_solid(cube, participant).positions.size(), 4u);
  participant.fusing.assign(6, 0);
  EXPECT_TRUE(fusion_solid(cube, participant).triangles.empty());
}

// Three cuts, of which sites 2 and 5 are asked for: the least of their presences.
TEST(CutParticipant, LeastPresenceOfItsSites) {
  SourceSelection selection;
  selection.presence = {0.1, 0.2, 0.3};
  selection.cut_sites = {2, 4, 5};
  selection.site_presence = {{0.5, 0.2, 1}, {0.1, 0.3, 0.3}, {0.4, 0.9, 1}};
  selection.face_role = {ComponentRole::Blended, ComponentRole::KeptWhole, ComponentRole::DroppedWhole};
  const SiteParticipant p = cut_participant(SourceId(3), selection, std::vector<std::size_t>{2, 5});
  EXPECT_EQ(p.source, SourceId(3));
  EXPECT_THAT(p.presence, ElementsAre(0.4, 0.2, 1));
  EXPECT_THAT(p.fusing, ElementsAre(1, 0, 0));
  const SiteParticipant uncut = cut_participant(SourceId(3), selection, std::vector<std::size_t>{7});
  EXPECT_THAT(uncut.presence, Each(1));
  EXPECT_THAT(uncut.fusing, Each(0));
}

// The first cube is nearest but dropped; of the others the one at x = 4 is nearer.
TEST(FuseComponentNear, NearestThatIsNotDropped) {
  const PolygonMesh cubes =
      testing::joined(testing::joined(testing::quad_cube(), testing::quad_cube(Vec3(8, 0, 0))),
                      testing::quad_cube(Vec3(4, 0, 0)));
  SourceSelection selection;
  selection.face_role.assign(18, ComponentRole::KeptWhole);
  std::fill_n(selection.face_role.begin(), 6, ComponentRole::DroppedWhole);
  SiteParticipant host{SourceId(0), true, false, {}, FaceSet(18, 0)};
  fuse_component_near(host, cubes, selection, Vec3(1, 0.5, 0.5));
  FaceSet wanted(18, 0);
  std::fill_n(wanted.begin() + 12, 6, 1);
  EXPECT_EQ(host.fusing, wanted);
}

}  // namespace
}  // namespace skinforge
