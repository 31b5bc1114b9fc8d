#include "animation/completion.h"

#include <algorithm>

#include "animation/completed_part.h"
#include "animation/key_rate.h"
#include "animation/key_reduction.h"
#include "animation/keyframe_choice.h"
#include "animation/resampling.h"
#include "animation/sampling.h"
#include "base/expect.h"

namespace skinforge {
namespace {

// Keys of the topmost joint of a grafted sub-tree: change * key (completion.md). In a CubicSpline track the
// values at 3 k + 1 are points, the others tangents, which take the linear part alone.
template <class Value, class Point, class Tangent>
Track<Value> changed(Track<Value> track, Point&& point, Tangent&& tangent) {
  for (std::size_t k = 0; k < track.values.size(); ++k) {
    const bool is_point = track.interpolation != Interpolation::CubicSpline || k % 3 == 1;
    track.values[k] = is_point ? point(track.values[k]) : tangent(track.values[k]);
  }
  return track;
}

JointTracks premultiplied_tracks(const Similarity& change, const JointTracks& tracks) {
  const auto linear = [&](const Vec3& v) { return Vec3(change.scale * (change.rotation * v)); };
  const auto turned = [&](const Quat& q) { return Quat(change.rotation * q); };
  const auto grown = [&](const Vec3& v) { return Vec3(change.scale * v); };
  return {tracks.joint,
          changed(
              tracks.translation, [&](const Vec3& v) { return change * v; }, linear),
          changed(
              tracks.rotation, [&](const Quat& q) { return turned(q).normalized(); }, turned),
          changed(tracks.scale, grown, grown)};
}

// Sources of the driving input: their own keys, bit for bit but for the topmost joints.
void copy_driving_tracks(const Clip& clip, const Graft& graft, SourceId source,
                         std::vector<JointTracks>& out) {
  for (const JointTracks& tracks : clip.joints) {
    const JointId result = graft.sources[source.index()].result_joint[tracks.joint.index()];
    if (!result.is_valid()) continue;
    const Similarity& change = graft.origins[result.index()].change;
    out.push_back(change.is_identity() ? tracks : premultiplied_tracks(change, tracks));
    out.back().joint = result;
  }
}

struct FastestTurn {
  double speed = 0;
  JointId joint;
};

FastestTurn fastest_turn_of(const Clip& clip, const ClipFrames& grid) {
  FastestTurn fastest;
  for (const JointTracks& tracks : clip.joints) {
    if (tracks.rotation.times.size() < 2) continue;
    Quat before = sample(tracks.rotation, 0);
    for (std::size_t f = 1; f < grid.count; ++f) {
      const Quat now = sample(tracks.rotation, grid.time(f));
      const double speed = before.angularDistance(now) / grid.step();
      if (speed > fastest.speed) fastest = {speed, tracks.joint};
      before = now;
    }
  }
  return fastest;
}

// Keys that move the skin by less than the tolerance go.
void leave_out_keys(std::span<const Character* const> characters, const Graft& graft,
                    std::span<const MotionSet* const> motions, const std::vector<bool>& is_completed,
                    const ClipFrames& keys, const CompletionOptions& options, bool is_loop, Clip& clip) {
  std::vector<double> times, radii;
  for (std::size_t k = 0; k < keys.count; ++k) times.push_back(keys.time(k));
  for (const JointOrigin& origin : graft.origins) {
    const std::size_t s = origin.source.index();
    radii.push_back(graft.sources[s].model_from_input.scale * motions[s]->skin_radius[origin.joint.index()]);
  }
  const GraftSource& base = graft.sources.front();
  const double diagonal = base.model_from_input.scale * characters[base.input]->mesh.diagonal();
  reduce_keys(clip, graft.skeleton, is_completed, times, radii, options.key_tolerance * diagonal, is_loop);
}

void complete_other_parts(std::span<const Character* const> characters, const Graft& graft,
                          std::span<const MotionSet* const> motions, const Casting& casting,
                          const CompletionOptions& options, CompletedClip& result) {
  const Clip& source_clip = characters[casting.driver.input]->clips[casting.driver.clip];
  const double own_rate = own_key_rate(source_clip).value_or(kSearchRate);
  const ClipFrames keys(source_clip.duration, options.key_rate_hz.value_or(own_rate));
  std::vector<bool> is_completed(graft.skeleton.size(), false);
  for (const PartToComplete& part : casting.parts) {
    CompletedPart completed = complete_part(characters, graft, motions, casting.driver, part, keys, options);
    for (const JointTracks& tracks : completed.joints) is_completed[tracks.joint.index()] = true;
    std::move(completed.joints.begin(), completed.joints.end(), std::back_inserter(result.clip.joints));
    std::move(completed.choices.begin(), completed.choices.end(), std::back_inserter(result.record.choices));
    result.record.turns.insert(result.record.turns.end(), completed.turns.begin(), completed.turns.end());
    result.record.mean_distance += completed.mean_distance / static_cast<double>(casting.parts.size());
    result.record.jumps += completed.jumps;
    result.record.cutting_frames += completed.cutting_frames;
  }
  if (!casting.parts.empty())
    leave_out_keys(characters, graft, motions, is_completed, keys, options, result.record.is_loop,
                   result.clip);
}

}  // namespace

CompletedClip complete_clip(std::span<const Character* const> characters, const Graft& graft,
                            std::span<const MotionSet* const> motions, std::size_t input, std::size_t clip,
                            const std::string& name, const CompletionOptions& options) {
  SF_EXPECT(input < characters.size() && clip < characters[input]->clips.size());
  SF_EXPECT(motions.size() == graft.sources.size());
  const Clip& source_clip = characters[input]->clips[clip];
  const Casting casting = cast_sources(characters, graft, input, clip, options);
  CompletedClip result;
  result.clip = {name, source_clip.duration, {}, source_clip.morphs};
  result.record.clip = name;
  result.record.input = input;
  result.record.source_clip = source_clip.name;
  result.record.duration = source_clip.duration;

  for (const SourceId source : casting.driver.sources)
    copy_driving_tracks(source_clip, graft, source, result.clip.joints);
  if (options.complete && !casting.driver.sources.empty()) {
    const MotionSet& set = *motions[casting.driver.sources.front().index()];
    result.record.is_loop = driver_frames(*characters[input], set, casting.driver, options).is_loop;
    complete_other_parts(characters, graft, motions, casting, options, result);
  }
  std::sort(result.clip.joints.begin(), result.clip.joints.end(),
            [](const JointTracks& a, const JointTracks& b) { return a.joint < b.joint; });

  const FastestTurn fastest = fastest_turn_of(result.clip, ClipFrames(source_clip.duration, kSearchRate));
  result.record.fastest_turn = fastest.speed;
  if (fastest.joint.is_valid()) result.record.fastest_joint = graft.skeleton[fastest.joint].name;
  for (const MotionSet* set : motions)
    result.record.fastest_source_turn = std::max(result.record.fastest_source_turn, set->fastest_turn);
  return result;
}

}  // namespace skinforge
