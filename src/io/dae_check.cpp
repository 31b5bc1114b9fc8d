#include "io/dae_check.h"

#include <fmt/format.h>

#include <charconv>
#include <map>
#include <optional>
#include <string_view>

#include "base/error.h"
#include "io/dae_nodes.h"

namespace skinforge {
namespace {

using Text = std::string_view;

/// What stands between `from` and `to` at or behind `at`, which moves behind it; none when there is no such.
std::optional<Text> between(Text text, Text from, Text to, std::size_t& at) {
  const auto begin = text.find(from, at);
  if (begin == Text::npos) return std::nullopt;
  const auto end = text.find(to, begin + from.size());
  if (end == Text::npos) return std::nullopt;
  at = end + to.size();
  return text.substr(begin + from.size(), end - begin - from.size());
}

std::optional<Text> first_between(Text text, Text from, Text to) {
  std::size_t at = 0;
  return between(text, from, to, at);
}

Text attribute(Text tag, const std::string& name) {
  return first_between(tag, " " + name + "=\"", "\"").value_or(Text());
}

/// Integers up to the first word that is none.
std::vector<std::int64_t> integers(Text text) {
  std::vector<std::int64_t> list;
  for (const char *at = text.data(), *end = at + text.size(); at < end;) {
    std::int64_t value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error == std::errc())
      list.push_back(value);
    else if (!std::isspace(static_cast<unsigned char>(*at)))
      break;
    at = error == std::errc() ? next : at + 1;
  }
  return list;
}

/// Numbers of names by the id of their source; the first source of an id counts.
using NameCounts = std::map<Text, std::int64_t>;

NameCounts count_names(Text document) {
  NameCounts counts;
  std::size_t at = 0;
  while (const auto source = between(document, "<source id=\"", "</source>", at)) {
    const Text id = source->substr(0, source->find('"'));
    for (const char* kind : {"<Name_array", "<IDREF_array"})
      if (const auto tag = first_between(*source, kind, ">"))
        if (const auto count = integers(attribute(*tag, "count")); !count.empty())
          counts.try_emplace(id, count[0]);
  }
  return counts;
}

/// The inputs of a weights element: where joints stand in it, and how many numbers an influence has.
struct Layout {
  std::size_t joint = 0, stride = 0;
  Text joint_source;
};

Layout layout_of(Text weights) {
  Layout layout;
  std::size_t at = 0;
  while (const auto input = between(weights, "<input", ">", at)) {
    const auto offset = integers(attribute(*input, "offset"));
    if (offset.empty() || offset[0] < 0) continue;
    layout.stride = std::max(layout.stride, static_cast<std::size_t>(offset[0]) + 1);
    if (attribute(*input, "semantic") != "JOINT") continue;
    layout.joint = static_cast<std::size_t>(offset[0]);
    layout.joint_source = attribute(*input, "source");
  }
  return layout;
}

void check_weights(const NameCounts& names, Text weights) {
  const Layout layout = layout_of(weights);
  if (!layout.joint_source.starts_with('#')) return;
  const auto joints = names.find(layout.joint_source.substr(1));
  const auto list = first_between(weights, "<v>", "</v>");
  if (joints == names.end() || !list) return;
  const std::vector<std::int64_t> numbers = integers(*list);
  for (std::size_t i = layout.joint; i < numbers.size(); i += layout.stride)
    if (numbers[i] < -1 || numbers[i] >= joints->second)  // -1 is the bind shape
      throw Error(ExitCode::BadInput, fmt::format("COLLADA: vertex_weights name joint {}, the skin has {}",
                                                  numbers[i], joints->second));
}

}  // namespace

void check_dae(const InputFile& file, std::vector<Issue>& issues) {
  const Text document(reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size());
  if (document.find("<!DOCTYPE") != Text::npos)
    issues.push_back({"doctype-ignored", Severity::Warning, "scene",
                      "the file has a document type; entities of it are not expanded"});
  check_dae_nodes(document);
  const NameCounts names = count_names(document);
  std::size_t at = 0;
  while (const auto weights = between(document, "<vertex_weights", "</vertex_weights>", at))
    check_weights(names, *weights);
}

}  // namespace skinforge
