#include "recipe/recipe_places.h"

#include <algorithm>

#include "recipe/value_reader.h"

namespace skinforge {

namespace {
void collect_places(const Value& value, const std::string& pointer,
                    std::map<std::string, std::string>& places) {
  places[pointer] = value.where();
  for (const Value::Member& member : value.members)
    collect_places(member.value, pointer_to(pointer, member.key), places);
  for (std::size_t i = 0; i < value.items.size(); ++i)
    collect_places(value.items[i], pointer_to(pointer, std::to_string(i)), places);
}

bool is_list_of_values(const Value& value) {
  return value.kind == Value::Kind::Array &&
         std::none_of(value.items.begin(), value.items.end(), [](const Value& item) {
           return item.kind == Value::Kind::Array || item.kind == Value::Kind::Object;
         });
}

void collect_values(const Value& value, const std::string& pointer,
                    std::map<std::string, std::string>& values) {
  const bool is_nested = value.kind == Value::Kind::Object || value.kind == Value::Kind::Array;
  const bool is_empty = value.members.empty() && value.items.empty();
  if (!is_nested || is_empty || is_list_of_values(value)) values[pointer] = value_text(value);
  for (const Value::Member& member : value.members)
    collect_values(member.value, pointer_to(pointer, member.key), values);
  if (is_list_of_values(value)) return;
  for (std::size_t i = 0; i < value.items.size(); ++i)
    collect_values(value.items[i], pointer_to(pointer, std::to_string(i)), values);
}

// The recipe inside this one that the pointer leads into, and the pointer there.
std::pair<const Recipe*, std::string> inner_recipe(const Recipe& recipe, const std::string& pointer) {
  for (const RecipeInput& input : recipe.inputs) {
    const std::string prefix = pointer_to("/inputs", input.name) + "/recipe/";
    if (input.recipe && pointer.starts_with(prefix))
      return {input.recipe.get(), pointer.substr(prefix.size() - 1)};
  }
  return {nullptr, {}};
}
}  // namespace

void add_places_and_values(const Value& root, Recipe& recipe) {
  collect_places(root, "", recipe.places);
  collect_values(root, "", recipe.values);
}

std::size_t Recipe::input_index(const std::string& input) const {
  const auto found =
      std::find_if(inputs.begin(), inputs.end(), [&](const RecipeInput& i) { return i.name == input; });
  if (found == inputs.end()) throw Error(ExitCode::Internal, "no input \"" + input + "\"");
  return static_cast<std::size_t>(found - inputs.begin());
}

std::string Recipe::where(const std::string& pointer) const {
  if (const auto [inner, rest] = inner_recipe(*this, pointer); inner) return inner->where(rest);
  std::string enclosing = pointer;
  auto found = places.find(enclosing);
  while (found == places.end() && !enclosing.empty()) {
    enclosing.erase(enclosing.rfind('/'));
    found = places.find(enclosing);
  }
  return found == places.end() ? path.string() : found->second;
}

std::string Recipe::place(const std::string& pointer) const {
  return where(pointer) + ": " + pointer;
}

std::map<std::string, std::string> recipe_settings(const Recipe& recipe) {
  std::map<std::string, std::string> settings = recipe.values;
  for (const char* key : {"/$schema", "/recipe_version"}) settings.erase(key);
  for (const RecipeInput& input : recipe.inputs) {
    if (!input.recipe) continue;
    for (auto& [pointer, text] : recipe_settings(*input.recipe))
      settings[pointer_to("/inputs", input.name) + "/recipe" + pointer] = text;
  }
  return settings;
}

}  // namespace skinforge
