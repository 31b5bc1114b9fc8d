#include "recipe/resolve.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/text.h"
#include "recipe/compose.h"
#include "recipe/matrix.h"
#include "recipe/recipe_file.h"
#include "recipe/variables.h"

namespace skinforge {
namespace fs = std::filesystem;

namespace {
[[noreturn]] void fail(const Value& at, const std::string& message) {
  throw text_error(at.file_name(), at.place, message);
}

void remove(Value& object, std::string_view key) {
  std::erase_if(object.members, [&](const Value::Member& member) { return member.key == key; });
}

// Lays "/output/influences=8" over the tree; objects on the way are made.
void set_property(Value& root, const std::string& word) {
  const std::size_t equals = word.find('=');
  if (equals == std::string::npos)
    throw Error(ExitCode::Usage, fmt::format("--set {}: expected NAME=VALUE", printable(word)));
  const std::string pointer = word.substr(0, equals);
  Value* at = &root;
  for (std::size_t begin = 1; begin <= pointer.size();) {
    const std::size_t end = std::min(pointer.find('/', begin), pointer.size());
    const std::string key = pointer.substr(begin, end - begin);
    begin = end + 1;
    if (at->kind == Value::Kind::Array) {
      const Value* item = find_value(*at, "/" + key);
      if (!item)
        throw Error(ExitCode::Usage,
                    fmt::format("--set {}: no item {} there", printable(word), printable(key)));
      at = const_cast<Value*>(item);  // of `root`, which is ours
      continue;
    }
    if (at->kind != Value::Kind::Object) {
      at->kind = Value::Kind::Object;
      at->text.clear();
    }
    if (!at->find(key)) {
      at->members.push_back({key, at->place, Value()});
      at->members.back().value.file = root.file;
      at->members.back().value.kind = Value::Kind::Object;
    }
    at = at->find(key);
  }
  *at = value_of_word(word, root.file);
}

std::string name_of(const Value& root) {
  const Value* name = root.find("name");
  return name && name->kind == Value::Kind::String ? name->text : std::string();
}

// Cells write to folders of their names.
void expect_different_names(const std::vector<ResolvedRecipe>& recipes) {
  std::map<std::string, const ResolvedRecipe*> by_name;
  for (const ResolvedRecipe& recipe : recipes) {
    const std::string name = name_of(recipe.root);
    const auto [first, is_new] = by_name.emplace(name, &recipe);
    if (is_new || name.empty()) continue;
    fail(*recipe.root.find("name"),
         fmt::format("/name: \"{}\" is the name of two cells of the matrix ({} and {}); put an axis into it, "
                     "such as ${{matrix.{}}}",
                     printable(name), first->second->variant, recipe.variant,
                     recipe.variant.substr(0, recipe.variant.find('='))));
  }
}

std::vector<ResolvedRecipe> resolved(Value root, const fs::path& path, const RecipeChoice& choice) {
  if (root.kind != Value::Kind::Object) return {{path, {}, std::move(root)}};  // the reader says it better
  for (const std::string& word : choice.set)
    if (word.find('=') == std::string::npos)
      throw Error(ExitCode::Usage, fmt::format("--set {}: expected NAME=VALUE", printable(word)));
  const Variables variables = read_variables(root.find("vars"), choice.set);
  const std::vector<MatrixCell> cells = matrix_cells(root.find("matrix"), choice.only);
  remove(root, "vars");
  remove(root, "matrix");
  std::vector<ResolvedRecipe> recipes;
  std::size_t value_count = 0;
  for (const MatrixCell& cell : cells) {
    Variables of_cell = variables;
    if (!cell.label.empty()) of_cell["matrix"] = cell.values;
    for (const Value::Member& extra : cell.variables) of_cell[extra.key] = extra.value;
    ResolvedRecipe recipe{path, cell.label, substituted(root, of_cell), choice.inputs_under};
    for (const std::string& word : choice.set)
      if (word.starts_with('/')) set_property(recipe.root, word);
    value_count += count_values(recipe.root);
    if (value_count > kMaxMatrixValues)
      fail(root,
           fmt::format("/matrix: its {} cells make more than {} values", cells.size(), kMaxMatrixValues));
    recipes.push_back(std::move(recipe));
  }
  expect_different_names(recipes);
  return recipes;
}

bool is_nested(const Value& value) {
  const bool has_nested_items = std::any_of(value.items.begin(), value.items.end(), [](const Value& item) {
    return item.kind == Value::Kind::Array || item.kind == Value::Kind::Object;
  });
  return !value.members.empty() || has_nested_items;
}

std::string json_text(const std::string& text) {
  Value value;
  value.kind = Value::Kind::String;
  value.text = text;
  return value_text(value);
}

// One line a value; `comma`: what follows it.
void print(const Value& value, const std::string& head, std::size_t indent, const char* comma,
           std::string& out) {
  const std::string margin(2 * indent, ' ');
  if (!is_nested(value)) {
    const std::string line = margin + head + value_text(value) + comma;
    out += fmt::format("{:<60}  // {}\n", line, value.where());
    return;
  }
  const bool is_object = value.kind == Value::Kind::Object;
  out += margin + head + (is_object ? "{\n" : "[\n");
  for (std::size_t i = 0; i < value.members.size(); ++i)
    print(value.members[i].value, json_text(value.members[i].key) + ": ", indent + 1,
          i + 1 < value.members.size() ? "," : "", out);
  for (std::size_t i = 0; i < value.items.size(); ++i)
    print(value.items[i], "", indent + 1, i + 1 < value.items.size() ? "," : "", out);
  out += margin + (is_object ? "}" : "]") + comma + "\n";
}
}  // namespace

std::vector<ResolvedRecipe> resolve_recipes(const fs::path& path, const RecipeChoice& choice) {
  return resolved(compose_file(path, choice.inputs_under), path, choice);
}

std::vector<ResolvedRecipe> resolve_text(const std::string& text, const fs::path& path,
                                         const RecipeChoice& choice) {
  return resolved(compose(parse_value_text(text, path), path, choice.inputs_under), path, choice);
}

std::string expanded_text(const Value& root) {
  std::string text;
  print(root, "", 0, "", text);
  return text;
}

std::string plain_json(const Value& root) {
  return value_text(root);
}

}  // namespace skinforge
