#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace skinforge {

/// One property of the recipe's schema.
struct SchemaProperty {
  std::string pattern;  ///< JSON pointer with * for names and indices: "/ops/*/place/scale"
  std::string description = {};
  std::optional<std::string> preset = {};  ///< default, as JSON
  std::optional<std::string> unit = {};
  std::vector<std::string> examples = {};  ///< as JSON
};

/// Every property of recipe_schema(), in its order, each once.
const std::vector<SchemaProperty>& schema_properties();

/// Whether a JSON pointer is of that pattern.
bool matches_pattern(std::string_view pattern, std::string_view pointer);

/// What a recipe that does not set `pointer` has there, as JSON; none where there is no default.
std::optional<std::string> default_text(const std::string& pointer);

}  // namespace skinforge
