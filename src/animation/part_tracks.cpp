#include "animation/part_tracks.h"

#include <algorithm>
#include <cmath>

#include "animation/limbs.h"

namespace skinforge {
namespace {

constexpr double kSameTurn = 1e-5;     // radians; ours: below what a float quaternion resolves twice over
constexpr double kSameLength = 1e-5;   // ours: of the value itself, as kSameTurn
constexpr std::size_t kSeamReach = 4;  // keys to either side of where a loop closes (ours)
constexpr int kSeamRounds = 16;        // ours
constexpr double kOnFrame = 1e-6;      // frames; rounding of a time over a step

// The motion of one joint at a fractional search frame.
Transform played(const PartMotion& motion, double frame, JointId joint) {
  const auto n = static_cast<double>(motion.playback.size());
  frame = motion.is_loop ? frame - n * std::floor(frame / n) : std::clamp(frame, 0.0, n - 1);
  const double nearest = std::round(frame);
  if (std::abs(frame - nearest) < kOnFrame)
    return motion.player->at(motion.playback[static_cast<std::size_t>(nearest) % motion.playback.size()],
                             joint);
  const auto before = static_cast<std::size_t>(frame);
  return motion.player->between(motion.playback[before],
                                motion.playback[(before + 1) % motion.playback.size()],
                                frame - static_cast<double>(before), joint);
}

bool same(const Vec3& a, const Vec3& b) {
  return (a - b).norm() <= kSameLength * std::max(a.norm(), b.norm());
}
bool same(const Quat& a, const Quat& b) {
  return a.angularDistance(b) <= kSameTurn;
}

// One key when the value never changes, none when it is the bind value.
template <class Value>
Track<Value> make_track(std::vector<Value> values, const Value& bind, const ClipFrames& grid) {
  Track<Value> track;
  const bool constant =
      std::all_of(values.begin(), values.end(), [&](const Value& v) { return same(v, values.front()); });
  if (constant && same(values.front(), bind)) return track;
  if (constant) values.resize(1);
  for (std::size_t f = 0; f < values.size(); ++f) track.times.push_back(constant ? 0 : grid.time(f));
  track.values = std::move(values);
  return track;
}

// Neighbouring keys on the same side of the sphere, for readers that interpolate without looking.
void align_signs(std::vector<Quat>& rotations) {
  for (std::size_t k = 1; k < rotations.size(); ++k)
    if (rotations[k].dot(rotations[k - 1]) < 0) rotations[k].coeffs() *= -1;
}

// (1 2 1) / 4 of three rotations.
Quat smoothed(const Quat& before, const Quat& here, const Quat& after) {
  const auto beside = [&](const Quat& q) { return Vec4(q.dot(here) < 0 ? -q.coeffs() : q.coeffs()); };
  return Quat(Vec4(beside(before) + 2 * here.coeffs() + beside(after))).normalized();
}

// The ends of what is no loop see themselves.
void smooth_rotations(std::vector<Quat>& rotations, bool is_loop) {
  const std::vector<Quat> old = rotations;
  const std::size_t n = old.size();
  for (std::size_t k = 0; k < n; ++k)
    rotations[k] = smoothed(old[k > 0 ? k - 1 : (is_loop ? n - 1 : 0)], old[k],
                            old[k + 1 < n ? k + 1 : (is_loop ? 0 : n - 1)]);
}

// How much the turn from key to key changes at a key of a loop: the tangent of half that angle, squared.
double kink_at(const std::vector<Quat>& rotations, std::size_t k) {
  const std::size_t n = rotations.size();
  const Quat& here = rotations[k];
  const Quat change = (rotations[k > 0 ? k - 1 : n - 1].conjugate() * here).conjugate() *
                      (here.conjugate() * rotations[k + 1 < n ? k + 1 : 0]);
  return change.vec().squaredNorm() / (change.w() * change.w());
}

double angle_of_kink(double kink) {
  return 2 * std::atan(std::sqrt(kink));
}

// Where a loop closes, its clip may change speed as nowhere inside, because its last pose nearly met its
// first and no more. The keys around are smoothed by as much as that is too much; a number that moves with
// all keys, so no last bit decides.
void soften_seam(std::vector<Quat>& rotations) {
  const std::size_t n = rotations.size();
  if (n < 2 * kSeamReach + 3) return;
  for (int round = 0; round < kSeamRounds; ++round) {
    double inside = 0;
    for (std::size_t k = 1; k + 1 < n; ++k) inside = std::max(inside, kink_at(rotations, k));
    const double seam = angle_of_kink(std::max(kink_at(rotations, n - 1), kink_at(rotations, 0)));
    const double wanted = angle_of_kink(inside);
    if (seam <= wanted) return;
    const double too_much = 1 - wanted / seam;
    const std::vector<Quat> old = rotations;
    for (std::size_t i = n - kSeamReach; i <= n + kSeamReach; ++i) {
      const std::size_t k = i % n, away = i < n ? n - i : i - n;
      const double share = 1 - static_cast<double>(away) / (kSeamReach + 1);  // else the peak stays, lower
      rotations[k] = old[k].slerp(share * std::min(1.0, 2 * too_much),
                                  smoothed(old[(k + n - 1) % n], old[k], old[(k + 1) % n]));
    }
  }
}

JointTracks make_tracks(JointId joint, const Joint& result, std::span<const Transform> locals,
                        const PartMotion& motion) {
  std::vector<Vec3> translations, scales;
  std::vector<Quat> rotations;
  for (const Transform& local : locals) {
    translations.push_back(local.translation);
    rotations.push_back(local.rotation);
    scales.push_back(local.scale);
  }
  if (motion.is_smoothed)
    smooth_rotations(rotations, motion.is_loop);
  else
    limit_turns(rotations, motion.fastest_turn * motion.keys.step(), motion.is_loop);
  if (motion.is_loop) soften_seam(rotations);
  if (motion.is_loop) {
    translations.push_back(translations.front());
    rotations.push_back(rotations.front());
    scales.push_back(scales.front());
  }
  align_signs(rotations);
  return {joint, make_track(std::move(translations), result.bind.translation, motion.keys),
          make_track(std::move(rotations), result.bind.rotation, motion.keys),
          make_track(std::move(scales), result.bind.scale, motion.keys)};
}

// Search frames that the part shows at its keys; in a loop the last key repeats the first.
std::vector<double> frames_at_keys(const PartMotion& motion) {
  std::vector<double> frames;
  const double last = static_cast<double>(motion.search.count - 1);
  const std::size_t count = motion.is_loop ? motion.keys.count - 1 : motion.keys.count;
  for (std::size_t k = 0; k < count; ++k)
    frames.push_back(
        delayed_frame(motion.keys.time(k) / motion.search.step(), motion.delay, last, motion.is_loop));
  return frames;
}

// The identity for joints that are not turned.
Quat turn_of(const PartMotion& motion, SourceId source, JointId joint) {
  for (const LimbTurn& turn : motion.turns)
    if (turn.source == source && turn.joint == joint) return turn.turn;
  return Quat::Identity();
}

}  // namespace

std::vector<JointTracks> part_tracks(const Graft& graft, SourceId source, const PartMotion& motion) {
  const auto& result_joint = graft.sources[source.index()].result_joint;
  const std::vector<double> frames = frames_at_keys(motion);
  std::vector<Transform> locals(frames.size());
  std::vector<JointTracks> all;
  for (std::size_t j = 0; j < result_joint.size(); ++j) {
    const JointId result = result_joint[j];
    if (!result.is_valid()) continue;
    const Similarity& change = graft.origins[result.index()].change;
    const Quat turn = turn_of(motion, source, JointId(j));
    for (std::size_t k = 0; k < frames.size(); ++k) {
      locals[k] = played(motion, frames[k], JointId(j));
      if (!change.is_identity()) locals[k] = premultiplied(change, locals[k]);
      locals[k].rotation = turn * locals[k].rotation;
    }
    JointTracks tracks = make_tracks(result, graft.skeleton[result], locals, motion);
    const bool stays = tracks.translation.is_empty() && tracks.rotation.is_empty() && tracks.scale.is_empty();
    if (!stays) all.push_back(std::move(tracks));
  }
  return all;
}

}  // namespace skinforge
