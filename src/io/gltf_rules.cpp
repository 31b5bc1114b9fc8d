#include "io/gltf_rules.h"

#include "base/error.h"
#include "io/gltf_rule_context.h"

namespace skinforge {

namespace {
// Files that images name and that are not there.
void check_images(const std::vector<InputFile>& files, GltfRules& rules) {
  for (const JsonPlace& image : rules.document.root.objects("images")) {
    const std::string uri = image.text_or("uri", "");
    if (!uri.empty() && !uri.starts_with("data:") && !find_file(files, uri))
      rules.error("IO_ERROR", image.place() + "/uri", "no such file");
  }
}
}  // namespace

std::vector<GltfFinding> check_gltf(const std::vector<InputFile>& files) try {
  IssueSink issues;
  const GltfDocument document = open_gltf(files, issues);
  GltfRules rules(document);
  check_nodes_and_skins(rules);
  check_accessors(rules);
  check_meshes(rules);
  check_animations(rules);
  check_images(files, rules);
  return std::move(rules.findings);
} catch (const Error& error) {
  return {{GltfFinding::Level::Error, "GLTF_UNREADABLE", "", error.what()}};
}

}  // namespace skinforge
