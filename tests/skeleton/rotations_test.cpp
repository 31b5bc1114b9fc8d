#include "skeleton/rotations.h"

#include <gmock/gmock.h>

#include <random>

#include "base/error.h"
#include "skeleton/rotation_frames.h"

namespace skinforge {
namespace {

constexpr double kRoundTrip = 1e-13;

Quat random_rotation(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Quat(normal(random), normal(random), normal(random), normal(random)).normalized();
}

double difference(const Quat& a, const Quat& b) {
  return (a.toRotationMatrix() - b.toRotationMatrix()).norm();
}

// XYZ: first x, then the new y, then the new z; as a matrix Rx Ry Rz.
TEST(Rotations, EulerByHand) {
  const Vec3 angles(radians(30), radians(-40), radians(110));
  const Mat3 by_hand =
      (Eigen::AngleAxisd(angles[0], Vec3::UnitX()) * Eigen::AngleAxisd(angles[1], Vec3::UnitY()) *
       Eigen::AngleAxisd(angles[2], Vec3::UnitZ()))
          .toRotationMatrix();
  EXPECT_LT((from_euler(angles, EulerOrder::XYZ).toRotationMatrix() - by_hand).norm(), kRoundTrip);
  EXPECT_LT((to_euler(Quat(by_hand), EulerOrder::XYZ) - angles).norm(), kRoundTrip);
}

TEST(Rotations, EulerRoundTripInAllOrders) {
  std::mt19937 random(6);
  for (int order = 0; order < kEulerOrders; ++order)
    for (int i = 0; i < 200; ++i) {
      const Quat q = random_rotation(random);
      const Vec3 angles = to_euler(q, EulerOrder(order));
      EXPECT_LT(difference(from_euler(angles, EulerOrder(order)), q), kRoundTrip) << order;
      EXPECT_LT((to_euler(Quat(-q.coeffs()), EulerOrder(order)) - angles).norm(), 1e-9);
      const double low = order < 6 ? -std::numbers::pi / 2 : 0;
      EXPECT_GE(angles[1], low);
      EXPECT_LE(angles[1], low + std::numbers::pi);
    }
}

TEST(Rotations, GimbalLockKeepsTheRotation) {
  for (int order = 0; order < kEulerOrders; ++order)
    for (const double second : {-90.0, 0.0, 90.0, 180.0}) {
      const Quat q = from_euler({0.4, radians(second), 0.3}, EulerOrder(order));
      const Vec3 angles = to_euler(q, EulerOrder(order));
      EXPECT_TRUE(angles.allFinite());
      EXPECT_LT(difference(from_euler(angles, EulerOrder(order)), q), 1e-7) << order << ' ' << second;
    }
}

TEST(Rotations, ExponentialMap) {
  std::mt19937 random(7);
  for (int i = 0; i < 200; ++i) {
    const Quat q = random_rotation(random);
    EXPECT_LE(rotation_vector(q).norm(), std::numbers::pi + kRoundTrip);
    EXPECT_LT(difference(from_rotation_vector(rotation_vector(q)), q), kRoundTrip);
  }
  EXPECT_EQ(rotation_vector(Quat::Identity()), Vec3(0, 0, 0));
  for (const double tiny : {1e-12, 1e-8, 3e-8, 1e-4})  // through the switch of formulas
    EXPECT_NEAR(rotation_vector(from_rotation_vector({tiny, 0, 0})).x() / tiny, 1, 1e-12);
}

// Kavan 2007: dual = (0, t) q / 2. A quarter turn about z and a step of 2 along x.
TEST(Rotations, DualQuaternionByHand) {
  const double h = std::sqrt(0.5);
  const RigidMotion motion{Quat(h, 0, 0, h), {2, 0, 0}};
  const DualQuat dual = dual_quaternion(motion);
  EXPECT_LT((dual.dual.coeffs() - Vec4(h, -h, 0, 0)).norm(), kRoundTrip);  // (0, 1, 0, 0)(h, 0, 0, h)
  const RigidMotion back = rigid_motion({Quat(3 * dual.real.coeffs()), Quat(3 * dual.dual.coeffs())});
  EXPECT_LT((back.translation - motion.translation).norm(), kRoundTrip);
}

TEST(Rotations, RigidMotionsComposeAndInvert) {
  std::mt19937 random(8);
  const RigidMotion a{random_rotation(random), {1, 2, 3}}, b{random_rotation(random), {-4, 0, 2}};
  const Vec3 p(0.3, -0.2, 0.9);
  EXPECT_LT((after(a, b) * p - a * (b * p)).norm(), kRoundTrip);
  EXPECT_LT((inverse(a) * (a * p) - p).norm(), kRoundTrip);
  Affine3 scaled = a.matrix();
  scaled.linear() *= 1.5;
  double stretch = 0;
  EXPECT_LT(difference(nearest_motion(scaled, p, &stretch).rotation, a.rotation), kRoundTrip);
  EXPECT_NEAR(stretch, 0.5, kRoundTrip);
  EXPECT_LT((nearest_motion(scaled, p) * p - scaled * p).norm(), kRoundTrip);
}

TEST(RotationFrames, QuaternionsAndMatricesAgree) {
  std::mt19937 random(9);
  Eigen::MatrixXd quats(4, 4), rows(4, 9), stacked(12, 3);
  for (Eigen::Index i = 0; i < 4; ++i) {
    const Quat q = random_rotation(random);
    quats.row(i) = q.coeffs().transpose() * (i == 2 ? -1.0 : 1.0);
    const Mat3 m = q.toRotationMatrix();
    stacked.block<3, 3>(3 * i, 0) = m;
    rows.row(i) = m.transpose().reshaped().transpose();
  }
  const auto a = rotation_frames(quats, 2), b = rotation_frames(rows, 2), c = rotation_frames(stacked, 2);
  ASSERT_EQ(a.frames.size(), 2u);
  for (std::size_t f = 0; f < 2; ++f)
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_LT(difference(a.frames[f][k], b.frames[f][k]), kRoundTrip);
      EXPECT_LT(difference(a.frames[f][k], c.frames[f][k]), kRoundTrip);
    }
  for (std::size_t k = 0; k < 2; ++k) EXPECT_GE(a.frames[0][k].dot(a.frames[1][k]), 0);
}

std::string refusal(const Eigen::MatrixXd& table) {
  try {
    rotation_frames(table, 2);
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was refused";
}

TEST(RotationFrames, RefusesWhatIsBroken) {
  EXPECT_EQ(refusal(Eigen::MatrixXd::Ones(3, 4)), "3 rows are no whole frames of 2 bones");
  EXPECT_EQ(refusal(Eigen::MatrixXd::Ones(4, 5)), "5 columns; rotations have 4 (x y z w), 9 or 3 (matrices)");
  EXPECT_EQ(refusal(Eigen::MatrixXd::Zero(2, 4)), "frame 0 bone 0: a quaternion of length zero");
  EXPECT_EQ(refusal(Eigen::MatrixXd::Ones(6, 3)), "frame 0 bone 0: a matrix that is no rotation");
}

}  // namespace
}  // namespace skinforge
