#include "recipe/recipe_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace skinforge {
namespace fs = std::filesystem;

namespace {
std::string extension_of(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return extension;
}

}  // namespace

std::string read_recipe_text(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) throw Error(ExitCode::BadInput, path.string() + ": no such file");
  if (!fs::is_regular_file(path, error))
    throw Error(ExitCode::BadInput, path.string() + ": not a regular file");
  if (const auto size = fs::file_size(path, error); !error && size > kMaxRecipeBytes)
    throw text_error(path.string(), {},
                     fmt::format("a recipe has at most {} bytes, this file has {}", kMaxRecipeBytes, size));
  std::ifstream file(path, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(file), {});
  if (!file) throw Error(ExitCode::BadInput, path.string() + ": cannot be read");
  return text;
}

namespace {
void set_file(Value& value, const std::shared_ptr<const std::string>& file) {
  value.file = file;
  for (Value& item : value.items) set_file(item, file);
  for (Value::Member& member : value.members) set_file(member.value, file);
}
}  // namespace

Value parse_value_text(const std::string& text, const fs::path& path) {
  const std::string extension = extension_of(path);
  const auto file = std::make_shared<const std::string>(path.string());
  expect_recipe_text(text, *file);
  const bool is_yaml = extension == ".yaml" || extension == ".yml";
  if (!is_yaml && extension != ".json" && extension != ".jsonc")
    throw Error(ExitCode::Usage, *file + ": a recipe ends in .json, .jsonc, .yaml or .yml");
  Value value = is_yaml ? parse_yaml_text(text, *file) : parse_json_text(text, *file);
  set_file(value, file);
  return value;
}

Value read_value_file(const fs::path& path) {
  return parse_value_text(read_recipe_text(path), path);
}

}  // namespace skinforge
