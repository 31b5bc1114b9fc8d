// Points so far out that distances between them overflow, or the integers that count cells.
#include "io/build_character_weld.h"

#include <gmock/gmock.h>

#include <limits>

namespace skinforge {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kFarOut = 3e38;  // what a float can just hold
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(PointIndex, FindsItselfFarOut) {
  for (const double tolerance : {0.0, 1e-6, 1e20})
    for (const double x : {kFarOut, -kFarOut}) {
      PointIndex index(tolerance);
      const Vec3 point(x, -x, 0);
      index.add(7, point);
      EXPECT_THAT(index.near(point), ElementsAre(7)) << x << " within " << tolerance;
      EXPECT_THAT(index.near(-point), IsEmpty()) << x << " within " << tolerance;
    }
}

TEST(PointIndex, EndsWithAnEndlessTolerance) {
  PointIndex index(kInfinity);
  index.add(0, Vec3::Zero());
  EXPECT_LE(index.near(Vec3::Zero()).size(), 1u);
}

TEST(PointIndex, EndsNearNoPoint) {
  PointIndex index(1e-6);
  index.add(0, Vec3::Zero());
  EXPECT_THAT(index.near({kNan, 0, 0}), IsEmpty());
  EXPECT_THAT(index.near({0, kInfinity, -kInfinity}), IsEmpty());
}

}  // namespace
}  // namespace skinforge
