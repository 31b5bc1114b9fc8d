#pragma once

#include <string>
#include <string_view>

#include "base/archive.h"

namespace skinforge {

/// Whether a URI carries its data itself ("data:...").
bool is_data_uri(std::string_view uri);

/// The bytes of a base64 data URI, strictly read (RFC 2397, RFC 4648). Throws Error (BadInput).
Bytes decode_data_uri(std::string_view uri);

/// The path of a file that the asset at `asset_path` names by `uri`: percent-decoded once, inside the asset's
/// own folder. Refuses (Error, BadInput) schemes, absolute paths, "..", backslashes, NUL and control
/// characters. Whether there is such a file is not looked at.
std::string resolve_uri(std::string_view asset_path, std::string_view uri);

/// The same for a name that is not percent-encoded (OBJ, MTL).
std::string resolve_name(std::string_view asset_path, std::string_view name);

}  // namespace skinforge
