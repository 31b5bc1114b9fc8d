#pragma once

#include <filesystem>
#include <optional>

#include "base/hash.h"

namespace skinforge {

/// SHA-256 of a file's bytes, read piece by piece; none when it cannot be read. Links are followed.
std::optional<Digest> sha256_of_file(const std::filesystem::path& path);

}  // namespace skinforge
