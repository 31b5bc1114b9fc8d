#pragma once

#include <algorithm>
#include <string_view>

#include "base/archive.h"

namespace skinforge {

/// One line of an OBJ or MTL file: "f 1 2 3".
struct ObjStatement {
  std::string_view keyword;  ///< "f"
  std::string_view rest;     ///< "1 2 3", without blanks around it
  std::size_t line = 0;      ///< counted from 1
  std::size_t length = 0;    ///< bytes of the whole line
};

/// Calls `body(statement)` for each line that holds something, comments too.
template <class Body>
void for_each_statement(const Bytes& bytes, Body&& body) {
  constexpr std::string_view kBlank = " \t\r";
  const auto trimmed = [&](std::string_view text) {
    const auto first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos) return std::string_view();
    return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
  };
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (std::size_t line = 1; !text.empty(); ++line) {
    const auto end = std::min(text.find('\n'), text.size());
    const std::string_view content = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (content.empty()) continue;
    const auto space = std::min(content.find_first_of(kBlank), content.size());
    body(ObjStatement{content.substr(0, space), trimmed(content.substr(space)), line, end});
  }
}

}  // namespace skinforge
