#include "stages/stage_settings.h"

#include <fmt/core.h>

#include <algorithm>

#include "recipe/schema_properties.h"

namespace skinforge {

namespace {
const std::vector<StageSetting> kSettings = {
    {"/$schema", {}},
    {"/recipe_version", {}},
    {"/name", {"bind"}},
    {"/inputs/*", {"import", "rig", "adopt", "place", "turn", "graft_skeleton", "report"}, true},
    {"/inputs/*/file", {"import", "rig", "report"}, true},
    {"/inputs/*/recipe", {"report"}, true},
    {"/inputs/*/clips", {"import", "rig"}},
    {"/inputs/*/bind", {"rig"}},
    {"/inputs/*/bind/skeleton", {"rig"}, true},
    {"/inputs/*/pose", {"pose"}},
    {"/base", {"place", "turn", "graft_skeleton"}},
    {"/ops", {}},
    {"/ops/*", {"place"}},
    {"/ops/*/place/turn_limit_deg", {"place", "turn"}},
    {"/ops/*/blend", {"turn", "select", "field"}},
    {"/ops/*/surface/voxel_factor", {"turn", "select", "field"}},
    {"/ops/*/surface/voxel", {"turn", "select", "field"}},
    {"/ops/*/surface/presence_smoothing", {"turn", "select"}},
    {"/ops/*/surface/hardness", {"turn", "select"}},
    {"/ops/*/surface/include_parent", {"turn", "select"}},
    {"/ops/*/surface/keep_or_drop", {"turn", "select"}},
    {"/ops/*/surface/elements", {"junction"}},
    {"/ops/*/surface/smoothing", {"junction"}},
    {"/surface/voxel_factor", {"turn", "select", "field"}},
    {"/surface/voxel", {"turn", "select", "field"}},
    {"/surface/presence_smoothing", {"turn", "select"}},
    {"/surface/hardness", {"turn", "select"}},
    {"/surface/include_parent", {"turn", "select"}},
    {"/surface/keep_or_drop", {"turn", "select"}},
    {"/surface/elements", {"junction"}},
    {"/surface/smoothing", {"junction"}},
    {"/animation/clips", {"pictures"}},
    {"/animation/complete", {"complete_clip"}},
    {"/animation/method", {"complete_clip"}},
    {"/animation/rate_hz", {"complete_clip"}},
    {"/animation/tempo", {"complete_clip"}},
    {"/animation/limb_phase", {"complete_clip"}},
    {"/animation/limb_clearing_deg", {"complete_clip"}},
    {"/animation/key_tolerance", {"complete_clip"}},
    {"/animation/per_clip", {"complete_clip"}},
    {"/correctives", {"correct"}},
    {"/correctives/examples", {"rig"}, true},
    {"/output/glb", {}},
    {"/output/obj", {}},
    {"/output/vdb", {}},
    {"/output/animated", {}},
    {"/output/influences", {"bind", "correct", "expect"}},
    {"/expect", {"expect"}},
    {"/expect/golden", {"report"}, true},
    {"/expect/golden/file", {"report"}, true},
    {"/expect/golden/geometry", {"compare"}},
    {"/expect/golden/normals", {"compare"}},
    {"/expect/golden/uv", {"compare"}},
    {"/expect/golden/weights", {"compare"}},
    {"/expect/golden/animation", {"compare"}},
    {"/expect/golden/duration", {"compare"}},
    {"/expect/golden/picture", {"compare"}},
    {"/expect/golden/structure", {"compare"}},
};

// "/ops/0/place/scale" is below "/ops/*" and "/ops/*/place".
bool is_at_or_below(std::string_view setting, std::string_view property) {
  for (;;) {
    if (matches_pattern(property, setting)) return true;
    const auto slash = setting.rfind('/');
    if (slash == std::string_view::npos || slash == 0) return false;
    setting = setting.substr(0, slash);
  }
}

// The n-th step of a pointer, from 0.
std::string_view step(std::string_view pointer, int n) {
  for (; n > 0; --n) pointer.remove_prefix(std::min(pointer.find('/', 1), pointer.size()));
  pointer.remove_prefix(std::min<std::size_t>(1, pointer.size()));
  return pointer.substr(0, pointer.find('/'));
}

// Whether a stage of one input or operation is that of the setting.
bool is_of_instance(const StageInfo& stage, std::string_view setting) {
  const bool is_of_input =
      stage.name == "import" || stage.name == "rig" || stage.name == "pose" || stage.name == "adopt";
  if (is_of_input && setting.starts_with("/inputs/")) return step(setting, 1) == stage.instance;
  if (stage.name == "field" && setting.starts_with("/ops/"))
    return std::to_string(std::stoul(fmt::format("0{}", step(setting, 1))) + 1) == stage.instance;
  return true;
}

// Takes "/inputs/<name>/recipe" off for each step "<name>/" of the stage's prefix; none when they differ.
std::optional<std::string_view> setting_inside(std::string_view prefix, std::string_view setting) {
  while (!prefix.empty()) {
    const std::string_view input = prefix.substr(0, prefix.find('/'));
    const std::string outer = "/inputs/" + std::string(input) + "/recipe/";
    if (!setting.starts_with(outer)) return std::nullopt;
    setting.remove_prefix(outer.size() - 1);
    prefix.remove_prefix(input.size() + 1);
  }
  return setting;
}
}  // namespace

std::span<const StageSetting> stage_settings() {
  return kSettings;
}

bool reads_setting(const StageInfo& stage, std::string_view setting) {
  const auto inside = setting_inside(stage.prefix(), setting);
  if (!inside) return false;
  const StageSetting* best = nullptr;
  for (const StageSetting& row : kSettings)
    if (is_at_or_below(*inside, row.property) && (!best || row.property.size() > best->property.size()))
      best = &row;
  const bool is_named =
      best && std::find(best->stages.begin(), best->stages.end(), stage.name) != best->stages.end();
  if (is_named) return is_of_instance(stage, *inside);
  const bool is_budget = inside->starts_with("/expect");  // judges the result, changes nothing in it
  const bool writes_digest = stage.name == "export" || stage.name == "report" || stage.name == "preview";
  return writes_digest && !is_budget && !(best && best->is_path);
}

std::optional<std::string> setting_of_source(std::string_view artifact) {
  constexpr std::string_view kFile = "file:";
  const std::size_t colon = artifact.find(':');
  const std::size_t slash = artifact.substr(0, colon).rfind('/');
  std::string_view prefix = artifact.substr(0, slash == std::string_view::npos ? 0 : slash + 1);
  std::string_view name = artifact.substr(prefix.size());
  std::string pointer;
  for (; !prefix.empty(); prefix.remove_prefix(prefix.find('/') + 1))
    pointer += "/inputs/" + std::string(prefix.substr(0, prefix.find('/'))) + "/recipe";
  if (name == "golden") return pointer + "/expect/golden";
  if (!name.starts_with(kFile)) return std::nullopt;
  name = name.substr(kFile.size(), name.rfind(':') - kFile.size());
  return pointer + "/inputs/" + std::string(name);
}

}  // namespace skinforge
