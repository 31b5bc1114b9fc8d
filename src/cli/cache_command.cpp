#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/recipe_tasks.h"
#include "cli/session.h"
#include "pipeline/cache.h"
#include "pipeline/cache_layout.h"
#include "pipeline/cache_usage.h"

namespace skinforge {
using nlohmann::json;

namespace {
// What killed builds left in the folders that a build writes.
void remove_left_behind(const DiskStore& store) {
  for (const char* folder : cache_layout::kFolders) store.remove_stale_temporaries(folder);
}

std::string text_of(const CacheUsage& usage) {
  if (usage.hits + usage.runs == 0) return "";
  return fmt::format(
      "{} builds: {:.1f} % of {} stages came from the cache, which saved {:.1f} s; {:.1f} s were worked\n",
      usage.builds, 100 * usage.hit_rate(), usage.hits + usage.runs, usage.saved_seconds,
      usage.spent_seconds);
}

std::string text_of(const Cache::Stats& stats, const std::string& folder) {
  std::string text =
      fmt::format("{}: {} in {} entries and {} results ({} not referenced)\n", folder,
                  readable_size(stats.bytes), stats.manifests, stats.blobs, stats.unreferenced_blobs);
  for (const auto& [stage, s] : stats.stages)
    text += fmt::format("{:>6}  {:<20} {:.2f} s\n", s.entries, stage, s.seconds);
  return text;
}

json to_json(const CacheUsage& usage) {
  return {{"builds", usage.builds},
          {"hits", usage.hits},
          {"runs", usage.runs},
          {"hit_rate", usage.hit_rate()},
          {"saved_seconds", usage.saved_seconds},
          {"spent_seconds", usage.spent_seconds}};
}

json to_json(const Cache::Stats& stats) {
  json stages = json::object();
  for (const auto& [stage, s] : stats.stages)
    stages[stage] = {{"entries", s.entries}, {"wall_seconds", s.seconds}};
  return {{"entries", stats.manifests},
          {"results", stats.blobs},
          {"bytes", stats.bytes},
          {"unreferenced_results", stats.unreferenced_blobs},
          {"stages", std::move(stages)}};
}
}  // namespace

std::string readable_size(std::uint64_t bytes) {
  if (bytes < 1000) return fmt::format("{} bytes", bytes);
  const double size = static_cast<double>(bytes);
  if (bytes < 1000 * 1000) return fmt::format("{:.0f} kB", size / 1e3);
  return bytes < 1000 * 1000 * 1000 ? fmt::format("{:.1f} MB", size / 1e6)
                                    : fmt::format("{:.1f} GB", size / 1e9);
}

ExitCode cache_stats_command(const CommandLine& line, Console&) {
  DiskStore store(line.cache);
  const Cache::Stats stats = Cache(store).stats();
  const CacheUsage usage = total_usage(store);
  json document = to_json(stats);
  document["usage"] = to_json(usage);
  print_data(line.json ? document.dump(2) : text_of(stats, line.cache) + text_of(usage));
  return ExitCode::Ok;
}

ExitCode cache_gc_command(const CommandLine& line, Console& console) {
  if (line.max_size_gb == 0 && line.max_age_days == 0)
    throw Error(ExitCode::Usage,
                "cache gc: say what may stay by --max-size or --max-age; cache clear removes all");
  DiskStore store(line.cache);
  Cache::CollectOptions options;
  if (line.max_size_gb > 0) options.max_bytes = static_cast<std::uint64_t>(line.max_size_gb * 1e9);
  if (line.max_age_days > 0) options.max_age_seconds = line.max_age_days * 86400;
  const Cache::Collected collected = Cache(store).collect(options);
  remove_left_behind(store);
  if (line.json)
    print_data(json{{"entries", collected.entries},
                    {"results", collected.blobs},
                    {"bytes", collected.bytes},
                    {"bytes_left", collected.bytes_left}}
                   .dump(2));
  else
    console.info(fmt::format("{} entries and {} results removed, {}; {} are left", collected.entries,
                             collected.blobs, readable_size(collected.bytes),
                             readable_size(collected.bytes_left)));
  return ExitCode::Ok;
}

namespace {
// For each recipe; `what` gives false where there is nothing to do.
template <class What>
ExitCode for_each_recipe(const CommandLine& line, const char* done, const char* not_done, Console& console,
                         const What& what) {
  DiskStore store(line.cache);
  Cache cache(store);
  json list = json::array();
  for (const RecipeTask& task : recipe_tasks(line)) {
    if (task.code != ExitCode::Ok) throw Error(task.code, task.error);
    const bool is_done = what(cache, session_name(task.resolved));
    list.push_back({{"recipe", task.recipe}, {"variant", task.resolved.variant}, {"done", is_done}});
    if (is_done)
      console.info(task.label() + ": " + done);
    else
      console.warn(task.label() + ": " + not_done);
  }
  if (line.json) print_data(json{{"recipes", std::move(list)}}.dump(2));
  return ExitCode::Ok;
}
}  // namespace

ExitCode cache_pin_command(const CommandLine& line, Console& console) {
  return for_each_recipe(line, "pinned", "no build of it is in the cache", console,
                         [](Cache& cache, const std::string& session) { return cache.pin(session); });
}

ExitCode cache_unpin_command(const CommandLine& line, Console& console) {
  return for_each_recipe(line, "no longer pinned", "it was not pinned", console,
                         [](Cache& cache, const std::string& session) { return cache.unpin(session); });
}

ExitCode cache_verify_command(const CommandLine& line, Console& console) {
  DiskStore store(line.cache);
  const std::vector<std::string> damage = Cache(store).verify();
  for (const std::string& sentence : damage) console.warn(sentence);
  const ExitCode code = damage.empty() ? ExitCode::Ok : ExitCode::Invalid;
  if (line.json)
    print_data(json{{"damage", damage}, {"exit_code", static_cast<int>(code)}}.dump(2));
  else
    console.info(damage.empty() ? "the cache is sound"
                                : fmt::format("{} damaged entries removed", damage.size()));
  return code;
}

ExitCode cache_clear_command(const CommandLine& line, Console& console) {
  DiskStore store(line.cache);
  const std::uint64_t removed = Cache(store).clear();
  remove_left_behind(store);
  if (line.json)
    print_data(json{{"removed", removed}}.dump(2));
  else
    console.info(fmt::format("{} files removed", removed));
  return ExitCode::Ok;
}

ExitCode cache_path_command(const CommandLine& line, Console&) {
  const std::string folder = std::filesystem::absolute(line.cache).lexically_normal().string();
  print_data(line.json ? json{{"path", folder}}.dump(2) : folder);
  return ExitCode::Ok;
}

}  // namespace skinforge
