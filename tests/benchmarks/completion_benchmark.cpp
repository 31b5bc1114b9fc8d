// Joint maps, motion sets and all completed clips of a centaur made of the characters in data/.
#include <benchmark/benchmark.h>

#include "animation/characters.h"
#include "animation/completion.h"
#include "io/import.h"
#include "testing/assets.h"

namespace skinforge {
namespace {

struct Centaur {
  std::vector<Character> inputs;
  std::vector<const Character*> characters;
  std::vector<const Skeleton*> skeletons;
  Graft graft;
  std::vector<JointMap> maps;

  Centaur() {
    IssueSink issues;
    const std::vector<std::string> names = {"horse", "human"};
    for (const std::string& name : names)
      inputs.push_back(import_character(testing::repository_file("data/" + name + ".glb"), issues));
    for (const Character& c : inputs) {
      characters.push_back(&c);
      skeletons.push_back(&c.skeleton);
    }
    const GraftOperation operation{
        GraftKind::Replace, {"Neck1"}, 1, "Spine", {1.2, Quat::Identity(), Vec3(0, 0.355, 0.683)}};
    graft = graft_skeletons(skeletons, names, 0, std::vector{operation}, issues);
    maps = build_joint_maps(skeletons, graft);
  }
  Centaur(const Centaur&) = delete;

  std::vector<MotionSet> motion_sets() const {
    std::vector<MotionSet> sets;
    for (std::size_t k = 0; k < maps.size(); ++k)
      sets.push_back(build_motion_set(inputs[graft.sources[k].input], graft, SourceId(k), maps[k]));
    return sets;
  }
};

void joint_maps(benchmark::State& state) {
  const Centaur centaur;
  for (auto _ : state) benchmark::DoNotOptimize(build_joint_maps(centaur.skeletons, centaur.graft));
}
BENCHMARK(joint_maps)->Unit(benchmark::kMillisecond);

void motion_sets(benchmark::State& state) {
  const Centaur centaur;
  for (auto _ : state) benchmark::DoNotOptimize(centaur.motion_sets());
}
BENCHMARK(motion_sets)->Unit(benchmark::kMillisecond);

void complete_all_clips(benchmark::State& state) {
  const Centaur centaur;
  const std::vector<MotionSet> sets = centaur.motion_sets();
  std::vector<const MotionSet*> motions;
  for (const MotionSet& set : sets) motions.push_back(&set);
  for (auto _ : state)
    for (std::size_t input = 0; input < 2; ++input)
      for (std::size_t c = 0; c < centaur.inputs[input].clips.size(); ++c)
        benchmark::DoNotOptimize(
            complete_clip(centaur.characters, centaur.graft, motions, input, c, "clip", {}));
}
BENCHMARK(complete_all_clips)->Unit(benchmark::kMillisecond);

// One clip of many keyframes completed with clips of as many: what the search costs as they grow. Each input
// has five clips, of which the completed one has all of the frames but a twentieth.
struct LongClips {
  testing::Mixture mixture;

  static std::vector<testing::SwingSpec> clips(std::int64_t frames, unsigned seed) {
    const double seconds = static_cast<double>(frames) / 30;
    std::vector<testing::SwingSpec> specs = {{"Long", 0.95 * seconds, 0.5, 0.95 * seconds + 0.3, seed}};
    for (unsigned k = 1; k < 5; ++k)
      specs.push_back({"Short" + std::to_string(k), 0.0125 * seconds, 0.4, 3, seed + k});
    return specs;
  }
  explicit LongClips(std::int64_t frames)
      : mixture({testing::swinging_character(testing::random_skeleton(50, 1, "h"), clips(frames, 1)),
                 testing::swinging_character(testing::random_skeleton(60, 2, "d"), clips(frames, 7))},
                {{GraftKind::Replace, {"h7"}, 1, "d4", {}}}) {}
};

void complete_long_clip(benchmark::State& state) {
  const LongClips clips(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(clips.mixture.complete(0, 0));
  state.counters["keyframes"] = static_cast<double>(clips.mixture.motions[1].poses.size());
}
BENCHMARK(complete_long_clip)
    ->RangeMultiplier(10)
    ->Range(100, 10000)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

}  // namespace
}  // namespace skinforge
