// Whole builds in one process, one thread, with a cache in memory: cold with the CPU time of each stage as a
// counter (milliseconds; the child that reads FBX is not in it), and with nothing to do. Those of the shared
// test material are skipped without it.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <map>

#include "base/parallel.h"
#include "recipe/recipe.h"
#include "stages/build.h"
#include "testing/assets.h"

namespace skinforge {
namespace {

std::vector<StageResult> build(const Recipe& recipe, Cache& cache) {
  Engine engine(cache, {});
  add_imports(recipe, engine, [&] { engine.run(); });
  engine.run();
  add_grafts(recipe, engine, ReportLevel::Json);
  engine.run();
  return engine.results();
}

void build_cold(benchmark::State& state, const std::string& file) {
  if (!std::filesystem::exists(file)) return state.SkipWithError("no shared test material");
  set_thread_limit(1);
  const Recipe recipe = load_recipe(file);
  std::map<std::string, double> milliseconds;
  for (auto _ : state) {
    MemoryStore store;
    Cache cache(store);
    for (const StageResult& stage : build(recipe, cache)) {
      if (stage.status != StageStatus::Ran) state.SkipWithError(stage.error.c_str());
      milliseconds[stage.info.name] += 1e3 * stage.cost.cpu_seconds;
    }
  }
  for (const auto& [stage, time] : milliseconds)
    state.counters[stage] = benchmark::Counter(time, benchmark::Counter::kAvgIterations);
}

void build_again(benchmark::State& state) {
  const Recipe recipe = load_recipe(testing::repository_file("recipes/centaur.json"));
  MemoryStore store;
  Cache cache(store);
  build(recipe, cache);
  for (auto _ : state) benchmark::DoNotOptimize(build(recipe, cache));
}

BENCHMARK_CAPTURE(build_cold, centaur, testing::repository_file("recipes/centaur.json"))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(build_cold, d1_centaur, testing::shared_file("recipes/d1_centaur.json"))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(build_cold, d4_eagle_winged_horse,
                  testing::shared_file("recipes/d4_eagle_winged_horse.json"))
    ->Unit(benchmark::kMillisecond);
BENCHMARK(build_again)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace skinforge
