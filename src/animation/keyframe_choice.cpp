#include "animation/keyframe_choice.h"

#include <algorithm>
#include <cmath>

#include "animation/behaviour.h"
#include "animation/clearance.h"
#include "animation/landing.h"
#include "base/expect.h"

namespace skinforge {
namespace {

constexpr double kMayCut = 0.005;     // ours: of the diagonal; balls are rough
constexpr float kCuttingCost = 10;    // ours: for a depth of the diagonal; 1 % costs as much as another name
constexpr float kMostForCutting = 1;  // ours: no more than a jump and a bad pose
constexpr int kCuttingRounds = 2;     // ours: the second search may cut elsewhere
constexpr std::size_t kRowsAlike =
    3;  // ours: a tenth of a second, in which limbs go no farther than balls are rough

FrameSteps row_steps(const DriverFrames& frames) {
  FrameSteps steps;
  const auto n = static_cast<std::int32_t>(frames.rows);
  for (std::int32_t f = 0; f < n; ++f) {
    steps.next.push_back(f + 1 < n ? f + 1 : (frames.is_loop ? 0 : -1));
    steps.previous.push_back(f > 0 ? f - 1 : (frames.is_loop ? n - 1 : -1));
  }
  return steps;
}

ClipChoice choice_of(const CompletionOptions& options, std::size_t input) {
  return options.clips.empty() ? ClipChoice() : options.clips[input];
}

// Clips to choose from: those in which some source of the part moves; when none does, all.
std::vector<bool> allowed_clips(std::span<const MotionSet* const> motions, const PartToComplete& part,
                                const ClipChoice& choice) {
  const std::size_t clips = motions[part.sources.front().index()]->clip_begin.size() - 1;
  std::vector<bool> allowed(clips, false);
  if (!choice.use.empty()) {
    for (const std::size_t c : choice.use) allowed[c] = true;
    return allowed;
  }
  for (const SourceId source : part.sources)
    for (std::size_t c = 0; c < clips; ++c) allowed[c] = allowed[c] || motions[source.index()]->is_moving[c];
  const bool none = std::find(allowed.begin(), allowed.end(), true) == allowed.end();
  return none ? std::vector<bool>(clips, true) : allowed;
}

// Their keyframes, without the repeated ends of loops.
std::vector<bool> allowed_keyframes(const MotionSet& set, const std::vector<bool>& clips) {
  std::vector<bool> allowed(set.poses.size(), false);
  for (std::size_t c = 0; c < clips.size(); ++c) {
    const std::int32_t end = set.clip_begin[c + 1] - (set.is_cyclic[c] ? 1 : 0);
    for (std::int32_t f = set.clip_begin[c]; f < end; ++f) allowed[static_cast<std::size_t>(f)] = clips[c];
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

std::vector<bool> clips_called_alike(const Character& part, const std::string& driver) {
  std::vector<bool> alike;
  for (const Clip& clip : part.clips) alike.push_back(share_a_word(clip.name, driver));
  return alike;
}

KeyframePath own_path(const DriverFrames& frames) {
  KeyframePath path;
  for (std::size_t f = 0; f < frames.rows; ++f)
    path.candidates.push_back(static_cast<std::int32_t>(frames.first + f));
  path.steps.assign(frames.rows, PathStep::Next);
  return path;
}

// One clip played from `start` on, `cycles` times in all of the rows when that is a whole number above 0,
// otherwise at its own tempo.
KeyframePath played_path(const MotionSet& set, std::size_t clip, std::size_t start, double cycles,
                         const DriverFrames& frames) {
  const std::int32_t first = set.clip_begin[clip];
  const bool wraps = set.is_cyclic[clip];
  const std::int32_t length = set.clip_begin[clip + 1] - first - (wraps ? 1 : 0);
  const double tempo = cycles > 0 ? cycles * length / static_cast<double>(frames.rows) : 1;
  KeyframePath path;
  std::int32_t before = 0;
  for (std::size_t f = 0; f < frames.rows; ++f) {
    const auto moved = static_cast<std::int32_t>(std::lround(tempo * static_cast<double>(f)));
    const std::int32_t step = f == 0 ? 1 : moved - before;
    before = moved;
    const std::int32_t frame = static_cast<std::int32_t>(start) + moved;
    path.candidates.push_back(first + (wraps ? frame % length : std::min(frame, length - 1)));
    const bool holds = step == 0 || (!wraps && frame >= length);
    path.steps.push_back(holds ? PathStep::Hold : (step == 2 ? PathStep::Skip : PathStep::Next));
  }
  if (frames.is_loop && cycles == 0) path.steps[0] = PathStep::Jump;
  return path;
}

double cost_along(const DistanceTable& costs, const KeyframePath& path) {
  double sum = 0;
  for (std::size_t f = 0; f < path.candidates.size(); ++f)
    sum += static_cast<double>(costs.row(f)[static_cast<std::size_t>(path.candidates[f])]);
  return sum;
}

// A whole number of cycles where the tempo allows that.
double cycles_that_fit(const MotionSet& set, std::size_t clip, const DriverFrames& frames,
                       const std::array<double, 2>& tempo) {
  if (!frames.is_loop || !set.is_cyclic[clip]) return 0;
  const double length = set.clip_begin[clip + 1] - set.clip_begin[clip] - 1;
  const double cycles = std::max(1.0, std::round(static_cast<double>(frames.rows) / length));
  const double needed = cycles * length / static_cast<double>(frames.rows);
  return needed >= tempo[0] && needed <= tempo[1] ? cycles : 0;
}

// A loop may begin anywhere: where it suits the driving clip best. Other clips begin at their beginning.
KeyframePath fixed_path(const DistanceTable& costs, const MotionSet& set, std::size_t clip,
                        const DriverFrames& frames, const std::array<double, 2>& tempo) {
  const double cycles = cycles_that_fit(set, clip, frames, tempo);
  const auto length = static_cast<std::size_t>(set.clip_begin[clip + 1] - set.clip_begin[clip] - 1);
  KeyframePath best = played_path(set, clip, 0, cycles, frames);
  double least = cost_along(costs, best);
  for (std::size_t start = 1; set.is_cyclic[clip] && start < length; ++start) {
    KeyframePath path = played_path(set, clip, start, cycles, frames);
    const double cost = cost_along(costs, path);
    if (cost >= least) continue;
    least = cost;
    best = std::move(path);
  }
  return best;
}

PathCosts path_costs(const CompletionOptions& options) {
  PathCosts costs;
  const auto wait = [](double change) {
    return change <= 0 ? PathCosts::kNever : static_cast<int>(std::ceil(1 / change - 1e-9)) - 1;
  };
  costs.hold_wait = wait(1 - options.tempo[0]);
  costs.skip_wait = wait(options.tempo[1] - 1);
  return costs;
}

// Rows in which the parts cut each other along a path; their costs grow by what every keyframe would cut,
// there or in the row just before.
std::int64_t add_cutting_costs(const Clearance& clearance, const KeyframePath& path,
                               std::vector<bool>& is_done, DistanceTable& costs) {
  std::int64_t found = 0;
  std::size_t asked = 0;
  Eigen::ArrayXf depths;
  for (std::size_t f = 0; f < path.candidates.size(); ++f) {
    const auto shown = static_cast<std::size_t>(path.candidates[f]);
    if (is_done[f] || clearance.depth(f, shown) <= kMayCut) continue;
    is_done[f] = true;
    ++found;
    const auto row = costs.row(f);
    if (depths.size() == 0 || f >= asked + kRowsAlike) {
      depths = clearance.depths(f, row.size(), kMostForCutting / kCuttingCost);
      asked = f;
    }
    Eigen::Map<Eigen::ArrayXf>(row.data(), depths.size()) += kCuttingCost * depths;
  }
  return found;
}

}  // namespace

DriverFrames driver_frames(const Character& character, const MotionSet& set, const DrivingClip& driver,
                           const CompletionOptions& options) {
  const ClipFrames grid(character.clips[driver.clip].duration, kSearchRate);
  const auto first = static_cast<std::size_t>(set.clip_begin[driver.clip]);
  SF_EXPECT(first + grid.count == static_cast<std::size_t>(set.clip_begin[driver.clip + 1]));
  const bool is_loop = options.loop.value_or(set.is_cyclic[driver.clip]) && grid.count > 2;
  return {grid, first, is_loop ? grid.count - 1 : grid.count, is_loop};
}

ChosenKeyframes choose_keyframes(std::span<const Character* const> characters, const Graft& graft,
                                 std::span<const MotionSet* const> motions, const DrivingClip& driver,
                                 const PartToComplete& part, const DriverFrames& frames,
                                 const CompletionOptions& options) {
  if (part.input == driver.input) return {own_path(frames)};
  const MotionSet& set = *motions[part.sources.front().index()];
  const ClipChoice choice = choice_of(options, part.input);
  std::vector<MotionPair> pairs;
  for (const SourceId a : driver.sources)
    for (const SourceId b : part.sources) pairs.push_back({motions[a.index()], motions[b.index()]});
  const FrameSteps steps = frame_steps(set);
  DistanceTable costs =
      windowed(keyframe_distances(pairs, frames.first, frames.rows), row_steps(frames), steps);
  const std::vector<bool> allowed = allowed_keyframes(set, allowed_clips(motions, part, choice));

  ChosenKeyframes chosen;
  if (choice.with) {
    chosen.path = fixed_path(costs, set, *choice.with, frames, options.tempo);
  } else if (options.choice == KeyframeChoice::Frame) {
    chosen.path = best_frames(costs, steps, allowed);
  } else {
    const std::string& name = characters[driver.input]->clips[driver.clip].name;
    add_behaviour(*pairs.front().driver, frames.first, set, clips_called_alike(*characters[part.input], name),
                  costs);
    LandingTable landing(set, characters[part.input]->skeleton, joints_of(graft, part), steps);
    const auto search = [&] {
      return best_path(
          costs, steps, allowed, [&](std::int32_t frame) { return landing.row(frame); }, frames.is_loop,
          path_costs(options));
    };
    chosen.path = search();
    const Clearance clearance(seams_between(characters, graft, motions, driver, part), frames.first,
                              frames.rows);
    std::vector<bool> is_done(frames.rows, false);
    for (int round = 0; round < kCuttingRounds; ++round) {
      const std::int64_t found = add_cutting_costs(clearance, chosen.path, is_done, costs);
      if (found == 0) break;
      chosen.cutting_frames += found;
      chosen.path = search();
    }
  }
  for (std::size_t f = 0; f < frames.rows; ++f)
    chosen.mean_distance +=
        keyframe_distance(pairs, frames.first + f, static_cast<std::size_t>(chosen.path.candidates[f])) /
        static_cast<double>(frames.rows);
  return chosen;
}

}  // namespace skinforge
