#include "render/lighting.h"

#include <gmock/gmock.h>

#include "render/shapes.h"
#include "render/subject.h"

namespace skinforge {
namespace {

// A square of edge 2 at height 1, lit from straight above and below.
struct Plate {
  std::vector<Vec3f> positions{{-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}};
  std::vector<TriangleIndices> triangles{{0, 1, 2}, {0, 2, 3}};
  DepthMap map{positions, triangles, Vec3f::UnitY(), Vec3f::Zero(), 2, 64};
};

TEST(DepthMap, ShadowsByHand) {
  const Plate plate;
  EXPECT_EQ(plate.map.light(Vec3f(0, 0, 0)), 0);           // below the plate
  EXPECT_EQ(plate.map.light(Vec3f(0, 1.5F, 0)), 1);        // above it
  EXPECT_EQ(plate.map.light(Vec3f(1.6F, 0, 0)), 1);        // beside it
  EXPECT_EQ(plate.map.opposite_light(Vec3f(0, 0, 0)), 1);  // seen from below
  EXPECT_EQ(plate.map.opposite_light(Vec3f(0, 1.5F, 0)), 0);
  EXPECT_EQ(plate.map.light(Vec3f(9, 0, 0)), 1);  // outside the map
}

TEST(DepthMap, EdgesAreSoft) {
  const Plate plate;
  const float rim = plate.map.light(Vec3f(1, 0, 0));
  EXPECT_GT(rim, 0.1F);
  EXPECT_LT(rim, 0.9F);
}

TEST(DepthMap, TexelSize) {
  EXPECT_FLOAT_EQ(Plate().map.texel(), 4.0F / 64);
}

class TorusLighting : public ::testing::Test {
 protected:
  TorusLighting() {
    for (const Vec3& p : mesh.positions) positions.push_back(p.cast<float>());
    const Subject subject(mesh, {});
    triangles.assign(subject.triangles().begin(), subject.triangles().end());
  }
  PolygonMesh mesh = testing::torus();
  std::vector<Vec3f> positions;
  std::vector<TriangleIndices> triangles;
};

TEST_F(TorusLighting, HolesSeeLessSkyThanTheRim) {
  const Lighting lighting(positions, triangles, {}, 256, std::nullopt);
  const float rim = lighting.sky_light(Vec3f(1, 0, 0), Vec3f::UnitX());
  const float hole = lighting.sky_light(Vec3f(0.4F, 0, 0), -Vec3f::UnitX());
  EXPECT_GT(rim, 0.95F);
  EXPECT_LT(hole, rim - 0.1F);
}

TEST_F(TorusLighting, ColorsStayInRange) {
  const Lighting lighting(positions, triangles, {}, 128, std::nullopt);
  for (const float metallic : {0.0F, 1.0F})
    for (const float roughness : {0.0F, 1.0F})
      for (const Vec3f& normal : {Vec3f(0, 1, 0), Vec3f(0, -1, 0), Vec3f(0, 0, 1)}) {
        const Finish finish{.metallic = metallic, .roughness = roughness};
        const Vec3f color = lighting.shade({2 * normal, normal, Vec3f::UnitZ()}, finish, 1);
        EXPECT_GT(color.minCoeff(), 0);
        EXPECT_LT(color.maxCoeff(), 1);
      }
}

TEST_F(TorusLighting, FloorIsDarkUnderTheBodyAndOpenFarAway) {
  const Lighting lighting(positions, triangles, {}, 128, -0.3);
  const Vec3f eye(0, 3, 3);
  const float under = lighting.floor_light(eye, Vec3f(0, -0.3F, 0.7F) - eye);
  EXPECT_LT(under, 0.6F);
  EXPECT_EQ(lighting.floor_light(eye, Vec3f(40, -0.3F, 0) - eye), 1);
  EXPECT_EQ(lighting.floor_light(eye, Vec3f(0, 1, -3)), 1);  // the ray climbs
}

TEST_F(TorusLighting, NothingToLightIsFine) {
  const Lighting lighting({}, {}, {}, 128, 0.0);
  EXPECT_EQ(lighting.sky_light(Vec3f::Zero(), Vec3f::UnitY()), 1);
  EXPECT_FLOAT_EQ(lighting.floor_light(Vec3f(0, 1, 0), Vec3f(0, -1, 0)), 1);
}

}  // namespace
}  // namespace skinforge
