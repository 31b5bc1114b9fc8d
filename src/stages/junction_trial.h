#pragma once

#include <string>
#include <vector>

#include "stages/artifacts.h"
#include "stages/placed_sources.h"
#include "surface/preserved.h"

namespace skinforge {

/// How the parts of a recipe would join if they were placed in some way: what the stages from
/// `graft_skeleton` to `junction` make of one operation.
class JunctionTrial {
 public:
  struct Setting {
    std::vector<const Character*> characters;  ///< one per input
    std::vector<std::string> inputs;           ///< their names
    std::size_t base = 0;
    std::vector<CutOptions> cuts;      ///< per operation
    std::vector<FieldOptions> fields;  ///< per operation
    PreserveOptions preserve = {};
  };
  explicit JunctionTrial(Setting setting) : setting_(std::move(setting)) {}

  /// S_R after the first `count` operations.
  Graft graft(const PlacedOperations& placed, std::size_t count) const;

  /// What is wrong with the junction that the blended field gives operation `site` after those before it,
  /// blended by `op`; empty when it is sound, or when there is nothing to blend.
  std::string fault(const PlacedOperations& placed, std::size_t site, BlendOperator op) const;

 private:
  Setting setting_;
};

}  // namespace skinforge
