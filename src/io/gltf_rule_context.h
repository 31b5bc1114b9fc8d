#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/limits.h"
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
  /// The numbers of an accessor, read once. Throws Error (BadInput) where few bytes ask for too many.
  const GltfValues& values(std::size_t accessor) {
    const std::size_t numbers = document.accessors[accessor].count * document.accessors[accessor].components;
    asked_ += numbers;
    if (asked_ > kMostAsked) fail(accessor, fmt::format("{} numbers are asked for up to here", asked_));
    const auto found = values_.find(accessor);
    if (found != values_.end()) return found->second;
    read_ += numbers;
    if (read_ > limits().keys)
      fail(accessor, fmt::format("{} numbers up to here, {}", read_, limit_hint("keys")));
    return values_.emplace(accessor, GltfAccessors::values(document.accessors[accessor])).first->second;
  }
  static std::string accessor_pointer(std::size_t accessor) {
    return "/accessors/" + std::to_string(accessor);
  }

  const GltfDocument& document;
  std::vector<GltfFinding> findings;

 private:
  static constexpr std::uint64_t kMostAsked = std::uint64_t{1} << 31;  // ours: ten of the largest files

  [[noreturn]] void fail(std::size_t accessor, const std::string& message) const {
    document.root.get("accessors").at(accessor).fail(message);
  }

  std::map<std::size_t, GltfValues> values_;
  std::uint64_t asked_ = 0, read_ = 0;  ///< numbers, each time and once
};

void check_nodes_and_skins(GltfRules& rules);
void check_meshes(GltfRules& rules);
void check_animations(GltfRules& rules);
/// Every accessor: numbers that are none, declared bounds.
void check_accessors(GltfRules& rules);

}  // namespace skinforge
