#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace skinforge {

/// Up to `count` of `names`, nearest to `wanted` first by edit distance (case ignored); names with nothing in
/// common are left out. For "did you mean".
std::vector<std::string> nearest_names(std::string_view wanted, std::span<const std::string> names,
                                       std::size_t count = 3);

/// ` (nearest: "A", "B")`, or an empty string when no name comes near.
std::string nearest_hint(std::string_view wanted, std::span<const std::string> names);

/// `text` with control characters and bytes that are not UTF-8 written as \xNN, so that one message stays one
/// line.
std::string printable(std::string_view text);

}  // namespace skinforge
