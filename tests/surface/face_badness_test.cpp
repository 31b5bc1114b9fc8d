#include "surface/face_badness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace skinforge {
namespace {

constexpr double kRounding = 1e-13;  // powers up to the sixth of numbers near 1
constexpr double kAnywhere = std::numeric_limits<double>::infinity();

// Corners of 90, 45, 135 and 90 degrees: two lack 1 - sin 45, two nothing.
const std::vector<Vec3> kTrapezium = {{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const double kLack = 1 - std::sqrt(0.5);
const Vec3 kCentre(0.75, 0.5, 0);

double badness(FaceGoal goal, double voxel, const Vec3& outward, double distance) {
  return FaceBadness(goal, voxel).of(kTrapezium, {kCentre, outward, distance});
}

TEST(FaceBadness, PowersOfWhatIsLacking) {
  const Vec3 up = Vec3::UnitZ();
  EXPECT_NEAR(badness(FaceGoal::All, kAnywhere, up, 0), std::pow(kLack, 3), kRounding);
  EXPECT_NEAR(badness(FaceGoal::Worst, kAnywhere, up, 0), std::pow(kLack, 6), kRounding);
  // The worst corner's square, and the mean of all four squares.
  EXPECT_NEAR(badness(FaceGoal::Settled, kAnywhere, up, 0), 0.5 * (1 + 0.5) * kLack * kLack, kRounding);
}

// A voxel off is half a voxel more than is free; it counts a tenth for the worst face. Told where it is not
// asked: the surface one voxel beneath another centre, the face one above that.
TEST(FaceBadness, DistanceCountsBeyondHalfAVoxel) {
  const Vec3 up = Vec3::UnitZ();
  EXPECT_NEAR(badness(FaceGoal::All, 1, up, 0.5), std::pow(kLack, 3), kRounding);
  EXPECT_NEAR(badness(FaceGoal::All, 1, up, -1) - std::pow(kLack, 3), 0.2 * 0.25, kRounding);
  EXPECT_NEAR(badness(FaceGoal::Worst, 1, up, 1) - std::pow(kLack, 6), 0.1 * 0.2 * 0.25, kRounding);
  const FaceBadness all(FaceGoal::All, 1);
  EXPECT_NEAR(all.of(kTrapezium, {kCentre - up, up, 0}), badness(FaceGoal::All, 1, up, 1), kRounding);
}

// Turned away its quality is -1, which lacks 2; where the way outward is known, the turn itself costs, too.
TEST(FaceBadness, AFaceThatTurnsAwayIsWorst) {
  const Vec3 down = -Vec3::UnitZ();
  EXPECT_NEAR(badness(FaceGoal::All, kAnywhere, down, 0), 8, kRounding);
  EXPECT_NEAR(badness(FaceGoal::All, 1, down, 0), 8 + 4 * 1.2 * 1.2, kRounding);
  EXPECT_NEAR(badness(FaceGoal::Settled, kAnywhere, down, 0), 0.5 * (4 + 0.5 * kLack * kLack), kRounding);
}

}  // namespace
}  // namespace skinforge
