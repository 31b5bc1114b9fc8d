#include "animation/key_reduction.h"

#include <gtest/gtest.h>

#include "animation/resampling.h"
#include "animation/sampling.h"
#include "characters.h"

namespace skinforge {
namespace {
using namespace testing;

std::vector<double> times_of(const ClipFrames& grid) {
  std::vector<double> times;
  for (std::size_t f = 0; f < grid.count; ++f) times.push_back(grid.time(f));
  return times;
}

Quat turn(double angle) {
  return Quat(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
}

// By hand: a steady turn of 1 radian over 10 keys needs its ends only; one with a bend of 0.1 radians in the
// middle needs that key, too, unless 0.1 m at the end of the meter-long bone do not matter.
TEST(ReduceKeys, KeepsTheBend) {
  const Skeleton skeleton = straight_chain(2);
  const ClipFrames grid(1, 10);
  const std::vector<double> times = times_of(grid), radii = {0.1, 0.1};
  Clip steady{"steady", 1, {{JointId(0), {}, {}, {}}}, {}};
  QuatTrack& track = steady.joints[0].rotation;
  track.times = times;
  for (const double t : times) track.values.push_back(turn(t));
  Clip bent = steady;
  bent.joints[0].rotation.values[5] = turn(0.6);
  const auto keys_left = [&](Clip clip, double tolerance) {
    reduce_keys(clip, skeleton, {true, true}, times, radii, tolerance);
    return clip.joints[0].rotation.times.size();
  };
  EXPECT_EQ(keys_left(steady, 1e-6), 2U);
  EXPECT_GE(keys_left(bent, 0.01), 4U);
  EXPECT_EQ(keys_left(bent, 0.2), 2U);
  EXPECT_EQ(keys_left(steady, 0), times.size());
  Clip loop = steady;
  reduce_keys(loop, skeleton, {true, true}, times, radii, 1e-6, true);
  EXPECT_EQ(loop.joints[0].rotation.times, (std::vector<double>{times[0], times[1], times[9], times[10]}));
  reduce_keys(steady, skeleton, {false, true}, times, radii, 1);
  EXPECT_EQ(steady.joints[0].rotation.times.size(), times.size());  // not asked for
}

// Law: points of the skin move by no more than the tolerance, at the keys and between them.
TEST(ReduceKeys, HoldsTheTolerance) {
  const Skeleton skeleton = random_skeleton(20, 3, "j");
  const ClipFrames grid(2, 30);
  const std::vector<double> times = times_of(grid), radii(skeleton.size(), 0.2);
  const Character source = swinging_character(skeleton, {{"Swing", 2, 0.6, 1.3, 4}});
  Clip dense{"dense", 2, {}, {}};
  for (const JointTracks& tracks : source.clips[0].joints) {
    JointTracks resampled{tracks.joint, {}, {}, {}};
    for (const double t : times) {
      resampled.rotation.times.push_back(t);
      resampled.rotation.values.push_back(sample(tracks.rotation, t));
    }
    dense.joints.push_back(resampled);
  }
  for (const double tolerance : {1e-3, 1e-2, 1e-1}) {
    Clip reduced = dense;
    reduce_keys(reduced, skeleton, std::vector<bool>(skeleton.size(), true), times, radii, tolerance);
    std::size_t before = 0, after = 0;
    for (std::size_t k = 0; k < dense.joints.size(); ++k) {
      before += dense.joints[k].rotation.times.size();
      after += reduced.joints[k].rotation.times.size();
    }
    EXPECT_LT(after, before);
    for (double t = 0; t <= 2; t += 0.0123) {
      const auto a = model_from_joint(skeleton, sample(skeleton, dense, t)),
                 b = model_from_joint(skeleton, sample(skeleton, reduced, t));
      for (std::size_t j = 0; j < a.size(); ++j)
        for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0.6, 0, 0.8)}) {
          const Vec3 point = skeleton.joints[j].joint_from_model.linear() * (0.2 * direction);
          EXPECT_LE((a[j] * point - b[j] * point).norm(), 1.05 * tolerance) << t;  // between keys
        }
    }
  }
}

}  // namespace
}  // namespace skinforge
