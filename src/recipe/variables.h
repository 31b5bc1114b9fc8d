#pragma once

#include <map>
#include <string>
#include <vector>

#include "recipe/value_tree.h"

namespace skinforge {

/// Values by name: the recipe's "vars", and "matrix" for the cell.
using Variables = std::map<std::string, Value>;

/// The variables of "vars" (may be null), with those that `set` overrides: "scale=1.2". A variable is a plain
/// value, or `{ "type", "default", "choices", "min", "max", "description" }`; a value from `set` must be of
/// its type and keep its limits. Words of `set` that start with "/" are left alone. Throws Error (Usage).
Variables read_variables(const Value* vars, const std::vector<std::string>& set);

/// The tree with `${name}`, `${name.member}` replaced. A string that is one reference becomes the value
/// itself, of whatever kind; inside longer strings values are written as text. `$${` writes `${`. Throws
/// Error (Usage) with the nearest name for one that is unknown, and for circles.
Value substituted(const Value& value, const Variables& variables);

/// The value of a "name=value" word: JSON where it is, else a string. `file`: whose folder paths are relative
/// to.
Value value_of_word(const std::string& word, const std::shared_ptr<const std::string>& file);

}  // namespace skinforge
