// Every file that once broke a parser, and the smallest that reach odd corners: tests/data/fuzz/TARGET/*.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "fuzz/targets.h"
#include "testing/assets.h"

namespace skinforge {
namespace {
namespace fs = std::filesystem;

TEST(FuzzFinds, AreResultsOrErrorsOfOneLine) {
  std::size_t files = 0;
  for (const auto& folder : fs::directory_iterator(testing::repository_file("tests/data/fuzz"))) {
    const fuzz::Target* target = fuzz::find_target(folder.path().filename().string());
    ASSERT_NE(target, nullptr) << folder.path();
    for (const auto& item : fs::directory_iterator(folder.path())) {
      SCOPED_TRACE(item.path());
      ++files;
      std::ifstream file(item.path(), std::ios::binary);
      const std::string text{std::istreambuf_iterator<char>(file), {}};
      EXPECT_EQ(fuzz::complaint(*target, std::as_bytes(std::span(text))), "");
    }
  }
  EXPECT_GT(files, 0u);
}

}  // namespace
}  // namespace skinforge
