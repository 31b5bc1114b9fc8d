#include "report/report_json.h"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "report/sample_report.h"

namespace skinforge {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::sample_report;

std::vector<std::string> keys(const nlohmann::ordered_json& object) {
  std::vector<std::string> names;
  for (const auto& item : object.items()) names.push_back(item.key());
  return names;
}

TEST(ReportJson, KeysStandInTheDeclaredOrder) {
  const auto json = nlohmann::ordered_json::parse(to_json(sample_report()));
  EXPECT_THAT(keys(json), ElementsAre("report_version", "preview", "tool", "recipe", "inputs", "operations",
                                      "mesh", "weights", "junctions", "clips", "ledger", "joints",
                                      "joint_maps", "outputs", "golden", "issues"));
  EXPECT_THAT(keys(json["outputs"][0]), ElementsAre("name", "bytes", "sha256"));
}

TEST(ReportJson, ValuesByHand) {
  const auto json = nlohmann::json::parse(to_json(sample_report()));
  EXPECT_EQ(json["recipe"]["name"], "centaur");
  EXPECT_EQ(json["inputs"][0]["repairs"][0]["severity"], "note");
  EXPECT_EQ(json["operations"][0]["rotation_xyzw"], nlohmann::json({0.0, 0.6, 0.0, 0.8}));
  EXPECT_EQ(json["ledger"][1]["state"], "dropped");
  EXPECT_EQ(json["junctions"][0]["scaled_jacobian"]["p50"], 0.75);
  EXPECT_EQ(json["clips"][0]["completed_from"][0]["frames"], 31);
}

TEST(ReportJson, WhatWasNotMeasuredIsNull) {
  const auto json = nlohmann::json::parse(to_json(sample_report()));
  EXPECT_TRUE(json["junctions"][0]["folded_faces"].is_null());
  EXPECT_TRUE(json["junctions"][0]["border_dihedral"].is_null());
  EXPECT_EQ(json["junctions"][0]["self_intersections"], 0);
}

TEST(ReportJson, NumbersReadBackToTheSameBits) {
  Report report = sample_report();
  for (const double value : {0.1, 1.0 / 3, 1e-300, 123456789.123456789, 5e-324, -0.0}) {
    report.mesh.kept_share = value;
    const auto json = nlohmann::json::parse(to_json(report));
    EXPECT_EQ(std::signbit(json["mesh"]["kept_share"].get<double>()), std::signbit(value));
    EXPECT_EQ(json["mesh"]["kept_share"].get<double>(), value);
  }
  EXPECT_THAT(to_json(report), Not(HasSubstr("0.6000000000")));
}

TEST(ReportJson, ShortThingsTakeOneLine) {
  const std::string text = to_json(sample_report());
  EXPECT_THAT(text, HasSubstr("\"tool\": {\"name\": \"skinforge\", \"version\": \"9.9.9\"},\n"));
  EXPECT_THAT(text, EndsWith("}\n"));
}

TEST(ReportJson, BrokenTextIsAnInternalError) {
  Report report;
  report.recipe.name = "\xFF";
  try {
    to_json(report);
    FAIL() << "a byte that is no UTF-8 passed";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::Internal);
  }
}

TEST(ReportJson, TimingsByHand) {
  const Timings timings{1.5, 2.5, 1000, {{"import", "horse", "run", 0.25, 0.5, 900}}};
  const auto json = nlohmann::ordered_json::parse(to_json(timings));
  EXPECT_THAT(keys(json), ElementsAre("wall", "cpu", "peak_memory", "stages"));
  EXPECT_EQ(json["stages"][0]["subject"], "horse");
}

}  // namespace
}  // namespace skinforge
