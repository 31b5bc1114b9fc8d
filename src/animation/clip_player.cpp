#include "animation/clip_player.h"

#include <algorithm>
#include <cmath>

#include "animation/loop_closing.h"
#include "animation/sampling.h"
#include "base/expect.h"

namespace skinforge {
namespace {

constexpr double kOnFrame = 1e-6;    // frames; rounding of a time over a step
constexpr double kFastestTempo = 3;  // ours: frames a frame; more is no playing on

}  // namespace

ClipPlayer::ClipPlayer(const Character& input, const MotionSet& set)
    : input_(input), set_(set), keyed_(input.clips.size()) {
  SF_EXPECT(set.clip_begin.size() == input.clips.size() + 1);
}

std::size_t ClipPlayer::last_frame(std::size_t clip) const {
  return static_cast<std::size_t>(set_.clip_begin[clip + 1] - set_.clip_begin[clip]) - 1;
}

const ClipPlayer::Keyed& ClipPlayer::keyed(std::size_t clip) {
  std::optional<Keyed>& keyed = keyed_[clip];
  if (keyed) return *keyed;
  keyed.emplace();
  const Clip& source = input_.clips[clip];
  keyed->tracks.assign(input_.skeleton.size(), nullptr);
  for (const JointTracks& tracks : source.joints) keyed->tracks[tracks.joint.index()] = &tracks;
  if (!set_.is_cyclic[clip]) return *keyed;
  keyed->first = sample(input_.skeleton, source, 0);
  keyed->last = sample(input_.skeleton, source, source.duration);
  return *keyed;
}

// `place`: 0 = at the clip's beginning, 1 = at its end.
Transform ClipPlayer::from_keys(std::size_t clip, double place, JointId joint) {
  const Keyed& source = keyed(clip);
  const std::size_t j = joint.index();
  Transform local = input_.skeleton[joint].bind;
  if (source.tracks[j]) local = sample(*source.tracks[j], place * input_.clips[clip].duration, local);
  return set_.is_cyclic[clip] ? closed(local, source.first[j], source.last[j], place) : local;
}

Transform ClipPlayer::at(const ClipPosition& position, JointId joint) {
  const auto begin = static_cast<std::size_t>(set_.clip_begin[position.clip]);
  const auto length = static_cast<double>(last_frame(position.clip));
  double frame = position.frame;
  if (set_.is_cyclic[position.clip])
    frame -= length * std::floor(frame / length);
  else
    frame = std::clamp(frame, 0.0, length);
  const double nearest = std::round(frame);
  if (std::abs(frame - nearest) < kOnFrame)
    return set_.poses[begin + static_cast<std::size_t>(nearest)][joint.index()];
  return from_keys(position.clip, frame / length, joint);
}

Transform ClipPlayer::at(const PlaybackFrame& frame, JointId joint) {
  const Transform from = at(frame.from, joint);
  return frame.blend == 0 ? from : blend(from, at(frame.to, joint), frame.blend);
}

// None where the second is not what comes soon after the first.
std::optional<ClipPosition> ClipPlayer::between(const ClipPosition& before, const ClipPosition& after,
                                                double share) const {
  if (before.clip != after.clip) return std::nullopt;
  double step = after.frame - before.frame;
  if (set_.is_cyclic[before.clip] && step < -kOnFrame) {
    const auto length = static_cast<double>(last_frame(before.clip));
    step -= length * std::floor(step / length);
  }
  if (step < -kOnFrame || step > kFastestTempo) return std::nullopt;
  return ClipPosition{before.clip, before.frame + share * step};
}

Transform ClipPlayer::between(const PlaybackFrame& before, const PlaybackFrame& after, double share,
                              JointId joint) {
  const auto from = between(before.from, after.from, share), to = between(before.to, after.to, share);
  if (!from || !to) return blend(at(before, joint), at(after, joint), share);
  return at(PlaybackFrame{*from, *to, before.blend + share * (after.blend - before.blend)}, joint);
}

}  // namespace skinforge
