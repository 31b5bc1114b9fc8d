#pragma once

#include <optional>
#include <string_view>

namespace skinforge {

constexpr double kMaxShare = 1e9;  // ours: keeps products finite

/// "0.05%" or "0.0005": a share from 0 to `kMaxShare`; none for anything else.
std::optional<double> parse_share(std::string_view text);

}  // namespace skinforge
