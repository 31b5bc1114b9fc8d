// The only unit of these tests that includes valijson, which is slow to compile.
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "report/report_json.h"
#include "report/sample_report.h"
#include "testing/assets.h"

namespace skinforge {
namespace {

using nlohmann::json;

/// What the schema says against a document; empty when nothing.
std::string complaints(const json& document) {
  const json text = json::parse(report_schema());
  valijson::Schema schema;
  valijson::SchemaParser parser;
  parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(text), schema);
  valijson::Validator validator;
  valijson::ValidationResults results;
  const valijson::adapters::NlohmannJsonAdapter target(document);
  if (validator.validate(schema, target, &results)) return "";
  std::string all;
  for (valijson::ValidationResults::Error error; results.popError(error);)
    all += fmt::format("{}: {}\n", fmt::join(error.context, ""), error.description);
  return all;
}

TEST(ReportSchema, SampleReportIsValid) {
  EXPECT_EQ(complaints(json::parse(to_json(testing::sample_report()))), "");
}

TEST(ReportSchema, EmptyReportIsValid) {
  EXPECT_EQ(complaints(json::parse(to_json(Report{}))), "");
}

TEST(ReportSchema, FaultsAreFound) {
  const json good = json::parse(to_json(testing::sample_report()));
  json bad = good;
  bad["mesh"].erase("faces");
  EXPECT_NE(complaints(bad), "");
  bad = good;
  bad["mesh"]["surprise"] = 1;
  EXPECT_NE(complaints(bad), "");
  bad = good;
  bad["ledger"][0]["state"] = "lost";
  EXPECT_NE(complaints(bad), "");
  bad = good;
  bad["operations"][0]["rotation_xyzw"] = {1, 2, 3};
  EXPECT_NE(complaints(bad), "");
  bad = good;
  bad["clips"][0]["keys"] = "many";
  EXPECT_NE(complaints(bad), "");
}

// Every property at every depth says what it means and in which unit.
void expect_described(const json& schema, const std::string& where) {
  if (schema.contains("items")) expect_described(schema["items"], where + "[]");
  if (!schema.contains("properties")) return;
  for (const auto& [name, property] : schema["properties"].items()) {
    EXPECT_GT(property.value("description", "").size(), 5U) << where << "/" << name;
    EXPECT_NE(property.value("unit", ""), "") << where << "/" << name;
    expect_described(property, where + "/" + name);
  }
}

TEST(ReportSchema, EveryPropertySaysMeaningAndUnit) {
  expect_described(json::parse(report_schema()), "");
}

TEST(ReportSchema, FileInTheRepositoryIsUpToDate) {
  std::ifstream file(testing::repository_file("schemas/report.schema.json"));
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), report_schema())
      << "write it anew: skinforge schema report > schemas/report.schema.json";
}

}  // namespace
}  // namespace skinforge
