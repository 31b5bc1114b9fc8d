#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "pipeline/cache.h"
#include "pipeline/json_number.h"

namespace skinforge {
using nlohmann::json;

namespace {
constexpr int kFormat = 1;
constexpr std::string_view kMagic = "skinforge-manifest";

std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text));
}

std::string header(const Digest& key, std::string_view payload) {
  return fmt::format("{} {} {} {} {}\n", kMagic, kFormat, key.hex(), payload.size(),
                     sha256(bytes_of(payload)).hex());
}

json to_json(const std::vector<HashedField>& items) {
  json list = json::array();
  for (const HashedField& item : items) list.push_back({item.name, item.value});
  return list;
}

std::vector<HashedField> hashed_fields(const json& list) {
  std::vector<HashedField> items;
  for (const json& item : list) items.push_back({item.at(0), item.at(1)});
  return items;
}

json to_json(const std::vector<Manifest::Output>& outputs) {
  json list = json::array();
  for (const Manifest::Output& output : outputs)
    list.push_back({{"name", output.name}, {"sha256", output.digest.hex()}, {"size", output.size}});
  return list;
}

std::vector<Manifest::Output> outputs(const json& list) {
  std::vector<Manifest::Output> items;
  for (const json& item : list) {
    const auto digest = digest_from_hex(item.at("sha256").get<std::string>());
    if (!digest) throw Error(ExitCode::Internal, "not a digest");
    items.push_back({item.at("name"), *digest, whole_number(item.at("size"))});
  }
  return items;
}

json to_json(const std::vector<Issue>& issues) {
  json list = json::array();
  for (const Issue& issue : issues)
    list.push_back({{"code", issue.code},
                    {"warning", issue.severity == Severity::Warning},
                    {"place", issue.place},
                    {"message", issue.message}});
  return list;
}

std::vector<Issue> issues(const json& list) {
  std::vector<Issue> items;
  for (const json& item : list)
    items.push_back({item.at("code"), item.at("warning").get<bool>() ? Severity::Warning : Severity::Note,
                     item.at("place"), item.at("message")});
  return items;
}

json to_json(const Manifest& m) {
  return {{"build", m.build},
          {"stage", m.stage},
          {"instance", m.instance},
          {"version", m.version},
          {"parameters", to_json(m.parameters)},
          {"inputs", to_json(m.inputs)},
          {"outputs", to_json(m.outputs)},
          {"issues", to_json(m.issues)},
          {"cost",
           {{"wall_seconds", m.cost.wall_seconds},
            {"cpu_seconds", m.cost.cpu_seconds},
            {"peak_bytes", m.cost.peak_bytes}}}};
}

Manifest manifest(const json& j, const Digest& key) {
  Manifest m;
  m.key = key;
  m.build = j.at("build");
  m.stage = j.at("stage");
  m.instance = j.at("instance");
  m.version = static_cast<int>(whole_number(j.at("version")));
  m.parameters = hashed_fields(j.at("parameters"));
  m.inputs = hashed_fields(j.at("inputs"));
  m.outputs = outputs(j.at("outputs"));
  m.issues = issues(j.at("issues"));
  const json& cost = j.at("cost");
  m.cost = {cost.at("wall_seconds"), cost.at("cpu_seconds"), whole_number(cost.at("peak_bytes"))};
  return m;
}
}  // namespace

std::string manifest_text(const Manifest& m) {
  // Names and messages may hold bytes that are not UTF-8; a cache entry replaces them rather than failing.
  const std::string payload = to_json(m).dump(1, ' ', false, json::error_handler_t::replace);
  return header(m.key, payload) + payload;
}

std::optional<Manifest> parse_manifest(std::string_view text, const Digest& key) {
  const auto line_end = text.find('\n');
  if (line_end == std::string_view::npos) return std::nullopt;
  const std::string_view payload = text.substr(line_end + 1);
  if (text.substr(0, line_end + 1) != header(key, payload)) return std::nullopt;
  try {
    return manifest(json::parse(payload), key);
  } catch (const json::exception&) {
    return std::nullopt;
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace skinforge
