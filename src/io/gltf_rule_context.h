#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "io/gltf_document.h"
#include "io/gltf_rules.h"

/// What the files of rules (gltf_rules_*.cpp) share.
namespace skinforge {

/// Unit length is met within this: what rounding of normals and quaternions to 8 bits leaves. Source: the
/// thresholds of the Khronos validator.
inline constexpr double kUnitVector = 0.00674, kUnitQuaternion = 0.00769;

class GltfRules {
 public:
  explicit GltfRules(const GltfDocument& gltf) : document(gltf) {}

  void error(const char* code, const std::string& pointer, const std::string& message) {
    findings.push_back({GltfFinding::Level::Error, code, pointer, message});
  }
  void warning(const char* code, const std::string& pointer, const std::string& message) {
    findings.push_back({GltfFinding::Level::Warning, code, pointer, message});
  }
  /// The numbers of an accessor, once each.
  const GltfValues& values(std::size_t accessor) {
    const auto found = values_.find(accessor);
    if (found != values_.end()) return found->second;
    return values_.emplace(accessor, GltfAccessors::values(document.accessors[accessor])).first->second;
  }
  static std::string accessor_pointer(std::size_t accessor) {
    return "/accessors/" + std::to_string(accessor);
  }

  const GltfDocument& document;
  std::vector<GltfFinding> findings;

 private:
  std::map<std::size_t, GltfValues> values_;
};

void check_nodes_and_skins(GltfRules& rules);
void check_meshes(GltfRules& rules);
void check_animations(GltfRules& rules);
/// Every accessor: numbers that are none, declared bounds.
void check_accessors(GltfRules& rules);

}  // namespace skinforge
