#include "io/glb_json.h"

#include <fmt/format.h>

#include <iterator>

#include "base/text.h"

namespace skinforge {

void JsonText::separate() {
  if (needs_comma_) out_ += ',';
  needs_comma_ = true;
}

void JsonText::begin(char bracket) {
  separate();
  out_ += bracket;
  needs_comma_ = false;
}

void JsonText::end(char bracket) {
  out_ += bracket;
  needs_comma_ = true;
}

void JsonText::quoted(std::string_view value) {
  out_ += '"';
  std::size_t clean = 0;  // start of the bytes not written yet
  for (std::size_t i = 0; i <= value.size(); ++i) {
    const bool at_end = i == value.size();
    const auto byte = at_end ? 0u : static_cast<unsigned char>(value[i]);
    const bool is_control = byte < 0x20 || byte == 0x7F;
    if (!at_end && !is_control && byte != '"' && byte != '\\') continue;
    out_ += printable(value.substr(clean, i - clean));
    clean = i + 1;
    if (at_end) break;
    if (is_control)
      fmt::format_to(std::back_inserter(out_), "\\u{:04x}", byte);
    else
      out_.append({'\\', static_cast<char>(byte)});
  }
  out_ += '"';
}

void JsonText::key(std::string_view name) {
  separate();
  quoted(name);
  out_ += ':';
  needs_comma_ = false;
}

void JsonText::text(std::string_view value) {
  separate();
  quoted(value);
}

void JsonText::number(double value) {
  separate();
  fmt::format_to(std::back_inserter(out_), "{}", static_cast<float>(value));
}

void JsonText::count(std::size_t value) {
  separate();
  fmt::format_to(std::back_inserter(out_), "{}", value);
}

void JsonText::flag(bool value) {
  separate();
  out_ += value ? "true" : "false";
}

void JsonText::raw(std::string_view json) {
  separate();
  out_ += json;
}

void JsonText::member(std::string_view name, std::string_view value) {
  key(name);
  text(value);
}
void JsonText::member(std::string_view name, double value) {
  key(name);
  number(value);
}
void JsonText::member(std::string_view name, std::size_t value) {
  key(name);
  count(value);
}
void JsonText::member(std::string_view name, bool value) {
  key(name);
  flag(value);
}
void JsonText::member(std::string_view name, std::span<const double> values) {
  key(name);
  begin_array();
  for (const double value : values) number(value);
  end_array();
}
void JsonText::member(std::string_view name, std::span<const std::size_t> values) {
  key(name);
  begin_array();
  for (const std::size_t value : values) count(value);
  end_array();
}

}  // namespace skinforge
