#include "diff/animation_diff.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "animation/morphing.h"
#include "animation/sampling.h"
#include "base/parallel.h"
#include "diff/skinned_difference.h"
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

// A character in a clip.
class Player {
 public:
  Player(const Character& character, const Clip& clip) : character_(character), clip_(clip) {}

  void go_to(double time) {
    const Pose pose = sample(character_.skeleton, clip_, time);
    time_ = time;
    joints_ = model_from_joint(character_.skeleton, pose);
    palette_ = skinning_palette(character_.skeleton, pose);
  }
  const std::vector<Affine3>& joints() const { return joints_; }  // model_from_joint
  const std::vector<Affine3>& palette() const { return palette_; }
  // All vertices: morphed, then skinned.
  std::vector<Vec3> positions() const {
    return linear_blend(morphed_positions(character_, clip_, time_), character_.weights, palette_);
  }

 private:
  const Character& character_;
  const Clip& clip_;
  double time_ = 0;
  std::vector<Affine3> joints_, palette_;
};

// Only a map that scales has to be decomposed, which takes a hundred times longer.
Quat rotation_of(const Affine3& map) {
  constexpr double kRounding = 1e-9;
  const Mat3 linear = map.linear();
  if (linear.determinant() > 0 && linear.isUnitary(kRounding)) return Quat(linear);
  return Quat(map.rotation());
}

double angle_between(const Affine3& a, const Affine3& b) {
  const Quat difference = rotation_of(a) * rotation_of(b).conjugate();
  return 2 * std::atan2(difference.vec().norm(), std::abs(difference.w()));
}

void compare_joints(const Player& a, const Player& b, const Correspondence& same, double diagonal,
                    ClipDiff& diff) {
  for (std::size_t j = 0; j < same.joints.size(); ++j) {
    if (!same.joints[j].is_valid()) continue;
    const Affine3 &of_a = a.joints()[j], &of_b = b.joints()[same.joints[j].index()];
    if (of_a.matrix() == of_b.matrix()) continue;
    diff.joint_max = std::max(diff.joint_max, (of_a.translation() - of_b.translation()).norm() / diagonal);
    diff.joint_angle_deg = std::max(diff.joint_angle_deg, degrees(angle_between(of_a, of_b)));
  }
}

// Compares one clip; what it learns of the vertices is gathered here. Squares of lengths.
class ClipComparison {
 public:
  ClipComparison(const Correspondence& same, const SkinnedDifference* skinned, bool wants_vertices)
      : same_(same), skinned_(skinned) {
    if (wants_vertices || !skinned) of_vertex_.assign(same.vertices.size(), 0);
  }

  void add(double time, const Player& a, const Player& b) {
    if (skinned_) add_bounded(time, a, b);
    if (!of_vertex_.empty()) add_each(time, a.positions(), b.positions());
  }

  void finish(const Character& a, double diagonal, ClipDiff& diff) const {
    if (diagonal > 0)
      for (const double square : of_vertex_)
        diff.vertex_max.push_back(static_cast<float>(std::sqrt(square) / diagonal));
    diff.is_compared = compared_ > 0 || a.mesh.vertex_count() == 0;
    if (worst_.vertex.is_valid()) diff.joint = heaviest_joint(a, worst_.vertex);
    diff.time = time_;
    diff.max = diagonal > 0 ? std::sqrt(worst_.square) / diagonal : 0;
    diff.rms = diagonal > 0 && compared_ > 0 ? std::sqrt(sum_ / double(compared_)) / diagonal : 0;
  }

 private:
  void add_bounded(double time, const Player& a, const Player& b) {
    const SkinnedDifference::Frame frame(*skinned_, a.palette(), b.palette());
    sum_ += frame.sum_of_squares();
    compared_ += skinned_->count();
    const auto larger = frame.largest_above(worst_.square);
    if (!larger) return;
    worst_ = *larger;
    time_ = time;
  }

  void add_each(double time, const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    for (std::size_t v = 0; v < same_.vertices.size(); ++v) {
      if (!same_.vertices[v].is_valid()) continue;
      const double square = (a[v] - b[same_.vertices[v].index()]).squaredNorm();
      of_vertex_[v] = std::max(of_vertex_[v], square);
      if (skinned_) continue;
      sum_ += square;
      ++compared_;
      if (square <= worst_.square) continue;
      worst_ = {square, VertexId(v)};
      time_ = time;
    }
  }

  const Correspondence& same_;
  const SkinnedDifference* skinned_;  // null: vertices move otherwise than by blending, too
  std::vector<double> of_vertex_;
  SkinnedDifference::Distance worst_;
  double time_ = 0, sum_ = 0;
  std::size_t compared_ = 0;
};

ClipDiff compare_clip(const Character& a, const Character& b, const Clip& of_a, const Clip& of_b,
                      const Correspondence& same, double diagonal, ClipComparison comparison) {
  ClipDiff diff;
  diff.clip = of_a.name;
  diff.duration_a = of_a.duration;
  diff.duration_b = of_b.duration;
  diff.keys_a = key_count(of_a);
  diff.keys_b = key_count(of_b);
  Player player_a(a, of_a), player_b(b, of_b);
  for (const double time : compared_times(of_a, of_b)) {
    player_a.go_to(time);
    player_b.go_to(time);
    comparison.add(time, player_a, player_b);
    if (diagonal > 0) compare_joints(player_a, player_b, same, diagonal, diff);
  }
  comparison.finish(a, diagonal, diff);
  return diff;
}
}  // namespace

std::vector<ClipDiff> compare_clips(const Character& a, const Character& b, const Correspondence& same,
                                    double diagonal, bool wants_vertices) {
  std::vector<std::pair<const Clip*, const Clip*>> pairs;
  for (const Clip& of_a : a.clips) {
    const auto of_b =
        std::find_if(b.clips.begin(), b.clips.end(), [&](const Clip& c) { return c.name == of_a.name; });
    if (of_b != b.clips.end()) pairs.push_back({&of_a, &*of_b});
  }
  std::optional<SkinnedDifference> skinned;
  if (!pairs.empty() && a.morphs.empty() && b.morphs.empty()) skinned.emplace(a, b, same);
  const ClipComparison empty(same, skinned ? &*skinned : nullptr, wants_vertices);
  std::vector<ClipDiff> diffs(pairs.size());
  parallel_for(pairs.size(), [&](std::size_t i) {
    diffs[i] = compare_clip(a, b, *pairs[i].first, *pairs[i].second, same, diagonal, empty);
  });
  return diffs;
}

}  // namespace skinforge
