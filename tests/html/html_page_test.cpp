#include "html/html_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "base/base64.h"

namespace skinforge {
namespace {
using ::testing::HasSubstr;
using ::testing::Not;

HtmlPage small_page() {
  return {.kind = "build",
          .title = "a <b> & \"c\"",
          .json = {{"report", R"({"joint": "</script><img src=x onerror=alert(1)>"})"}},
          .files = {{"model", {std::byte{'g'}, std::byte{'l'}}}},
          .pictures = {{"rest", {std::byte{0xFF}}}}};
}

Bytes bytes_of(const std::string& text) {
  const auto view = std::as_bytes(std::span(text));
  return {view.begin(), view.end()};
}

TEST(HtmlPage, TextsAreNeverMarkup) {
  const std::string text = html_page(small_page());
  EXPECT_THAT(text, HasSubstr("<title>a &lt;b> &amp; &quot;c&quot;</title>"));
  EXPECT_THAT(text, Not(HasSubstr("<img src=x")));
  EXPECT_THAT(text, HasSubstr(R"({"joint": "\u003c/script>\u003cimg src=x onerror=alert(1)>"})"));
}

TEST(HtmlPage, AnAtSignInAFileNameIsKept) {
  HtmlPage page = small_page();
  page.title = "@TITLE@ @SCRIPT@";
  EXPECT_THAT(html_page(page), HasSubstr("<title>@TITLE@ @SCRIPT@</title>"));
}

TEST(HtmlPage, FilesAreInside) {
  const std::string text = html_page(small_page());
  EXPECT_THAT(text, HasSubstr(R"(<script type="application/octet-stream" id="model">Z2w=</script>)"));
  EXPECT_THAT(text, HasSubstr("data:image/jpeg;base64,/w=="));
}

// Whatever a page names lies inside it, and the browser is told to fetch nothing else.
TEST(HtmlPage, NothingIsFetched) {
  const std::string text = html_page(small_page());
  EXPECT_THAT(text, HasSubstr("default-src 'none'"));
  EXPECT_FALSE(std::regex_search(text, std::regex(R"((src|href)\s*=\s*["']?(https?:|//))")));
  EXPECT_THAT(text, Not(HasSubstr("@import")));
}

// RFC 4648, section 10.
TEST(Base64, TheVectorsOfTheStandard) {
  for (const auto& [plain, coded] : {std::pair{"", ""},
                                     {"f", "Zg=="},
                                     {"fo", "Zm8="},
                                     {"foo", "Zm9v"},
                                     {"foob", "Zm9vYg=="},
                                     {"fooba", "Zm9vYmE="},
                                     {"foobar", "Zm9vYmFy"}})
    EXPECT_EQ(base64(bytes_of(plain)), coded);
}

}  // namespace
}  // namespace skinforge
