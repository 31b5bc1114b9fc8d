#include "base/share_text.h"

#include <charconv>

namespace skinforge {

std::optional<double> parse_share(std::string_view text) {
  const bool is_percent = text.ends_with('%');
  if (is_percent) text.remove_suffix(1);
  double value = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value >= 0 && value <= kMaxShare))
    return std::nullopt;
  return is_percent ? value / 100 : value;
}

}  // namespace skinforge
