#include "base/color_text.h"

#include <charconv>

namespace skinforge {

std::optional<Color8> parse_color(std::string_view text) {
  if (text.size() != 7 || text.front() != '#') return std::nullopt;
  Color8 color;
  for (std::size_t i = 0; i < color.size(); ++i) {
    const char* begin = text.data() + 1 + 2 * i;
    const auto [end, error] = std::from_chars(begin, begin + 2, color[i], 16);
    if (error != std::errc() || end != begin + 2) return std::nullopt;
  }
  return color;
}

}  // namespace skinforge
