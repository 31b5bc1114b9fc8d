#include "io/gltf_json.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.h"
#include "base/text.h"

namespace skinforge {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxDepth = 64;             // real glTF stays below 12
constexpr double kMaxCount = 9007199254740992.0;  // 2^53: beyond it a double skips integers

/// "line 3, column 7" of a byte offset (1-based, as the parser counts).
std::string line_and_column(std::string_view text, std::size_t position) {
  const std::string_view before = text.substr(0, position > 0 ? position - 1 : 0);
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const auto newline = before.rfind('\n');
  const auto column = newline == std::string_view::npos ? before.size() + 1 : before.size() - newline;
  return fmt::format("line {}, column {}", line, column);
}

/// Builds the tree and stops at the first thing that strict JSON does not have.
class StrictBuilder : public nlohmann::json_sax<json> {
 public:
  StrictBuilder(json& root, std::string_view text) : root_(root), text_(text) {}

  bool null() override { return put(json()); }
  bool boolean(bool value) override { return put(json(value)); }
  bool number_integer(number_integer_t value) override { return put(json(value)); }
  bool number_unsigned(number_unsigned_t value) override { return put(json(value)); }
  bool number_float(number_float_t value, const string_t&) override { return put(json(value)); }
  bool string(string_t& value) override { return put(json(std::move(value))); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(json::object()); }
  bool start_array(std::size_t) override { return open(json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    json& object = *open_.back();
    if (object.contains(name))
      throw Error(ExitCode::BadInput, fmt::format("JSON: key \"{}\" twice in one object", printable(name)));
    slot_ = &object[name];
    return true;
  }

  bool parse_error(std::size_t position, const std::string&, const json::exception& error) override {
    std::string_view why = error.what();
    if (const auto cause = why.find(" - "); cause != std::string_view::npos)
      why.remove_prefix(cause + 3);
    else if (const auto kind = why.find("] "); kind != std::string_view::npos)
      why.remove_prefix(kind + 2);
    throw Error(ExitCode::BadInput, fmt::format("JSON {}: {}", line_and_column(text_, position),
                                                printable(why.substr(0, kQuoted))));
  }

 private:
  static constexpr std::size_t kQuoted = 200;  // a message stays one readable line

  json* place(json&& value) {
    if (open_.empty()) {
      root_ = std::move(value);
      return &root_;
    }
    if (open_.back()->is_array()) {
      open_.back()->push_back(std::move(value));
      return &open_.back()->back();
    }
    *slot_ = std::move(value);
    return slot_;
  }
  bool put(json&& value) {
    place(std::move(value));
    return true;
  }
  bool open(json&& value) {
    if (open_.size() == kMaxDepth)
      throw Error(ExitCode::BadInput, fmt::format("JSON: more than {} levels deep", kMaxDepth));
    open_.push_back(place(std::move(value)));
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  json& root_;
  std::string_view text_;
  std::vector<json*> open_;  ///< stable: a container gets no sibling before it is closed
  json* slot_ = nullptr;
};

json parse(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF"))
    throw Error(ExitCode::BadInput, "JSON line 1, column 1: byte order mark, which glTF does not allow");
  json root;
  StrictBuilder builder(root, text);
  json::sax_parse(text, &builder);
  return root;
}

}  // namespace

std::string JsonPlace::place() const {
  return printable(place_);
}

void JsonPlace::fail(const std::string& sentence) const {
  throw Error(ExitCode::BadInput, fmt::format("{}: {}", place_.empty() ? "/" : place(), sentence));
}

bool JsonPlace::is_object() const {
  return value_->is_object();
}

bool JsonPlace::has(std::string_view key) const {
  if (!value_->is_object()) fail(fmt::format("found {}, wanted an object", value_->type_name()));
  return value_->contains(key);
}

JsonPlace JsonPlace::get(std::string_view key) const {
  auto found = find(key);
  if (!found) fail(fmt::format("the member \"{}\" is missing", printable(key)));
  return std::move(*found);
}

std::optional<JsonPlace> JsonPlace::find(std::string_view key) const {
  if (!value_->is_object()) fail(fmt::format("found {}, wanted an object", value_->type_name()));
  const auto member = value_->find(key);
  if (member == value_->end()) return std::nullopt;
  return JsonPlace(*member, std::string(place_).append("/").append(key));
}

std::vector<std::string> JsonPlace::keys() const {
  if (!value_->is_object()) fail(fmt::format("found {}, wanted an object", value_->type_name()));
  std::vector<std::string> names;
  for (const auto& [name, value] : value_->items()) names.push_back(name);
  return names;
}

std::size_t JsonPlace::size() const {
  if (!value_->is_array()) fail(fmt::format("found {}, wanted an array", value_->type_name()));
  return value_->size();
}

JsonPlace JsonPlace::at(std::size_t i) const {
  if (i >= size()) fail(fmt::format("has {} elements, wanted more than {}", size(), i));
  return {(*value_)[i], std::string(place_).append("/").append(std::to_string(i))};
}

std::vector<JsonPlace> JsonPlace::objects(std::string_view key) const {
  std::vector<JsonPlace> list;
  const auto array = find(key);
  if (!array) return list;
  for (std::size_t i = 0; i < array->size(); ++i) {
    list.push_back(array->at(i));
    const json& value = *list.back().value_;
    if (!value.is_object()) list.back().fail(fmt::format("found {}, wanted an object", value.type_name()));
  }
  return list;
}

std::vector<JsonPlace> JsonPlace::required_objects(std::string_view key) const {
  if (get(key).size() == 0) get(key).fail("is empty");
  return objects(key);
}

double JsonPlace::number() const {
  if (!value_->is_number()) fail(fmt::format("found {}, wanted a number", value_->type_name()));
  return value_->get<double>();
}

std::size_t JsonPlace::count() const {
  const double value = number();
  if (value < 0 || value > kMaxCount || value != std::floor(value))
    fail(fmt::format("found {}, wanted a whole number from 0", value_->dump()));
  return static_cast<std::size_t>(value);
}

std::size_t JsonPlace::index(std::size_t limit, std::string_view what) const {
  const std::size_t value = count();
  if (value >= limit) fail(fmt::format("refers to {} {}, the file has {}", what, value, limit));
  return value;
}

std::string JsonPlace::text() const {
  if (!value_->is_string()) fail(fmt::format("found {}, wanted a string", value_->type_name()));
  return value_->get<std::string>();
}

bool JsonPlace::flag() const {
  if (!value_->is_boolean()) fail(fmt::format("found {}, wanted true or false", value_->type_name()));
  return value_->get<bool>();
}

std::vector<double> JsonPlace::numbers(std::size_t n) const {
  if (size() != n) fail(fmt::format("has {} numbers, wanted {}", size(), n));
  std::vector<double> values;
  for (std::size_t i = 0; i < n; ++i) values.push_back(at(i).number());
  return values;
}

double JsonPlace::number_or(std::string_view key, double fallback) const {
  const auto member = find(key);
  return member ? member->number() : fallback;
}
std::size_t JsonPlace::count_or(std::string_view key, std::size_t fallback) const {
  const auto member = find(key);
  return member ? member->count() : fallback;
}
std::string JsonPlace::text_or(std::string_view key, std::string_view fallback) const {
  const auto member = find(key);
  return member ? member->text() : std::string(fallback);
}
bool JsonPlace::flag_or(std::string_view key, bool fallback) const {
  const auto member = find(key);
  return member ? member->flag() : fallback;
}

JsonDocument::JsonDocument(std::span<const std::byte> text)
    : value_(std::make_unique<json>(parse({reinterpret_cast<const char*>(text.data()), text.size()}))) {}
JsonDocument::~JsonDocument() = default;
JsonDocument::JsonDocument(JsonDocument&&) noexcept = default;
JsonDocument& JsonDocument::operator=(JsonDocument&&) noexcept = default;

JsonPlace JsonDocument::root() const {
  return {*value_, ""};
}

}  // namespace skinforge
