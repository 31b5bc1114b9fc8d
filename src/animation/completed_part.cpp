#include "animation/completed_part.h"

#include <algorithm>
#include <cmath>

#include "animation/behaviour.h"
#include "animation/keyframe_path.h"
#include "animation/landing.h"
#include "animation/playback.h"
#include "animation/resampling.h"
#include "base/expect.h"

namespace skinforge {
namespace {

constexpr double kHalfFade = 0.13;    // seconds to either side of a jump; ours, see completion.md
constexpr double kSameTurn = 1e-5;    // radians; ours: below what a float quaternion resolves twice over
constexpr double kSameLength = 1e-5;  // ours: of the value itself, as kSameTurn

// Frames of the driving clip on the grid of the motion sets.
struct DriverFrames {
  ClipFrames grid;
  std::size_t first;  // in the motion set
  std::size_t rows;   // frames to choose for: in a loop the last one repeats the first
  bool is_loop;
};

DriverFrames driver_frames(std::span<const Character* const> characters,
                           std::span<const MotionSet* const> motions, const DrivingClip& driver,
                           const CompletionOptions& options) {
  const MotionSet& set = *motions[driver.sources.front().index()];
  const ClipFrames grid(characters[driver.input]->clips[driver.clip].duration, options.rate_hz);
  const auto first = static_cast<std::size_t>(set.clip_begin[driver.clip]);
  SF_EXPECT(first + grid.count == static_cast<std::size_t>(set.clip_begin[driver.clip + 1]));
  const bool is_loop = set.is_cyclic[driver.clip];
  return {grid, first, is_loop ? grid.count - 1 : grid.count, is_loop};
}

FrameSteps row_steps(const DriverFrames& frames) {
  FrameSteps steps;
  const auto n = static_cast<std::int32_t>(frames.rows);
  for (std::int32_t f = 0; f < n; ++f) {
    steps.next.push_back(f + 1 < n ? f + 1 : (frames.is_loop ? 0 : -1));
    steps.previous.push_back(f > 0 ? f - 1 : (frames.is_loop ? n - 1 : -1));
  }
  return steps;
}

// Keyframes to choose from: clips in which some source of the part moves, without the repeated ends of loops.
// When nothing moves anywhere, all clips.
std::vector<bool> allowed_keyframes(std::span<const MotionSet* const> motions, const PartToComplete& part) {
  const MotionSet& set = *motions[part.sources.front().index()];
  const std::size_t clips = set.clip_begin.size() - 1;
  std::vector<bool> moving(clips, false);
  for (const SourceId source : part.sources)
    for (std::size_t c = 0; c < clips; ++c) moving[c] = moving[c] || motions[source.index()]->is_moving[c];
  const bool none = std::find(moving.begin(), moving.end(), true) == moving.end();
  std::vector<bool> allowed(set.poses.size(), false);
  for (std::size_t c = 0; c < clips; ++c) {
    const std::int32_t end = set.clip_begin[c + 1] - (set.is_cyclic[c] ? 1 : 0);
    for (std::int32_t f = set.clip_begin[c]; f < end; ++f)
      allowed[static_cast<std::size_t>(f)] = moving[c] || none;
  }
  return allowed;
}

std::vector<JointId> joints_of(const Graft& graft, const PartToComplete& part) {
  const std::size_t count = graft.sources[part.sources.front().index()].result_joint.size();
  std::vector<JointId> joints;
  for (std::size_t j = 0; j < count; ++j)
    if (std::any_of(part.sources.begin(), part.sources.end(),
                    [&](SourceId s) { return graft.sources[s.index()].result_joint[j].is_valid(); }))
      joints.push_back(JointId(j));
  return joints;
}

KeyframePath choose(const DistanceTable& distances, std::span<const Character* const> characters,
                    const Graft& graft, std::span<const MotionSet* const> motions, const PartToComplete& part,
                    bool is_loop, KeyframeChoice choice) {
  const MotionSet& set = *motions[part.sources.front().index()];
  const FrameSteps steps = frame_steps(set);
  const std::vector<bool> allowed = allowed_keyframes(motions, part);
  if (choice == KeyframeChoice::Frame) return best_frames(distances, steps, allowed);
  LandingTable landing(set, characters[part.input]->skeleton, joints_of(graft, part), steps);
  return best_path(
      distances, steps, allowed, [&](std::int32_t frame) { return landing.row(frame); }, is_loop);
}

std::vector<bool> clips_called_alike(std::span<const Character* const> characters, const DrivingClip& driver,
                                     const PartToComplete& part) {
  std::vector<bool> alike;
  for (const Clip& clip : characters[part.input]->clips)
    alike.push_back(share_a_word(clip.name, characters[driver.input]->clips[driver.clip].name));
  return alike;
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

JointTracks make_tracks(JointId joint, const Joint& result, std::span<const Transform> locals, double limit,
                        const DriverFrames& frames) {
  std::vector<Vec3> translations, scales;
  std::vector<Quat> rotations;
  for (const Transform& local : locals) {
    translations.push_back(local.translation);
    rotations.push_back(local.rotation);
    scales.push_back(local.scale);
  }
  limit_turns(rotations, limit, frames.is_loop);
  if (frames.is_loop) {
    translations.push_back(translations.front());
    rotations.push_back(rotations.front());
    scales.push_back(scales.front());
  }
  align_signs(rotations);
  return {joint, make_track(std::move(translations), result.bind.translation, frames.grid),
          make_track(std::move(rotations), result.bind.rotation, frames.grid),
          make_track(std::move(scales), result.bind.scale, frames.grid)};
}

void add_tracks(const Graft& graft, SourceId source, const MotionSet& set,
                std::span<const PlaybackFrame> playback, double limit, const DriverFrames& frames,
                CompletedPart& part) {
  const auto& result_joint = graft.sources[source.index()].result_joint;
  std::vector<Transform> locals(playback.size());
  for (std::size_t j = 0; j < result_joint.size(); ++j) {
    const JointId result = result_joint[j];
    if (!result.is_valid()) continue;
    const Similarity& change = graft.origins[result.index()].change;
    for (std::size_t f = 0; f < playback.size(); ++f) {
      locals[f] = joint_at(set, playback[f], JointId(j));
      if (!change.is_identity()) locals[f] = premultiplied(change, locals[f]);
    }
    JointTracks tracks = make_tracks(result, graft.skeleton[result], locals, limit, frames);
    const bool stays = tracks.translation.is_empty() && tracks.rotation.is_empty() && tracks.scale.is_empty();
    if (!stays) part.joints.push_back(std::move(tracks));
  }
}

void add_choices(const Character& input, const MotionSet& set, SourceId source, const KeyframePath& path,
                 const DriverFrames& frames, CompletedPart& part) {
  for (std::size_t f = 0; f < path.candidates.size(); ++f) {
    const std::int32_t frame = path.candidates[f];
    const auto after = std::upper_bound(set.clip_begin.begin(), set.clip_begin.end(), frame);
    const auto clip = static_cast<std::size_t>(after - set.clip_begin.begin()) - 1;
    part.choices.push_back({source, frames.grid.time(f), input.clips[clip].name,
                            set.frame_time[static_cast<std::size_t>(frame)]});
  }
}

double mean_at(const DistanceTable& distances, const KeyframePath& path) {
  double sum = 0;
  for (std::size_t f = 0; f < distances.frames; ++f)
    sum += distances.row(f)[static_cast<std::size_t>(path.candidates[f])];
  return sum / static_cast<double>(distances.frames);
}

}  // namespace

std::vector<PartToComplete> parts_to_complete(const Graft& graft, std::size_t driving_input) {
  std::vector<PartToComplete> parts;
  for (std::size_t k = 0; k < graft.sources.size(); ++k) {
    const std::size_t input = graft.sources[k].input;
    if (input == driving_input) continue;
    auto part =
        std::find_if(parts.begin(), parts.end(), [&](const PartToComplete& p) { return p.input == input; });
    if (part == parts.end()) part = parts.insert(parts.end(), {input, {}});
    part->sources.push_back(SourceId(k));
  }
  return parts;
}

CompletedPart complete_part(std::span<const Character* const> characters, const Graft& graft,
                            std::span<const MotionSet* const> motions, const DrivingClip& driver,
                            const PartToComplete& part, const CompletionOptions& options) {
  CompletedPart completed;
  const MotionSet& set = *motions[part.sources.front().index()];
  if (set.poses.empty()) return completed;
  const DriverFrames frames = driver_frames(characters, motions, driver, options);
  std::vector<MotionPair> pairs;
  for (const SourceId a : driver.sources)
    for (const SourceId b : part.sources) pairs.push_back({motions[a.index()], motions[b.index()]});
  const DistanceTable distances = keyframe_distances(pairs, frames.first, frames.rows);
  DistanceTable costs = windowed(distances, row_steps(frames), frame_steps(set));
  if (options.choice == KeyframeChoice::Sequence)
    add_behaviour(*pairs.front().driver, frames.first, set, clips_called_alike(characters, driver, part),
                  costs);
  const KeyframePath path = choose(costs, characters, graft, motions, part, frames.is_loop, options.choice);
  completed.mean_distance = mean_at(distances, path);

  const auto half_fade = static_cast<std::size_t>(std::lround(kHalfFade * options.rate_hz));
  const std::vector<PlaybackFrame> playback = play(path, set, frames.is_loop, half_fade);
  const double limit = set.fastest_turn * frames.grid.step();
  for (const SourceId source : part.sources) {
    add_tracks(graft, source, set, playback, limit, frames, completed);
    add_choices(*characters[part.input], set, source, path, frames, completed);
  }
  return completed;
}

}  // namespace skinforge
