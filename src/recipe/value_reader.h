#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "recipe/value_tree.h"

namespace skinforge {

class ObjectReader;

/// A value with its JSON pointer, read as a type. Every mismatch throws Error (Usage)
/// `FILE:LINE:COLUMN: /pointer: expected a number, found the string "x"`.
class ValueReader {
 public:
  /// `file` and `value` must outlive the reader.
  ValueReader(const Value& value, const std::string& file, std::string pointer)
      : value_(&value), file_(&file), pointer_(std::move(pointer)) {}

  const Value& value() const { return *value_; }
  /// The file that messages name.
  const std::string& file() const { return *file_; }
  /// JSON pointer of the value.
  const std::string& pointer() const { return pointer_; }
  bool is_string() const { return value_->kind == Value::Kind::String; }
  bool is_object() const { return value_->kind == Value::Kind::Object; }
  bool is_array() const { return value_->kind == Value::Kind::Array; }

  bool boolean() const;
  /// A string that is not empty.
  std::string text() const;
  double number() const;
  /// In [least, most].
  double number(double least, double most) const;
  int integer(int least, int most) const;
  /// The object's members; a key that is not in `known` is an error with the nearest known one.
  ObjectReader object(std::initializer_list<std::string_view> known) const;
  /// The object's members whatever they are called, in file order.
  std::vector<std::pair<std::string, ValueReader>> members() const;
  std::vector<ValueReader> items() const;
  /// One of the words, with its meaning.
  template <class T>
  T choice(std::initializer_list<std::pair<const char*, T>> words) const {
    std::vector<std::string> names;
    for (const auto& [name, meaning] : words) names.emplace_back(name);
    const std::size_t which = index_of_word(names);
    return (words.begin() + which)->second;
  }

  [[noreturn]] void fail(const std::string& message) const;
  [[noreturn]] void fail_expected(const std::string& wanted) const;

 private:
  std::size_t index_of_word(const std::vector<std::string>& names) const;

  const Value* value_;
  const std::string* file_;
  std::string pointer_;
};

/// An object whose keys are known to be right.
class ObjectReader {
 public:
  explicit ObjectReader(ValueReader reader) : reader_(std::move(reader)) {}

  std::optional<ValueReader> find(std::string_view key) const;
  /// Like `find`; a missing key is an error, which gives the schema's example of it.
  ValueReader at(std::string_view key) const;
  const ValueReader& reader() const { return reader_; }

 private:
  ValueReader reader_;
};

/// `pointer` with one more step, escaped as RFC 6901 says.
std::string pointer_to(const std::string& pointer, std::string_view key);

}  // namespace skinforge
