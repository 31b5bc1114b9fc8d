#include "recipe/recipe_values.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/text.h"

namespace skinforge {

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return extension;
}

std::string input_name(const ValueReader& reader, const std::vector<RecipeInput>& inputs) {
  const std::string name = reader.text();
  std::vector<std::string> names;
  for (const RecipeInput& input : inputs) names.push_back(input.name);
  if (std::find(names.begin(), names.end(), name) == names.end())
    reader.fail(fmt::format("no input \"{}\"{}", printable(name), nearest_hint(name, names)));
  return name;
}

std::array<double, 3> vector3(const ValueReader& reader) {
  const auto items = reader.items();
  if (items.size() != 3) reader.fail_expected("a list of three numbers");
  return {items[0].number(-kMaxLength, kMaxLength), items[1].number(-kMaxLength, kMaxLength),
          items[2].number(-kMaxLength, kMaxLength)};
}

RecipePath read_path(const ValueReader& reader) {
  const std::string text = reader.text();
  const auto refuse = [&](const char* why) {
    reader.fail(fmt::format("path \"{}\" {}", printable(text), why));
  };
  if (std::any_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }))
    refuse("has control characters");
  if (text.find('\\') != std::string::npos) refuse("has a backslash; write / between folders");
  if (text.find("://") != std::string::npos) refuse("is an address; inputs are files");
  if (std::filesystem::path(text).is_absolute()) refuse("is absolute; write it relative to the recipe");
  const std::filesystem::path file = reader.value().file ? reader.value().file_name() : reader.file();
  return {text, (file.parent_path() / text).lexically_normal()};
}

std::vector<std::string> read_joints(const ValueReader& reader) {
  if (reader.is_string()) return {reader.text()};
  if (!reader.is_array()) reader.fail_expected("a joint, or a list of joints");
  std::vector<std::string> joints;
  for (const ValueReader& item : reader.items()) {
    const std::string joint = item.text();
    if (std::find(joints.begin(), joints.end(), joint) != joints.end())
      item.fail("joint \"" + printable(joint) + "\" is listed twice; leave one out");
    joints.push_back(joint);
  }
  if (joints.empty()) reader.fail("expected at least one joint, such as \"Neck1\"");
  return joints;
}

// null is as good as nothing.
std::optional<ValueReader> find_set(const ObjectReader& object, std::string_view key) {
  const auto found = object.find(key);
  return found && found->value().kind == Value::Kind::Null ? std::nullopt : found;
}

std::vector<std::string> read_clip_names(const ValueReader& reader) {
  if (!reader.is_array()) reader.fail_expected("a list of clip names");
  std::vector<std::string> names;
  for (const ValueReader& item : reader.items()) {
    const std::string clip = item.text();
    if (std::find(names.begin(), names.end(), clip) != names.end())
      item.fail("clip \"" + printable(clip) + "\" is listed twice; leave one out");
    names.push_back(clip);
  }
  return names;
}

// True for "all"; otherwise fills in the names.
bool read_clips(const ValueReader& reader, std::vector<std::string>& names) {
  if (reader.is_string() && reader.value().text == "all") return true;
  if (!reader.is_array()) reader.fail_expected("\"all\" or a list of clip names");
  names = read_clip_names(reader);
  return false;
}

}  // namespace skinforge
