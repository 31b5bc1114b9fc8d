#include "stages/file_facts.h"

#include <map>

#include "io/file_kind.h"
#include "io/glb_container.h"
#include "io/glb_provenance.h"
#include "io/gltf_rules.h"

namespace skinforge {

namespace {
std::vector<BrokenRule> broken_rules(const std::vector<InputFile>& files) {
  std::map<std::pair<std::string, bool>, std::size_t> counts;
  for (const GltfFinding& finding : check_gltf(files))
    ++counts[{finding.code, finding.level == GltfFinding::Level::Error}];
  std::vector<BrokenRule> broken;
  for (const auto& [rule, count] : counts) broken.push_back({rule.first, rule.second, count});
  return broken;
}
}  // namespace

FileFacts facts_of(const std::vector<InputFile>& files) {
  const InputFile& model = files.front();
  FileFacts facts{.bytes = model.bytes.size()};
  const std::string ending = lower_extension(model.path);
  if (ending == ".glb" || ending == ".gltf") facts.broken = broken_rules(files);
  if (is_glb(model.bytes)) facts.provenance = provenance_text(model.bytes);
  return facts;
}

}  // namespace skinforge
