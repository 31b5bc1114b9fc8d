#include "base/limits.h"

#include <gmock/gmock.h>

#include "base/error.h"

namespace skinforge {
namespace {

using ::testing::HasSubstr;

std::string refusal(const std::string& text) {
  Limits limits;
  try {
    set_limit(limits, text);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::Usage);
    return error.what();
  }
  return "nothing was refused";
}

TEST(Limits, AreRaisedByName) {
  Limits limits;
  set_limit(limits, "vertices=20M");
  set_limit(limits, "file=3G");
  set_limit(limits, "import-seconds=60");
  set_limit(limits, "image-side=5K");
  EXPECT_EQ(limits.vertices, 20'000'000u);
  EXPECT_EQ(limits.file, 3ull << 30);
  EXPECT_EQ(limits.import_seconds, 60u);
  EXPECT_EQ(limits.image_side, 5'000u);
}

TEST(Limits, MistakesAreNamed) {
  EXPECT_THAT(refusal("vertexes=1"), HasSubstr("no limit is called \"vertexes\" (nearest: \"vertices\""));
  for (const char* text :
       {"vertices", "vertices=", "vertices=0", "vertices=-1", "vertices=1.5", "vertices=1k", "vertices=1GB",
        "vertices=99999999999999999999", "file=9999999999999G"})
    EXPECT_THAT(refusal(text), HasSubstr("expected a whole number from 1")) << text;
}

TEST(Limits, HintsSayHowToRaiseThem) {
  EXPECT_EQ(limit_hint("nodes"), "the limit is 65536; --limit nodes=N raises it");
  EXPECT_THAT(limit_table(), HasSubstr("import-seconds            10 s"));
}

}  // namespace
}  // namespace skinforge
