#include "base/limits.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <limits>
#include <vector>

#include "base/error.h"
#include "base/text.h"

namespace skinforge {
namespace {

struct Entry {
  const char* name;
  std::uint64_t Limits::*value;
  const char* unit;  // "bytes": K, M and G are powers of 1024
  const char* what;
};

constexpr std::array<Entry, 16> kTable = {{
    {"file", &Limits::file, "bytes", "one input file"},
    {"nodes", &Limits::nodes, "", "nodes of a scene"},
    {"depth", &Limits::depth, "", "levels of the node tree"},
    {"joints", &Limits::joints, "", "joints of a skin"},
    {"vertices", &Limits::vertices, "", "vertices of a file, morph targets counted"},
    {"keys", &Limits::keys, "", "numbers in the keys of a file"},
    {"clip", &Limits::clip, "s", "length of a clip"},
    {"frames", &Limits::frames, "", "frames of all clips of an input, at 30 a second"},
    {"image-side", &Limits::image_side, "", "pixels along an image"},
    {"pixels", &Limits::pixels, "", "pixels of an image"},
    {"inflate", &Limits::inflate, "bytes", "what one packed block unpacks to"},
    {"memory", &Limits::memory, "bytes",
     "one lattice of distances, the frames of an input, one decoded image"},
    {"import-memory", &Limits::import_memory, "bytes", "address space of the import process"},
    {"import-stack", &Limits::import_stack, "bytes", "stack of the import process"},
    {"import-seconds", &Limits::import_seconds, "s", "processor time of the import process"},
    {"import-wait", &Limits::import_wait, "s", "until the import process must be done"},
}};

Limits& current() {
  static Limits limits;
  return limits;
}

const Entry& entry(std::string_view name) {
  for (const Entry& e : kTable)
    if (name == e.name) return e;
  std::vector<std::string> names;
  for (const Entry& e : kTable) names.emplace_back(e.name);
  throw Error(ExitCode::Usage, fmt::format("--limit: no limit is called \"{}\"{}", printable(name),
                                           nearest_hint(name, names)));
}

std::uint64_t factor(std::string_view suffix, const Entry& e) {
  const std::uint64_t step = std::string_view(e.unit) == "bytes" ? 1024 : 1000;
  if (suffix.empty()) return 1;
  if (suffix == "K") return step;
  if (suffix == "M") return step * step;
  return suffix == "G" ? step * step * step : 0;
}

}  // namespace

const Limits& limits() {
  return current();
}

void set_limits(const Limits& limits) {
  current() = limits;
}

void set_limit(Limits& limits, const std::string& text) {
  const auto equals = std::min(text.find('='), text.size());
  const Entry& e = entry(std::string_view(text).substr(0, equals));
  const char *begin = text.data() + std::min(equals + 1, text.size()), *end = text.data() + text.size();
  std::uint64_t number = 0;
  const auto [rest, error] = std::from_chars(begin, end, number);
  const std::uint64_t times = factor(std::string_view(rest, static_cast<std::size_t>(end - rest)), e);
  if (error != std::errc() || times == 0 || number == 0 ||
      number > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()) / times)
    throw Error(
        ExitCode::Usage,
        fmt::format("--limit {}: expected a whole number from 1, with or without K, M or G, as in {}=20M",
                    printable(text), e.name));
  limits.*e.value = number * times;
}

std::string limit_hint(std::string_view name) {
  return fmt::format("the limit is {}; --limit {}=N raises it", limits().*entry(name).value, name);
}

std::string limit_table() {
  std::string text;
  const Limits defaults;
  for (const Entry& e : kTable)
    text += fmt::format("  {:<16}{:>12} {:<6} {}\n", e.name, defaults.*e.value, e.unit, e.what);
  return text;
}

}  // namespace skinforge
