#pragma once

#include <gmock/gmock.h>

#include <random>
#include <string>
#include <vector>

#include "model/skeleton.h"
#include "skeleton/pose.h"

/// Hand-made and random skeletons for the tests of this layer.
namespace skinforge::testing {

inline constexpr JointId kRoot{0}, kA{1}, kB{2};

struct JointSpec {
  std::string name;
  int parent = -1;
  Vec3 offset = Vec3::Zero();
  Quat rotation = Quat::Identity();
  double scale = 1;
};

/// A sound skeleton: inverse bind matrices follow from the bind transforms.
inline Skeleton make_skeleton(const std::vector<JointSpec>& specs) {
  Skeleton s;
  for (const JointSpec& spec : specs)
    s.joints.push_back({spec.name,
                        JointId(spec.parent),
                        {spec.offset, spec.rotation, Vec3::Constant(spec.scale)},
                        Affine3::Identity()});
  const auto placed = model_from_joint(s, bind_pose(s));
  for (std::size_t j = 0; j < s.size(); ++j) s.joints[j].joint_from_model = placed[j].inverse();
  return s;
}

/// Joints at x = 0, 1, 2, ...: "j0", "j1", ...
inline Skeleton straight_chain(int count) {
  std::vector<JointSpec> specs;
  for (int j = 0; j < count; ++j)
    specs.push_back({"j" + std::to_string(j), j - 1, j == 0 ? Vec3::Zero() : Vec3(Vec3::UnitX())});
  return make_skeleton(specs);
}

inline Quat random_rotation(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return quaternion_xyzw(normal(random), normal(random), normal(random), normal(random)).normalized();
}

inline Vec3 random_vector(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return {normal(random), normal(random), normal(random)};
}

/// A random tree with random offsets and rotations; every third joint is scaled.
inline Skeleton random_skeleton(int count, unsigned seed, const std::string& prefix = "j") {
  std::mt19937 random(seed);
  std::vector<JointSpec> specs;
  for (int j = 0; j < count; ++j) {
    const int parent = j == 0 ? -1 : std::uniform_int_distribution<int>(std::max(0, j - 4), j - 1)(random);
    specs.push_back({prefix + std::to_string(j), parent, random_vector(random), random_rotation(random),
                     j % 3 == 0 ? 1.5 : 1.0});
  }
  return make_skeleton(specs);
}

inline double difference(const Affine3& a, const Affine3& b) {
  return (a.matrix() - b.matrix()).norm();
}

MATCHER_P2(IsNearVec, expected, tolerance, "is a vector near the expected one") {
  *result_listener << "(" << arg.transpose() << "), distance " << (arg - expected).norm();
  return (arg - expected).norm() <= tolerance;
}

}  // namespace skinforge::testing
