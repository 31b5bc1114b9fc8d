#include "diff/animation_diff.h"

#include <algorithm>
#include <cmath>

#include "animation/morphing.h"
#include "animation/sampling.h"
#include "base/parallel.h"
#include "diff/structure_diff.h"
#include "diff/surface_diff.h"
#include "skinning/linear_blend.h"

namespace skinforge {

namespace {
void add_times(const Clip& clip, std::vector<double>& times) {
  for (const JointTracks& t : clip.joints)
    for (const std::vector<double>* keys : {&t.translation.times, &t.rotation.times, &t.scale.times})
      times.insert(times.end(), keys->begin(), keys->end());
  for (const MorphTracks& t : clip.morphs)
    times.insert(times.end(), t.weights.times.begin(), t.weights.times.end());
}

// Key times of both clips and the middles between them. Times that differ by float rounding count once.
std::vector<double> compared_times(const Clip& a, const Clip& b) {
  constexpr double kSameTime = 1e-5;  // ours: seconds
  std::vector<double> keys{0};
  add_times(a, keys);
  add_times(b, keys);
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end(), [](double x, double y) { return y - x < kSameTime; }),
             keys.end());
  std::vector<double> times;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    times.push_back(keys[i]);
    if (i + 1 < keys.size()) times.push_back((keys[i] + keys[i + 1]) / 2);
  }
  return times;
}

// A character's shape in a clip: morphed, then skinned.
class Player {
 public:
  Player(const Character& character, const Clip& clip) : character_(character), clip_(clip) {}

  void go_to(double time) {
    const Pose pose = sample(character_.skeleton, clip_, time);
    model_from_joint_ = model_from_joint(character_.skeleton, pose);
    const auto palette = skinning_palette(character_.skeleton, pose);
    positions_ = linear_blend(morphed_positions(character_, clip_, time), character_.weights, palette);
  }
  const std::vector<Vec3>& positions() const { return positions_; }
  const std::vector<Affine3>& joints() const { return model_from_joint_; }

 private:
  const Character& character_;
  const Clip& clip_;
  std::vector<Affine3> model_from_joint_;
  std::vector<Vec3> positions_;
};

double angle_between(const Affine3& a, const Affine3& b) {
  const Quat difference = Quat(a.rotation()) * Quat(b.rotation()).conjugate();
  return 2 * std::atan2(difference.vec().norm(), std::abs(difference.w()));
}

void compare_joints(const Player& a, const Player& b, const Correspondence& same, double diagonal,
                    ClipDiff& diff) {
  for (std::size_t j = 0; j < same.joints.size(); ++j) {
    if (!same.joints[j].is_valid()) continue;
    const Affine3 &of_a = a.joints()[j], &of_b = b.joints()[same.joints[j].index()];
    diff.joint_max = std::max(diff.joint_max, (of_a.translation() - of_b.translation()).norm() / diagonal);
    diff.joint_angle_deg = std::max(diff.joint_angle_deg, degrees(angle_between(of_a, of_b)));
  }
}

ClipDiff compare_clip(const Character& a, const Character& b, const Clip& of_a, const Clip& of_b,
                      const Correspondence& same, double diagonal) {
  ClipDiff diff;
  diff.clip = of_a.name;
  diff.duration_a = of_a.duration;
  diff.duration_b = of_b.duration;
  diff.keys_a = key_count(of_a);
  diff.keys_b = key_count(of_b);
  Player player_a(a, of_a), player_b(b, of_b);
  double squares = 0;
  std::vector<double> squares_of_vertex(same.vertices.size(), 0);
  std::size_t compared = 0;
  VertexId worst;
  for (const double time : compared_times(of_a, of_b)) {
    player_a.go_to(time);
    player_b.go_to(time);
    for (std::size_t v = 0; v < same.vertices.size(); ++v) {
      if (!same.vertices[v].is_valid()) continue;
      const double square =
          (player_a.positions()[v] - player_b.positions()[same.vertices[v].index()]).squaredNorm();
      squares += square;
      squares_of_vertex[v] = std::max(squares_of_vertex[v], square);
      ++compared;
      if (square <= diff.max) continue;
      diff.max = square;
      diff.time = time;
      worst = VertexId(v);
    }
    if (diagonal > 0) compare_joints(player_a, player_b, same, diagonal, diff);
  }
  for (const double square : squares_of_vertex)
    diff.vertex_max.push_back(diagonal > 0 ? static_cast<float>(std::sqrt(square) / diagonal) : 0.0F);
  diff.is_compared = compared > 0 || a.mesh.vertex_count() == 0;
  if (worst.is_valid()) diff.joint = heaviest_joint(a, worst);
  diff.max = diagonal > 0 ? std::sqrt(diff.max) / diagonal : 0;
  diff.rms = diagonal > 0 && compared > 0 ? std::sqrt(squares / double(compared)) / diagonal : 0;
  return diff;
}
}  // namespace

std::vector<ClipDiff> compare_clips(const Character& a, const Character& b, const Correspondence& same,
                                    double diagonal) {
  std::vector<std::pair<const Clip*, const Clip*>> pairs;
  for (const Clip& of_a : a.clips) {
    const auto of_b =
        std::find_if(b.clips.begin(), b.clips.end(), [&](const Clip& c) { return c.name == of_a.name; });
    if (of_b != b.clips.end()) pairs.push_back({&of_a, &*of_b});
  }
  std::vector<ClipDiff> diffs(pairs.size());
  parallel_for(pairs.size(), [&](std::size_t i) {
    diffs[i] = compare_clip(a, b, *pairs[i].first, *pairs[i].second, same, diagonal);
  });
  return diffs;
}

}  // namespace skinforge
