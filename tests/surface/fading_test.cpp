#include "surface/fading.h"

#include <gtest/gtest.h>

#include <numbers>

#include "surface/shapes.h"

namespace skinforge {
namespace {

TEST(BendBetween, ByHand) {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();
  EXPECT_NEAR(bend_between(-2 * x, 3 * x), 0, 1e-9);  // the host stays on the left, the donor on the right
  EXPECT_NEAR(bend_between(-x, y), radians(90), 1e-9);
  EXPECT_NEAR(bend_between(-x, -x), radians(180), 1e-9);
  EXPECT_EQ(bend_between(Vec3::Zero(), x), 0);
}

// Along a tube of radius 0.3 presence falls from 1 to 0 between -0.35 and 0.35.
TEST(FadingOf, TubeByHand) {
  const PolygonMesh mesh = testing::closed_tube(101, 64, -2.5, 0.05, 0.3);
  SiteParticipant participant{SourceId(0), true, false, {}, FaceSet(mesh.face_count(), 1)};
  for (const Vec3& p : mesh.positions)
    participant.presence.push_back(std::clamp(0.5 - p.x() / 0.7, 0.0, 1.0));
  const FusionSolid solid = fusion_solid(mesh, participant);
  const double girth = 2 * std::numbers::pi * 0.3;
  const Fading fading = fading_of(solid), of_mesh = fading_of(mesh, participant.presence);
  EXPECT_NEAR(fading.width(), 0.7, 1e-6);
  EXPECT_NEAR(fading.slope, girth, 0.01 * girth);
  EXPECT_NEAR(fading.axis.x(), -girth, 0.01 * girth);
  EXPECT_NEAR(std::hypot(fading.axis.y(), fading.axis.z()), 0, 1e-9);
  EXPECT_NEAR((fading.axis - of_mesh.axis).norm(), 0, 1e-9);
  EXPECT_NEAR(fading.width(), of_mesh.width(), 1e-9);
  EXPECT_NEAR(cut_girth(solid), girth, 0.01 * girth);
}

TEST(FadingOf, NothingThatDoesNotFade) {
  const PolygonMesh mesh = testing::quad_grid(2, 2);
  const Fading fading = fading_of(mesh, std::vector<double>(mesh.vertex_count(), 1.0));
  EXPECT_EQ(fading.axis, Vec3(Vec3::Zero()));
  EXPECT_EQ(fading.width(), 0);
}

}  // namespace
}  // namespace skinforge
