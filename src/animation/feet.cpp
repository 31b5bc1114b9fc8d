#include "animation/feet.h"

#include <algorithm>
#include <limits>

#include "animation/resampling.h"
#include "animation/sampling.h"

namespace skinforge {
namespace {

constexpr double kNearGround = 0.03;  // ours: of the height of the bind pose
constexpr double kUpright = 0.99;     // ours: cosine between up in the input and in the result

double lowest_skin(const Character& input) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vec3& p : input.mesh.positions) lowest = std::min(lowest, p.y());
  return lowest;
}

double height_of(const Character& input) {
  double highest = -std::numeric_limits<double>::infinity();
  for (const Vec3& p : input.mesh.positions) highest = std::max(highest, p.y());
  return highest - lowest_skin(input);
}

// Joints that mostly move some vertex near the ground.
std::vector<bool> joints_near_ground(const Character& input) {
  const double limit = lowest_skin(input) + kNearGround * height_of(input);
  std::vector<bool> near(input.skeleton.size(), false);
  for (std::size_t v = 0; v < input.weights.vertex_count(); ++v) {
    const auto row = input.weights.of(VertexId(v));
    if (input.mesh.positions[v].y() > limit || row.empty()) continue;
    near[std::max_element(row.begin(), row.end(), [](const Influence& a, const Influence& b) {
           return a.weight < b.weight;
         })->joint.index()] = true;
  }
  return near;
}

// Speed along the ground between two places of a foot that stands in both; 0 when it does not.
double standing_speed(const Vec3& from, const Vec3& to, double ground, double seconds) {
  if (from.y() > ground || to.y() > ground) return 0;
  return Vec3(to.x() - from.x(), 0, to.z() - from.z()).norm() / seconds;
}

}  // namespace

std::vector<Foot> find_feet(const Character& input, const MotionSet& set) {
  std::vector<Foot> feet;
  if (set.poses.empty() || input.mesh.positions.empty()) return feet;
  const std::vector<bool> near = joints_near_ground(input);
  for (std::size_t j = 0; j < near.size(); ++j)
    if (near[j]) feet.push_back({JointId(j), std::numeric_limits<double>::infinity(), 0, 0});
  std::vector<std::vector<Vec3>> places;  // #frames x #feet
  for (const Pose& pose : set.poses) {
    const auto joints = model_from_joint(input.skeleton, pose);
    auto& row = places.emplace_back();
    for (Foot& foot : feet) {
      row.push_back(joints[foot.joint.index()].translation());
      foot.lowest = std::min(foot.lowest, row.back().y());
    }
  }
  const double step = kNearGround * height_of(input);
  for (std::size_t k = 0; k < feet.size(); ++k) {
    feet[k].ground = feet[k].lowest + step;
    for (std::size_t c = 0; c + 1 < set.clip_begin.size(); ++c)
      for (std::int32_t f = set.clip_begin[c] + 1; f < set.clip_begin[c + 1]; ++f)
        feet[k].fastest =
            std::max(feet[k].fastest, standing_speed(places[f - 1][k], places[f][k], feet[k].ground,
                                                     set.frame_time[f] - set.frame_time[f - 1]));
  }
  return feet;
}

FootFaults foot_faults(const Graft& graft, std::span<const MotionSet* const> motions, const Clip& clip) {
  const ClipFrames grid(clip.duration, kSearchRate);
  std::vector<std::vector<Affine3>> worlds;
  for (std::size_t f = 0; f < grid.count; ++f)
    worlds.push_back(model_from_joint(graft.skeleton, sample(graft.skeleton, clip, grid.time(f))));
  FootFaults faults;
  for (std::size_t s = 0; s < graft.sources.size(); ++s) {
    const GraftSource& source = graft.sources[s];
    const Similarity& placed = source.model_from_input;
    if ((placed.rotation * Vec3::UnitY()).y() < kUpright) continue;
    for (const Foot& foot : motions[s]->feet) {
      const JointId joint = source.result_joint[foot.joint.index()];
      if (!joint.is_valid()) continue;
      const double lift = placed.translation.y(), ground = placed.scale * foot.ground + lift;
      for (std::size_t f = 0; f < grid.count; ++f) {
        const Vec3 place = worlds[f][joint.index()].translation();
        faults.sink = std::max(faults.sink, placed.scale * foot.lowest + lift - place.y());
        if (f == 0) continue;
        const double speed =
            standing_speed(worlds[f - 1][joint.index()].translation(), place, ground, grid.step());
        faults.slide = std::max(faults.slide, speed - placed.scale * foot.fastest);
      }
    }
  }
  return faults;
}

}  // namespace skinforge
