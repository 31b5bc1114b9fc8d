#include "io/gltf_json.h"

#include <gmock/gmock.h>

#include "base/error.h"
#include "testing/glb_file.h"

namespace skinforge {
namespace {

using ::testing::HasSubstr;

std::string message(const std::string& text) {
  try {
    const Bytes bytes = testing::bytes_of(text);
    JsonDocument document{bytes};
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::BadInput);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "no error";
}

TEST(GltfJson, ReadsValuesWithTheirPlaces) {
  const Bytes bytes = testing::bytes_of(R"({"a":[{"n":3.0,"t":"x\u00e4","f":true,"v":[1,2.5]}]})");
  const JsonDocument document{bytes};
  const JsonPlace a = document.root().objects("a").at(0);
  EXPECT_EQ(a.place(), "/a/0");
  EXPECT_EQ(a.get("n").count(), 3u);
  EXPECT_EQ(a.get("t").text(), "x\xC3\xA4");
  EXPECT_TRUE(a.get("f").flag());
  EXPECT_EQ(a.get("v").numbers(2), (std::vector<double>{1, 2.5}));
  EXPECT_EQ(a.count_or("missing", 7), 7u);
  EXPECT_FALSE(a.find("missing"));
}

TEST(GltfJson, SaysWhereATextIsBroken) {
  EXPECT_THAT(message("{\n  \"a\": tru }"), HasSubstr("JSON line 2, column 11: "));
  EXPECT_THAT(message(R"({"a":1} x)"), HasSubstr("JSON line 1, column 9: "));
  EXPECT_THAT(message(R"({"a":1,"a":2})"), HasSubstr("key \"a\" twice"));
  EXPECT_THAT(message("\xEF\xBB\xBF{}"), HasSubstr("byte order mark"));
  EXPECT_THAT(message("{\"a\":\"\xFF\xFE\"}"), HasSubstr("ill-formed UTF-8"));
  EXPECT_THAT(message(R"({"a":1e999})"), HasSubstr("JSON line 1, column"));
  EXPECT_THAT(message(""), HasSubstr("JSON line 1, column 1"));
}

TEST(GltfJson, LimitsDepthOnBothSides) {
  const auto nested = [](std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  EXPECT_EQ(message(nested(64)), "no error");
  EXPECT_THAT(message(nested(65)), HasSubstr("more than 64 levels deep"));
  EXPECT_THAT(message(nested(1'000'000)), HasSubstr("more than 64 levels deep"));
}

TEST(GltfJson, RefusesNumbersThatAreNoCounts) {
  for (const char* number : {"-1", "0.5", "9007199254740994", "1e300", "\"1\"", "null"}) {
    const Bytes bytes = testing::bytes_of("{\"n\":" + std::string(number) + "}");
    const JsonDocument document{bytes};
    EXPECT_THROW(document.root().get("n").count(), Error) << number;
  }
}

}  // namespace
}  // namespace skinforge
