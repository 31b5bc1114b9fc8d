#include "pipeline/stage_key.h"

namespace skinforge {

StageKey stage_key(const Stage& stage, const StageInfo& info, const std::string& build,
                   const std::vector<Digest>& inputs) {
  StageKey key{.digest = {}, .build = build, .parameters = {}, .inputs = {}};
  Hasher parameters;
  parameters.log_to(key.parameters);
  stage.add_to_key(parameters);

  Hasher hasher;
  hasher.add("build", build);
  hasher.add("stage", info.name);
  hasher.add_value("version", info.version);
  hasher.add("parameters", parameters.finish());
  hasher.add_value("writes", std::uint64_t{info.writes.size()});
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    hasher.add("input", inputs[i]);
    key.inputs.push_back({info.reads[i], inputs[i].hex()});
  }
  key.digest = hasher.finish();
  return key;
}

StageKey partial_stage_key(const Stage& stage, const StageInfo& info, const std::string& build,
                           const std::vector<std::optional<Digest>>& inputs) {
  StageKey key = stage_key(stage, info, build, {});
  key.digest = {};
  for (std::size_t i = 0; i < inputs.size(); ++i)
    key.inputs.push_back({info.reads[i], inputs[i] ? inputs[i]->hex() : std::string()});
  return key;
}

}  // namespace skinforge
