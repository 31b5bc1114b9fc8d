#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/math.h"

namespace skinforge {

/// Writes JSON text from front to back, without blanks. Numbers are written as the shortest text that gives
/// the same float again, never by locale. Strings: bytes that are not UTF-8 are spelled \xNN.
class JsonText {
 public:
  void begin_object() { begin('{'); }
  void end_object() { end('}'); }
  void begin_array() { begin('['); }
  void end_array() { end(']'); }
  /// Name of the next member.
  void key(std::string_view name);

  void text(std::string_view value);
  void number(double value);  ///< as float
  void count(std::size_t value);
  void flag(bool value);
  /// JSON text put in as it is.
  void raw(std::string_view json);

  void member(std::string_view name, std::string_view value);
  void member(std::string_view name, const char* value) { member(name, std::string_view(value)); }
  void member(std::string_view name, double value);
  void member(std::string_view name, std::size_t value);
  void member(std::string_view name, bool value);
  void member(std::string_view name, std::span<const double> values);
  void member(std::string_view name, std::span<const std::size_t> values);

  std::string take() { return std::move(out_); }

 private:
  void separate();
  void begin(char bracket);
  void end(char bracket);
  void quoted(std::string_view value);

  std::string out_;
  bool needs_comma_ = false;
};

}  // namespace skinforge
