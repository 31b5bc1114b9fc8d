#include "report/build_verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "report/junit.h"

namespace skinforge {
namespace {
using nlohmann::json;
using ::testing::HasSubstr;

std::vector<BuildVerdict> two() {
  BuildVerdict good;
  good.label = good.recipe = "a.json";
  good.stages = 9, good.hits = 4, good.seconds = 1.25;
  good.warnings.push_back({"part-left-behind", Severity::Warning, "input horse", "a hoof"});
  BuildVerdict bad;
  bad.label = "b.json body=<x>", bad.recipe = "dir,1/b.json";
  bad.line = 3, bad.column = 5;
  bad.code = ExitCode::BadInput;
  bad.error = "dir,1/b.json:3:5: 100 % \"gone\" | now";
  bad.stage = "import horse";
  return {good, bad};
}

TEST(BuildVerdict, Junit) {
  EXPECT_EQ(junit_xml(two()), R"(<?xml version="1.0" encoding="UTF-8"?>
<testsuites>
  <testsuite name="recipes" tests="2" failures="1" time="1.250">
    <testcase classname="recipes" name="a.json" time="1.250"/>
    <testcase classname="recipes" name="b.json body=&lt;x&gt;" time="0.000">
      <failure type="bad-input" message="dir,1/b.json:3:5: 100 % &quot;gone&quot; | now"/>
    </testcase>
  </testsuite>
</testsuites>
)");
}

TEST(BuildVerdict, JunitSuitesKeepTogether) {
  const std::string xml = junit_xml(
      std::vector<TestCase>{{"a", "1", "", "", 0}, {"b", "2", "", "", 0}, {"a", "3", "x\x01", "k", 0}});
  EXPECT_THAT(xml, HasSubstr("name=\"a\" tests=\"2\" failures=\"1\""));
  EXPECT_THAT(xml, HasSubstr("message=\"x?\""));
}

TEST(BuildVerdict, Sarif) {
  const json log = json::parse(sarif(two(), "1.0"));
  const json& run = log.at("runs").at(0);
  EXPECT_EQ(run.at("tool").at("driver").at("rules").size(), 2U);
  const json& warning = run.at("results").at(0);
  EXPECT_EQ(warning.at("ruleId"), "part-left-behind");
  EXPECT_EQ(warning.at("level"), "warning");
  const json& error = run.at("results").at(1);
  EXPECT_EQ(error.at("ruleId"), "bad-input");
  const json& place = error.at("locations").at(0).at("physicalLocation");
  EXPECT_EQ(place.at("artifactLocation").at("uri"), "dir,1/b.json");
  EXPECT_EQ(place.at("region").at("startLine"), 3);
}

TEST(BuildVerdict, GithubAnnotationsAreEscaped) {
  EXPECT_EQ(github_annotations(two()),
            "::error file=dir%2C1/b.json,line=3,col=5,title=b.json body=<x>::dir,1/b.json:3:5: 100 %25 "
            "\"gone\" | now\n");
}

TEST(BuildVerdict, SummaryNamesWhatFailedFirst) {
  const std::string text = markdown_summary(two());
  EXPECT_THAT(text, HasSubstr("1 of 2 recipes built"));
  EXPECT_THAT(text,
              HasSubstr("| b.json body=<x> | import horse | dir,1/b.json:3:5: 100 % \"gone\" \\| now |"));
  EXPECT_THAT(text, HasSubstr("| a.json | ok | 9 | 4 | 1 | 1.2 |"));
}

}  // namespace
}  // namespace skinforge
