#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "pipeline/cache.h"

namespace skinforge {
using nlohmann::json;

namespace {
std::string text_of(const Cache::Stats& stats, const std::string& folder) {
  std::string text =
      fmt::format("{}: {} in {} entries and {} results ({} not referenced)\n", folder,
                  readable_size(stats.bytes), stats.manifests, stats.blobs, stats.unreferenced_blobs);
  for (const auto& [stage, s] : stats.stages)
    text += fmt::format("{:>6}  {:<20} {:.2f} s\n", s.entries, stage, s.seconds);
  return text;
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
  print_data(line.json ? to_json(stats).dump(2) : text_of(stats, line.cache));
  return ExitCode::Ok;
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
