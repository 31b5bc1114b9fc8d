#include <gmock/gmock.h>

#include <cstdlib>

#include "testing/assets.h"

namespace skinforge {
namespace {

// The page is made from the sources, so a new code needs the script to be run once.
TEST(IssueCodes, PageIsUpToDate) {
  const std::string script = testing::repository_file("scripts/list_issue_codes.py");
  EXPECT_EQ(std::system(("python3 '" + script + "' --check").c_str()), 0);
}

}  // namespace
}  // namespace skinforge
