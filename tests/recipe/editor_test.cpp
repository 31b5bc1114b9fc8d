#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "testing/assets.h"
#include "testing/program.h"

// Goal 20: an editor offers every key of a recipe where it may stand, and says what it is.
namespace skinforge {
namespace {
using ::testing::IsEmpty;

TEST(Editor, Goal20EveryPropertyIsOfferedAndExplained) {
  const char* given = std::getenv("NODE_PATH");
  const std::string modules =
      std::string(given ? given : "") + ":" + testing::repository_file("build/node/node_modules");
  const auto result = testing::Program("/usr/bin/env",
                                       {"node", testing::repository_file("tests/recipe/check_editor.cjs"),
                                        testing::repository_file("schemas/recipe.schema.json")},
                                       ".", {{"NODE_PATH", modules}})
                          .finish();
  if (result.status == 3 || result.status == 127)
    GTEST_SKIP() << "LANGUAGE SERVICE ABSENT: npm install vscode-json-languageservice into build/node, or "
                    "set NODE_PATH";
  ASSERT_EQ(result.status, 0) << result.err;
  const auto seen = nlohmann::json::parse(result.out);
  EXPECT_GT(seen.at("properties"), 100);
  EXPECT_THAT(seen.at("not_offered"), IsEmpty()) << seen.at("not_offered");
  EXPECT_THAT(seen.at("not_explained"), IsEmpty()) << seen.at("not_explained");
}

}  // namespace
}  // namespace skinforge
