#pragma once

#include <filesystem>

#include "recipe/value_tree.h"

namespace skinforge {

/// One tree of a file and those it builds on:
///  - `"extends": "base.json"` (or a list, the later over the earlier) at the root: this file's values are
///  laid
///    over the other's as a merge patch (RFC 7396): objects member by member, null takes away, the rest is
///    replaced;
///  - `{ "include": "file.json#/pointer", ... }` anywhere below: the value in that file takes its place,
///  other
///    members of the object laid over it; in a list, a list is spliced in.
/// Paths are relative to the file that names them, and values remember the file they come from. Throws Error:
/// Usage at the place of what leads to a circle or nowhere, or deeper than 16 files.
Value compose_file(const std::filesystem::path& path, const std::vector<std::string>& inputs_under = {});
/// The same where the text of the file is in hand.
Value compose(Value root, const std::filesystem::path& path,
              const std::vector<std::string>& inputs_under = {});

/// `patch` laid over `base` (RFC 7396). Members of `base` keep their order, new ones follow.
Value merged(Value base, const Value& patch);

/// The value that a JSON pointer (RFC 6901) leads to; null where it leads nowhere.
const Value* find_value(const Value& root, std::string_view pointer);

}  // namespace skinforge
