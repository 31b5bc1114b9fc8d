#include "diff/file_diff.h"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

namespace skinforge {
using nlohmann::json;

namespace {
constexpr std::size_t kDigits = 12;  // of a digest, as in other messages

// Members by what they are called in a sentence, with their values as text.
using Members = std::map<std::string, std::string>;

std::string text_in(const json& object, const char* key) {
  const auto member = object.is_object() ? object.find(key) : object.end();
  return member != object.end() && member->is_string() ? member->get<std::string>() : std::string();
}

void add_inputs(const json& inputs, Members& members) {
  if (!inputs.is_object()) return;
  for (const auto& [input, files] : inputs.items())
    for (const json& file : files)
      members[fmt::format("input \"{}\", file \"{}\"", input, text_in(file, "file"))] =
          text_in(file, "sha256").substr(0, kDigits);
}

Members members_of(const std::string& provenance) {
  Members members;
  const json document = json::parse(provenance, nullptr, false);
  if (!document.is_object()) return members;
  for (const auto& [key, value] : document.items()) {
    if (key == "content_sha256") continue;  // of the file itself: what this comparison is about
    if (key == "inputs")
      add_inputs(value, members);
    else if (key == "version" && value.is_string())
      members["tool version"] = value.get<std::string>();
    else if (key == "recipe_sha256" && value.is_string())
      members["recipe"] = value.get<std::string>().substr(0, kDigits);
    else if (value.is_string())
      members[key] = value.get<std::string>();
    else if (value.is_primitive())
      members[key] = value.dump();
  }
  return members;
}

}  // namespace

std::vector<std::string> compare_provenance(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return {};
  const Members of_a = members_of(a), of_b = members_of(b);
  std::vector<std::string> sentences;
  for (const auto& [name, was] : of_a) {
    const auto now = of_b.find(name);
    if (now == of_b.end())
      sentences.push_back(fmt::format("{}: {} -> none", name, was));
    else if (now->second != was)
      sentences.push_back(fmt::format("{}: {} -> {}", name, was, now->second));
  }
  for (const auto& [name, now] : of_b)
    if (!of_a.contains(name)) sentences.push_back(fmt::format("{}: none -> {}", name, now));
  return sentences;
}

std::vector<RuleDelta> compare_rules(const FileFacts& a, const FileFacts& b) {
  if (!a.broken || !b.broken) return {};
  std::map<std::pair<std::string, bool>, RuleDelta> rules;
  const auto at = [&](const BrokenRule& broken) -> RuleDelta& {
    RuleDelta& rule = rules[{broken.code, broken.is_error}];
    rule.code = broken.code;
    rule.is_error = broken.is_error;
    return rule;
  };
  for (const BrokenRule& broken : *a.broken) at(broken).in_a += broken.count;
  for (const BrokenRule& broken : *b.broken) at(broken).in_b += broken.count;
  std::vector<RuleDelta> deltas;
  for (auto& [key, rule] : rules)
    if (rule.in_a != rule.in_b) deltas.push_back(std::move(rule));
  return deltas;
}

std::vector<std::string> edits_of(const std::vector<RuleDelta>& rules) {
  std::vector<std::string> edits;
  for (const RuleDelta& rule : rules)
    if (rule.is_error && rule.in_a == 0) edits.push_back(fmt::format("glTF error {} is new", rule.code));
  return edits;
}

}  // namespace skinforge
