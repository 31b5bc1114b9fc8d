#pragma once

#include <cstddef>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace skinforge {

/// A value inside a JSON document together with its place ("/accessors/3/count"). Every accessor checks the
/// type and throws Error (BadInput) "PLACE: sentence" when the file holds something else. Refers to its
/// document.
class JsonPlace {
 public:
  JsonPlace(const nlohmann::json& value, std::string place) : value_(&value), place_(std::move(place)) {}

  std::string place() const;
  [[noreturn]] void fail(const std::string& sentence) const;

  bool is_object() const;
  /// Member of an object; `get` needs it to be there.
  bool has(std::string_view key) const;
  JsonPlace get(std::string_view key) const;
  std::optional<JsonPlace> find(std::string_view key) const;
  /// Names of the members, sorted.
  std::vector<std::string> keys() const;

  /// Element count of an array, and one element.
  std::size_t size() const;
  JsonPlace at(std::size_t i) const;
  /// The objects of the array under `key`; none when there is no such member. Anything but objects is an
  /// error.
  std::vector<JsonPlace> objects(std::string_view key) const;
  /// Same, but the array must be there and hold something.
  std::vector<JsonPlace> required_objects(std::string_view key) const;

  /// This value as a number; JSON cannot spell a number that is not finite.
  double number() const;
  /// An integer from 0 to 2^53; integral floats (3.0) count as integers, as in JSON Schema.
  std::size_t count() const;
  /// An index below `limit`; `what` names the table for the message.
  std::size_t index(std::size_t limit, std::string_view what) const;
  std::string text() const;
  bool flag() const;
  /// An array of exactly `n` numbers.
  std::vector<double> numbers(std::size_t n) const;

  double number_or(std::string_view key, double fallback) const;
  std::size_t count_or(std::string_view key, std::size_t fallback) const;
  std::string text_or(std::string_view key, std::string_view fallback) const;
  bool flag_or(std::string_view key, bool fallback) const;

 private:
  const nlohmann::json* value_;
  std::string place_;
};

/// JSON text, read strictly: UTF-8 without byte order mark, at most 64 levels deep, no key twice in one
/// object, nothing behind the last bracket. Throws Error (BadInput) with line and column.
class JsonDocument {
 public:
  explicit JsonDocument(std::span<const std::byte> text);
  ~JsonDocument();
  JsonDocument(JsonDocument&&) noexcept;
  JsonDocument& operator=(JsonDocument&&) noexcept;

  JsonPlace root() const;

 private:
  std::unique_ptr<nlohmann::json> value_;
};

}  // namespace skinforge
