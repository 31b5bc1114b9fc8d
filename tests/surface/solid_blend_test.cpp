// Two equal tubes that replace each other at an angle: the measurements of junction.md d.2.
#include "surface/solid_blend.h"

#include <gtest/gtest.h>

#include <numbers>

#include "surface/shapes.h"
#include "surface/site_field.h"

namespace skinforge {
namespace {

constexpr double kRadius = 0.3, kHalfFade = 0.35, kHalfLength = 2.5;

// A tube through the origin along x, turned about z; presence grows along it from 0 to 1 within kHalfFade.
FusionSolid tube(double angle, bool is_host) {
  PolygonMesh mesh = testing::closed_tube(101, 32, -kHalfLength, 0.05, kRadius);
  SiteParticipant participant{SourceId(is_host ? 0 : 1), is_host, false, {}, FaceSet(mesh.face_count(), 1)};
  for (Vec3& p : mesh.positions) {
    const double rising = std::clamp(0.5 + p.x() / (2 * kHalfFade), 0.0, 1.0);
    participant.presence.push_back(is_host ? 1 - rising : rising);
    p = Eigen::AngleAxisd(angle, Vec3::UnitZ()) * p;
  }
  return fusion_solid(mesh, participant);
}

struct Bent {
  std::size_t parts = 0;  // connected ones of the surface
  double neck = 0;        // least distance from the bent axis to it, in radii
};

Bent bent(double degrees, BlendOperator op) {
  const double angle = radians(degrees);
  std::vector<FusionSolid> solids;
  solids.push_back(tube(0, true));
  solids.push_back(tube(angle, false));
  const SiteField field = build_site_field(solids, {.blend = {op, 0}});
  const IsoSurface surface = extract_iso_surface(field.distance);
  Bent result;
  result.parts =
      static_cast<std::size_t>(triangle_components(surface.triangles, surface.positions.size()).second);
  result.neck = 1e9;
  const Vec3 direction(std::cos(angle), std::sin(angle), 0);
  for (double t = 0; t < kHalfFade; t += 0.01)
    for (const Vec3& axis : {Vec3(-t * Vec3::UnitX()), Vec3(t * direction)})
      for (const Vec3& p : surface.positions)
        result.neck = std::min(result.neck, (p - axis).norm() / kRadius);
  return result;
}

TEST(SolidBlend, AngleBetweenTheParts) {
  for (const double degrees : {0.0, 45.0, 90.0, 120.0}) {
    std::vector<FusionSolid> solids;
    solids.push_back(tube(0, true));
    solids.push_back(tube(radians(degrees), false));
    EXPECT_NEAR(site_blend(solids, {}, 0).bend, radians(degrees), 1e-6);
  }
}

// By hand: presence grows from 0 to 1 over 0.7; 1.2 radii are less than the 0.15 + 3 * 0.15 widths to what is
// absent.
TEST(SolidBlend, WidthsAndRadii) {
  std::vector<FusionSolid> solids;
  solids.push_back(tube(0, true));
  solids.push_back(tube(0, false));
  const SiteBlend blend = site_blend(solids, {}, 0.1);
  EXPECT_NEAR(blend.trims[0].width, 2 * kHalfFade, 1e-6);
  EXPECT_NEAR(blend.replace_radius, 1.2 * kRadius, 0.01 * kRadius);  // the girth is that of a 32-gon
  EXPECT_EQ(blend.union_radius, 0.1);
  EXPECT_EQ(site_blend(solids, {BlendOperator::Paper, 0}, 0.1).union_radius, 0);
}

// Measured: 0.98 to 0.99 at all four angles; Eq. 1 alone 0.96 and, at 120 degrees, a part that floats free.
TEST(SolidBlend, AutoKeepsTheNeckAndOnePart) {
  for (const double degrees : {0.0, 45.0, 90.0, 120.0}) {
    const Bent result = bent(degrees, BlendOperator::Auto);
    EXPECT_EQ(result.parts, 1u) << degrees;
    EXPECT_GE(result.neck, 0.95) << degrees;
  }
  EXPECT_EQ(bent(120, BlendOperator::Paper).parts, 2u);
}

// Side by side a plain smooth minimum swells; the gradient's does not.
TEST(SolidBlend, GradientDoesNotSwellAlignedParts) {
  const auto thickness = [](BlendOperator op) {
    std::vector<FusionSolid> solids;
    solids.push_back(tube(0, true));
    solids.push_back(tube(0, false));
    const SiteField field = build_site_field(solids, {.blend = {op, 0}});
    double most = 0;
    for (const Vec3& p : extract_iso_surface(field.distance).positions)
      if (std::abs(p.x()) < kHalfFade) most = std::max(most, std::hypot(p.y(), p.z()));
    return most / kRadius;
  };
  EXPECT_GT(thickness(BlendOperator::Smin), 1.1);
  EXPECT_LT(thickness(BlendOperator::Gradient), 1.03);
  EXPECT_LT(thickness(BlendOperator::Auto), 1.03);
}

}  // namespace
}  // namespace skinforge
