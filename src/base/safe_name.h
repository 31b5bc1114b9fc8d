#pragma once

#include <string>
#include <string_view>

namespace skinforge {

/// Whether `name` can be a file name anywhere: 1 to 120 of the characters A-Z a-z 0-9 . _ - + and space, not
/// starting with . - or a space, not ending with . or a space, and none of the names that Windows keeps for
/// devices (con, nul, com1, ...).
bool is_safe_file_name(std::string_view name);

/// Whether `path` is one or more safe file names joined by '/': relative, never leaving its folder.
bool is_safe_relative_path(std::string_view path);

/// A safe file name made of any text: other characters become '_'. Equal texts give equal names; different
/// texts may give the same one, so callers that need unique names number them. Never empty.
std::string safe_file_name(std::string_view text);

}  // namespace skinforge
