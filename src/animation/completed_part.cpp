#include "animation/completed_part.h"

#include <algorithm>
#include <cmath>

#include "animation/keyframe_choice.h"
#include "animation/part_tracks.h"

namespace skinforge {
namespace {

constexpr double kHalfFade = 0.13;  // seconds to either side of a jump; ours, see completion.md

void add_choices(const Character& input, const MotionSet& set, SourceId source, const KeyframePath& path,
                 const ClipFrames& grid, CompletedPart& part) {
  for (std::size_t f = 0; f < path.candidates.size(); ++f) {
    const std::int32_t frame = path.candidates[f];
    const auto after = std::upper_bound(set.clip_begin.begin(), set.clip_begin.end(), frame);
    const auto clip = static_cast<std::size_t>(after - set.clip_begin.begin()) - 1;
    part.choices.push_back(
        {source, grid.time(f), input.clips[clip].name, set.frame_time[static_cast<std::size_t>(frame)]});
  }
}

bool belongs_to(const PartToComplete& part, std::size_t input, const LimbRank& rank) {
  return part.input == input &&
         (rank.family == part.rank.family ? rank.rank == part.rank.rank : part.steps_behind == 0);
}

// Per row the frame of its set that the part shows then; blends and fractions of frames are left out.
std::vector<std::size_t> shown_frames(const KeyframePath& path, const DriverFrames& frames, double delay) {
  std::vector<std::size_t> shown;
  const auto rows = static_cast<double>(frames.rows), last = static_cast<double>(frames.grid.count - 1);
  for (std::size_t f = 0; f < frames.rows; ++f) {
    double row = std::round(delayed_frame(static_cast<double>(f), delay, last, frames.is_loop));
    row = frames.is_loop ? row - rows * std::floor(row / rows) : std::clamp(row, 0.0, rows - 1);
    shown.push_back(static_cast<std::size_t>(path.candidates[static_cast<std::size_t>(row)]));
  }
  return shown;
}

}  // namespace

Casting cast_sources(std::span<const Character* const> characters, const Graft& graft, std::size_t input,
                     std::size_t clip, const CompletionOptions& options) {
  const std::vector<LimbRank> ranks = limb_ranks(characters, graft);
  Casting casting{{input, clip, {}}, {}};
  const auto behind = [&](std::size_t k) {
    const auto& driver = casting.driver.sources;
    return driver.empty() || !options.complete
               ? 0
               : steps_behind(ranks[k], ranks[driver.front().index()], options.limb_phase);
  };
  for (std::size_t k = 0; k < ranks.size(); ++k)
    if (graft.sources[k].input == input && behind(k) == 0) casting.driver.sources.push_back(SourceId(k));
  for (std::size_t k = 0; k < ranks.size(); ++k) {
    const auto& driver = casting.driver.sources;
    if (std::find(driver.begin(), driver.end(), SourceId(k)) != driver.end()) continue;
    auto part = std::find_if(casting.parts.begin(), casting.parts.end(), [&](const PartToComplete& p) {
      return belongs_to(p, graft.sources[k].input, ranks[k]);
    });
    if (part == casting.parts.end())
      part = casting.parts.insert(part, {graft.sources[k].input, ranks[k], behind(k), {}});
    part->sources.push_back(SourceId(k));
  }
  return casting;
}

CompletedPart complete_part(std::span<const Character* const> characters, const Graft& graft,
                            std::span<const MotionSet* const> motions, const DrivingClip& driver,
                            const PartToComplete& part, const ClipFrames& keys,
                            const CompletionOptions& options) {
  CompletedPart completed;
  const MotionSet& set = *motions[part.sources.front().index()];
  const MotionSet& driving_set = *motions[driver.sources.front().index()];
  if (set.poses.empty()) return completed;
  const DriverFrames frames = driver_frames(*characters[driver.input], driving_set, driver, options);
  const ChosenKeyframes chosen = choose_keyframes(characters, graft, motions, driver, part, frames, options);
  completed.mean_distance = chosen.mean_distance;
  completed.cutting_frames = chosen.cutting_frames;
  completed.jumps = std::count(chosen.path.steps.begin(), chosen.path.steps.end(), PathStep::Jump);

  const bool is_paper = options.choice == KeyframeChoice::Frame;
  const auto half_fade = static_cast<std::size_t>(std::lround(kHalfFade * kSearchRate));
  ClipPlayer player(*characters[part.input], set);
  PartMotion motion{&player,          play(chosen.path, set, frames.is_loop, half_fade),
                    frames.is_loop,   0,
                    frames.grid,      keys,
                    set.fastest_turn, {},
                    is_paper};
  if (part.steps_behind != 0)
    motion.delay = part.steps_behind * step_frames(driving_set, driver.clip, frames.is_loop);
  if (!is_paper)
    motion.turns =
        clear_limbs(characters, graft, seams_between(characters, graft, motions, driver, part),
                    {frames.first, shown_frames(chosen.path, frames, motion.delay)}, options.clearing);
  for (const LimbTurn& turn : motion.turns)
    completed.turns.push_back(
        {graft.skeleton[graft.sources[turn.source.index()].result_joint[turn.joint.index()]].name,
         turn.turn.angularDistance(Quat::Identity())});
  for (const SourceId source : part.sources) {
    std::vector<JointTracks> tracks = part_tracks(graft, source, motion);
    std::move(tracks.begin(), tracks.end(), std::back_inserter(completed.joints));
    add_choices(*characters[part.input], set, source, chosen.path, frames.grid, completed);
  }
  return completed;
}

}  // namespace skinforge
