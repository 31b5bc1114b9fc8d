#pragma once

#include <cmath>
#include <numbers>

#include "characters.h"

/// Limbs with skin that get in each other's way, for the tests of this layer.
namespace skinforge::testing {

/// Rings of skin along the x axis of a joint, from its origin to `length`.
inline void add_limb(Character& character, JointId joint, double length, double radius = 0.1) {
  const Affine3 model_from_joint = character.skeleton[joint].joint_from_model.inverse();
  for (int ring = 0; ring <= 8; ++ring)
    for (int side = 0; side < 8; ++side) {
      const double angle = 2 * std::numbers::pi * side / 8;
      character.mesh.positions.push_back(
          model_from_joint * Vec3(length * ring / 8, radius * std::cos(angle), radius * std::sin(angle)));
      character.weights.push_row(std::vector<Influence>{{joint, 1.0}});
    }
}

inline Clip turned(const std::string& name, JointId joint, double angle) {
  JointTracks tracks;
  tracks.joint = joint;
  for (int k = 0; k <= 10; ++k) {
    tracks.rotation.times.push_back(0.1 * k);
    tracks.rotation.values.push_back(
        Quat(Eigen::AngleAxisd(angle + 0.01 * std::sin(0.628318530718 * k), Vec3::UnitY())));
  }
  return {name, 1, {tracks}, {}};
}

/// A post along z at x = 1 belongs to the body; an arm of length 1.5 along x hangs at its root, and its bind
/// pose points up, clear of the post. Turned by 0 about y it goes through the post, turned by -1.2 it does
/// not.
struct PostAndArm {
  Character body, arm;
  explicit PostAndArm(double post_radius = 0.1) {
    body.skeleton = make_skeleton(
        {{"root"}, {"post", 0, Vec3(1, 0, 0), Quat(Eigen::AngleAxisd(-1.5708, Vec3::UnitY()))}});
    add_limb(body, JointId(1), 0.6, post_radius);
    body.clips = {turned("Stand", JointId(0), 0)};
    arm.skeleton =
        make_skeleton({{"hip"}, {"arm", 0, Vec3::Zero(), Quat(Eigen::AngleAxisd(-1.5708, Vec3::UnitY()))}});
    add_limb(arm, JointId(1), 1.5);
    arm.clips = {turned("Through", JointId(1), 0), turned("Beside", JointId(1), -1.2)};
  }
};

}  // namespace skinforge::testing
