#include "base/share_text.h"

#include <gtest/gtest.h>

namespace skinforge {
namespace {

TEST(ShareText, ReadsNumbersAndPercentages) {
  EXPECT_EQ(parse_share("0.05%"), 0.0005);
  EXPECT_EQ(parse_share("2"), 2);
  EXPECT_EQ(parse_share("1e-5"), 1e-5);
  EXPECT_EQ(parse_share("0%"), 0);
}

TEST(ShareText, RefusesWhatIsNoShare) {
  for (const char* text : {"", "%", "-1", "a", "1 %", "1%%", "nan", "inf", "1e300", " 1", "0,5"})
    EXPECT_EQ(parse_share(text), std::nullopt) << text;
}
}  // namespace
}  // namespace skinforge
