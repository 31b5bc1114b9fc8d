#include "report/build_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "report/junit.h"

namespace skinforge {
using nlohmann::json;

namespace {
bool is_failed(const BuildVerdict& verdict) {
  return verdict.code != ExitCode::Ok;
}

// GitHub's escapes for the message and, `is_property`, for the fields before it.
std::string escaped(const std::string& text, bool is_property) {
  std::string result;
  for (const char c : text) {
    if (c == '%' || c == '\n' || c == '\r' || (is_property && (c == ':' || c == ',')))
      result += fmt::format("%{:02X}", static_cast<unsigned>(c));
    else
      result += c;
  }
  return result;
}

// Text in a cell of a Markdown table.
std::string cell(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '|' ? "\\|" : c == '\n' ? std::string(" ") : std::string(1, c);
  return result;
}

json location(const BuildVerdict& verdict, int line, int column) {
  return {{"physicalLocation",
           {{"artifactLocation", {{"uri", verdict.recipe}}},
            {"region", {{"startLine", line}, {"startColumn", column}}}}}};
}

json result(const BuildVerdict& verdict, const std::string& rule, const char* level,
            const std::string& message, int line, int column) {
  return {{"ruleId", rule},
          {"level", level},
          {"message", {{"text", message}}},
          {"locations", json::array({location(verdict, line, column)})}};
}
}  // namespace

std::string rule_name(ExitCode code) {
  switch (code) {
    case ExitCode::Ok:
      return "ok";
    case ExitCode::StageFailed:
      return "stage-failed";
    case ExitCode::Usage:
      return "recipe";
    case ExitCode::BadInput:
      return "bad-input";
    case ExitCode::Invalid:
      return "not-valid";
    case ExitCode::Different:
      return "different";
    case ExitCode::SomeFailed:
      return "some-failed";
    case ExitCode::NotReproducible:
      return "not-reproducible";
    case ExitCode::Internal:
      break;
  }
  return "internal";
}

std::string sarif(const std::vector<BuildVerdict>& verdicts, const std::string& tool_version) {
  json results = json::array(), rules = json::array();
  std::set<std::string> names;
  for (const BuildVerdict& verdict : verdicts) {
    if (is_failed(verdict)) {
      names.insert(rule_name(verdict.code));
      results.push_back(
          result(verdict, rule_name(verdict.code), "error", verdict.error, verdict.line, verdict.column));
    }
    for (const Issue& issue : verdict.warnings) {
      names.insert(issue.code);
      results.push_back(result(verdict, issue.code, "warning", issue.place + ": " + issue.message, 1, 1));
    }
  }
  for (const std::string& name : names) rules.push_back({{"id", name}});
  const json driver = {{"name", "skinforge"}, {"version", tool_version}, {"rules", std::move(rules)}};
  const json document = {
      {"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
      {"version", "2.1.0"},
      {"runs", json::array({{{"tool", {{"driver", driver}}}, {"results", std::move(results)}}})}};
  return document.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

std::string github_annotations(const std::vector<BuildVerdict>& verdicts) {
  std::string text;
  for (const BuildVerdict& verdict : verdicts)
    if (is_failed(verdict))
      text += fmt::format("::error file={},line={},col={},title={}::{}\n", escaped(verdict.recipe, true),
                          verdict.line, verdict.column, escaped(verdict.label, true),
                          escaped(verdict.error, false));
  return text;
}

std::string markdown_summary(const std::vector<BuildVerdict>& verdicts) {
  const auto failed = std::count_if(verdicts.begin(), verdicts.end(), is_failed);
  std::string text = fmt::format("# SkinForge: {} of {} recipes built\n\n",
                                 verdicts.size() - static_cast<std::size_t>(failed), verdicts.size());
  if (failed > 0) text += "| failed | stage | why |\n|---|---|---|\n";
  for (const BuildVerdict& verdict : verdicts)
    if (is_failed(verdict))
      text +=
          fmt::format("| {} | {} | {} |\n", cell(verdict.label), cell(verdict.stage), cell(verdict.error));
  text += fmt::format(
      "{}| recipe | result | stages | from the cache | warnings | seconds |\n|---|---|---|---|---|---|\n",
      failed > 0 ? "\n" : "");
  for (const BuildVerdict& verdict : verdicts)
    text += fmt::format("| {} | {} | {} | {} | {} | {:.1f} |\n", cell(verdict.label),
                        is_failed(verdict) ? "**" + rule_name(verdict.code) + "**" : "ok", verdict.stages,
                        verdict.hits, verdict.warnings.size(), verdict.seconds);
  return text;
}

std::string junit_xml(const std::vector<BuildVerdict>& verdicts) {
  std::vector<TestCase> cases;
  for (const BuildVerdict& verdict : verdicts)
    cases.push_back({"recipes", verdict.label, verdict.error, rule_name(verdict.code), verdict.seconds});
  return junit_xml(cases);
}

}  // namespace skinforge
