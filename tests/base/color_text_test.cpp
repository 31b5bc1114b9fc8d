#include "base/color_text.h"

#include <gtest/gtest.h>

namespace skinforge {
namespace {

TEST(ParseColor, SixHexadecimalDigits) {
  EXPECT_EQ(parse_color("#ff8001"), (Color8{255, 128, 1}));
  EXPECT_EQ(parse_color("#FF8001"), (Color8{255, 128, 1}));
  for (const char* text : {"", "ff8001", "#ff80", "#ff80011", "#ff80-1", "#gg0000", "# f0000"})
    EXPECT_FALSE(parse_color(text)) << text;
}

}  // namespace
}  // namespace skinforge
