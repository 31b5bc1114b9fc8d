#include "animation/limb_problem.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "skeleton/rotations.h"

namespace skinforge {
namespace {

constexpr int kSteps = 24;            // ours
constexpr double kLongestStep = 0.1;  // radians; ours: contacts change as the limb turns
constexpr double kDamping = 0.05;     // ours: of the mean eigenvalue
constexpr double kAside = 0.3;        // radians; ours: of the other starts
constexpr double kClear = 1e-4;       // ours: of the sum of squares at first; a hundredth of the depth

// The normal equations of one step: what depths do when the limb turns on by a small rotation vector.
struct Step {
  LimbCut cut;
  Mat3 matrix = Mat3::Zero();
  Vec3 right = Vec3::Zero();

  void add(const Vec3& lever, const Vec3& from_obstacle, double touching) {
    const double distance = from_obstacle.norm(), depth = touching - distance;
    cut.squares += depth * depth;
    cut.deepest = std::max(cut.deepest, depth);
    if (!(distance > 0)) return;
    const Vec3 gain = lever.cross(from_obstacle / distance);
    matrix += gain * gain.transpose();
    right += depth * gain;
  }
};

Step step_at(std::span<const LimbPair> pairs, const Quat& turn) {
  Step step;
  const Mat3 rotation = turn.toRotationMatrix();
  for (const LimbPair& pair : pairs) {
    const Vec3 ball = rotation * pair.ball, apart = ball - pair.obstacle;
    if (apart.squaredNorm() < pair.touching * pair.touching) step.add(ball, apart, pair.touching);
  }
  return step;
}

// At most `most` radians of a rotation.
Quat held_within(const Quat& turn, double most) {
  const Vec3 vector = rotation_vector(turn);
  const double angle = vector.norm();
  return angle <= most ? turn : from_rotation_vector(vector * (most / angle));
}

struct Found {
  Quat turn = Quat::Identity();
  double squares = 0;
};

Found descended(std::span<const LimbPair> pairs, Quat turn, double most, double clear) {
  Found best{turn, cut_of(pairs, turn).squares};
  for (int k = 0; k < kSteps && best.squares > clear; ++k) {
    const Step step = step_at(pairs, turn);
    if (step.cut.squares < best.squares) best = {turn, step.cut.squares};
    if (best.squares <= clear) break;
    const double damping = kDamping * step.matrix.trace() / 3;
    if (!(damping > 0)) break;
    Vec3 change = (step.matrix + damping * Mat3::Identity()).ldlt().solve(step.right);
    if (change.norm() > kLongestStep) change *= kLongestStep / change.norm();
    turn = held_within((from_rotation_vector(change) * turn).normalized(), most);
  }
  return best;
}

}  // namespace

LimbCut cut_of(std::span<const LimbPair> pairs, const Quat& turn) {
  return step_at(pairs, turn).cut;
}

bool may_meet(const LimbPair& pair, double most) {
  const double way = 2 * std::sin(std::min(most, std::numbers::pi) / 2) * pair.ball.norm();
  return (pair.ball - pair.obstacle).norm() < pair.touching + way;
}

Quat clearing_turn(std::span<const LimbPair> pairs, double most) {
  const double clear = kClear * cut_of(pairs, Quat::Identity()).squares;
  Found best = descended(pairs, Quat::Identity(), most, clear);
  for (int side = 0; side < 6 && best.squares > clear; ++side) {
    const Vec3 start = (side % 2 ? -1 : 1) * std::min(kAside, most) * Vec3::Unit(side / 2);
    const Found found = descended(pairs, from_rotation_vector(start), most, clear);
    if (found.squares < best.squares) best = found;
  }
  return best.turn;
}

}  // namespace skinforge
