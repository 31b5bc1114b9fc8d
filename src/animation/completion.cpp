#include "animation/completion.h"

#include <algorithm>

#include "animation/completed_part.h"
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

std::vector<SourceId> sources_of(const Graft& graft, std::size_t input) {
  std::vector<SourceId> sources;
  for (std::size_t k = 0; k < graft.sources.size(); ++k)
    if (graft.sources[k].input == input) sources.push_back(SourceId(k));
  return sources;
}

void complete_other_parts(std::span<const Character* const> characters, const Graft& graft,
                          std::span<const MotionSet* const> motions, const DrivingClip& driver,
                          const CompletionOptions& options, CompletedClip& result) {
  const auto parts = parts_to_complete(graft, driver.input);
  for (const PartToComplete& part : parts) {
    CompletedPart completed = complete_part(characters, graft, motions, driver, part, options);
    std::move(completed.joints.begin(), completed.joints.end(), std::back_inserter(result.clip.joints));
    std::move(completed.choices.begin(), completed.choices.end(), std::back_inserter(result.record.choices));
    result.record.mean_distance += completed.mean_distance / static_cast<double>(parts.size());
  }
}

}  // namespace

CompletedClip complete_clip(std::span<const Character* const> characters, const Graft& graft,
                            std::span<const MotionSet* const> motions, std::size_t input, std::size_t clip,
                            const std::string& name, const CompletionOptions& options) {
  SF_EXPECT(input < characters.size() && clip < characters[input]->clips.size());
  SF_EXPECT(motions.size() == graft.sources.size());
  const Clip& source_clip = characters[input]->clips[clip];
  const DrivingClip driver{input, clip, sources_of(graft, input)};
  CompletedClip result;
  result.clip = {name, source_clip.duration, {}, source_clip.morphs};
  result.record.clip = name;
  result.record.input = input;
  result.record.source_clip = source_clip.name;
  result.record.duration = source_clip.duration;

  for (const SourceId source : driver.sources)
    copy_driving_tracks(source_clip, graft, source, result.clip.joints);
  if (options.complete && !driver.sources.empty())
    complete_other_parts(characters, graft, motions, driver, options, result);
  std::sort(result.clip.joints.begin(), result.clip.joints.end(),
            [](const JointTracks& a, const JointTracks& b) { return a.joint < b.joint; });

  const FastestTurn fastest = fastest_turn_of(result.clip, ClipFrames(source_clip.duration, options.rate_hz));
  result.record.fastest_turn = fastest.speed;
  if (fastest.joint.is_valid()) result.record.fastest_joint = graft.skeleton[fastest.joint].name;
  for (const MotionSet* set : motions)
    result.record.fastest_source_turn = std::max(result.record.fastest_source_turn, set->fastest_turn);
  return result;
}

}  // namespace skinforge
