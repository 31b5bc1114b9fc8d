#include "base/safe_name.h"

#include <algorithm>
#include <array>

namespace skinforge {

namespace {
constexpr std::size_t kMaxLength = 120;  // ours: leaves room for suffixes below the 255 bytes of file systems

bool is_safe_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view("._-+ ").find(c) != std::string_view::npos;
}

bool is_device_name(std::string_view name) {
  std::string stem(name.substr(0, name.find('.')));
  std::transform(stem.begin(), stem.end(), stem.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  static constexpr std::array kDevices = {"con", "prn", "aux", "nul"};
  if (std::find(kDevices.begin(), kDevices.end(), stem) != kDevices.end()) return true;
  return stem.size() == 4 && (stem.starts_with("com") || stem.starts_with("lpt")) && stem[3] >= '0' &&
         stem[3] <= '9';
}
}  // namespace

bool is_safe_file_name(std::string_view name) {
  if (name.empty() || name.size() > kMaxLength) return false;
  if (!std::all_of(name.begin(), name.end(), is_safe_character)) return false;
  if (std::string_view(".- ").find(name.front()) != std::string_view::npos) return false;
  if (name.back() == '.' || name.back() == ' ') return false;
  return !is_device_name(name);
}

bool is_safe_relative_path(std::string_view path) {
  while (true) {
    const auto slash = path.find('/');
    if (!is_safe_file_name(path.substr(0, slash))) return false;
    if (slash == std::string_view::npos) return true;
    path.remove_prefix(slash + 1);
  }
}

std::string safe_file_name(std::string_view text) {
  std::string name(text.substr(0, kMaxLength));
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !is_safe_character(c); }, '_');
  if (name.empty()) return "_";
  if (name.back() == '.' || name.back() == ' ') name.back() = '_';
  if (is_safe_file_name(name)) return name;
  name.insert(name.begin(), '_');  // a leading dot, dash or space, or a device name
  if (name.size() > kMaxLength) name.pop_back();
  return is_safe_file_name(name) ? name : safe_file_name(name);
}

}  // namespace skinforge
