#include "io/gltf_uri.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <optional>

#include "base/error.h"
#include "base/text.h"

namespace skinforge {
namespace {

constexpr std::size_t kQuoted = 80;  // a message stays one readable line

[[noreturn]] void bad(std::string_view uri, const char* why) {
  throw Error(ExitCode::BadInput, fmt::format("\"{}\" {}", printable(uri.substr(0, kQuoted)), why));
}

std::optional<unsigned> hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return std::nullopt;
}

std::string percent_decoded(std::string_view uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      text += uri[i];
      continue;
    }
    const auto high = i + 2 < uri.size() ? hex_digit(uri[i + 1]) : std::nullopt;
    const auto low = i + 2 < uri.size() ? hex_digit(uri[i + 2]) : std::nullopt;
    if (!high || !low) bad(uri, "has a broken percent escape");
    text += static_cast<char>(*high * 16 + *low);
    i += 2;
  }
  return text;
}

/// RFC 3986: a scheme is a letter and then letters, digits, "+", "-", "." up to a colon.
bool has_scheme(std::string_view name) {
  const auto colon = name.find(':');
  if (colon == std::string_view::npos || colon == 0) return false;
  for (const char c : name.substr(0, colon))
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '+' && c != '-' && c != '.') return false;
  return std::isalpha(static_cast<unsigned char>(name[0])) != 0;
}

bool climbs(const std::filesystem::path& path) {
  for (const auto& step : path)
    if (step == "..") return true;
  return false;
}

void check_name(std::string_view name) {
  if (name.empty()) bad(name, "names no file");
  for (const char c : name)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) bad(name, "holds a control character");
  if (name.find('\\') != std::string_view::npos) bad(name, "holds a backslash");
  if (has_scheme(name)) bad(name, "is not a file in the folder of the asset");
  if (name.front() == '/') bad(name, "is an absolute path; only files in the folder of the asset are read");
  if (climbs(std::filesystem::path(name))) bad(name, "leaves the folder of the asset");
}

constexpr std::array<std::int8_t, 256> base64_table() {
  std::array<std::int8_t, 256> table{};
  table.fill(-1);
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < kDigits.size(); ++i)
    table[static_cast<unsigned char>(kDigits[i])] = static_cast<std::int8_t>(i);
  return table;
}

Bytes decode_base64(std::string_view text) {
  static constexpr auto kTable = base64_table();
  std::size_t padding = 0;
  while (padding < 2 && text.ends_with('=')) {
    text.remove_suffix(1);
    ++padding;
  }
  if ((text.size() + padding) % 4 != 0) bad(text, "is not base64: its length is not a multiple of 4");
  Bytes bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : text) {
    const int digit = kTable[static_cast<unsigned char>(c)];
    if (digit < 0) bad(text, "is not base64");
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes.push_back(static_cast<std::byte>(bits >> held & 0xFFu));
  }
  return bytes;
}

/// "type/subtype;name=value;base64": each parameter but the last has a "=".
void check_media_type(std::string_view uri, std::string_view media) {
  constexpr std::string_view kBase64 = ";base64";
  if (!media.ends_with(kBase64)) bad(uri, "is a data URI without base64");
  media.remove_suffix(kBase64.size());
  for (auto semicolon = media.find(';'); semicolon != std::string_view::npos; semicolon = media.find(';')) {
    media.remove_prefix(semicolon + 1);
    const std::string_view parameter = media.substr(0, media.find(';'));
    if (parameter.find('=') == std::string_view::npos) bad(uri, "is a data URI with a broken media type");
  }
}

}  // namespace

bool is_data_uri(std::string_view uri) {
  return uri.starts_with("data:");
}

Bytes decode_data_uri(std::string_view uri) {
  const auto comma = uri.find(',');
  if (comma == std::string_view::npos) bad(uri, "is a data URI without data");
  check_media_type(uri, uri.substr(5, comma - 5));
  return decode_base64(uri.substr(comma + 1));
}

std::string resolve_uri(std::string_view asset_path, std::string_view uri) {
  if (has_scheme(uri)) bad(uri, "is not a file in the folder of the asset");
  return resolve_name(asset_path, percent_decoded(uri));
}

std::string resolve_name(std::string_view asset_path, std::string_view name) {
  check_name(name);
  return (std::filesystem::path(asset_path).parent_path() / std::filesystem::path(name)).string();
}

}  // namespace skinforge
