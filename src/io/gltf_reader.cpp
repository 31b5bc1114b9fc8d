#include "io/gltf_reader.h"

#include <set>

#include "base/error.h"
#include "base/text.h"
#include "io/gltf_animations.h"
#include "io/gltf_document.h"
#include "io/gltf_materials.h"
#include "io/gltf_meshes.h"
#include "io/gltf_nodes.h"

namespace skinforge {
namespace {

void add_repairable(const JsonPlace& attributes, std::set<std::size_t>& accessors) {
  for (const std::string& name : attributes.keys())
    if (name != "POSITION") accessors.insert(attributes.get(name).count());
}

/// Accessors whose values may be NaN or infinite because a build repairs them: vertex attributes but
/// positions.
std::set<std::size_t> repairable_accessors(const JsonPlace& root) {
  std::set<std::size_t> accessors;
  for (const JsonPlace& mesh : root.objects("meshes"))
    for (const JsonPlace& primitive : mesh.objects("primitives")) {
      add_repairable(primitive.get("attributes"), accessors);
      for (const JsonPlace& target : primitive.objects("targets")) add_repairable(target, accessors);
    }
  return accessors;
}

void check_numbers(const GltfDocument& document) {
  const auto repairable = repairable_accessors(document.root);
  for (std::size_t i = 0; i < document.accessors.size(); ++i)
    if (!repairable.contains(i)) GltfAccessors::check_finite(document.accessors[i]);
}

RawScene read_checked(const std::vector<InputFile>& files) {
  IssueSink issues;
  const GltfDocument document = open_gltf(files, issues);
  check_numbers(document);
  RawScene scene;
  read_materials(document, scene, issues);
  read_nodes(document, scene, issues);
  read_meshes(document, scene, issues);
  read_animations(document, scene, issues);
  scene.issues = issues.issues();
  return scene;
}

}  // namespace

RawScene read_gltf(const std::vector<InputFile>& files) {
  return with_context(printable(files.front().path), [&] { return read_checked(files); });
}

}  // namespace skinforge
