#include "recipe/migrate.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "recipe/recipe.h"
#include "recipe/recipe_file.h"
#include "recipe/text_edits.h"
#include "recipe/value_reader.h"

namespace skinforge {
namespace fs = std::filesystem;

namespace {
// The tree and the text of one recipe, changed alike.
class Migrator {
 public:
  Migrator(const std::string& text, const fs::path& path)
      : path_(path), root_(parse_value_text(text, path)), edits_(text, root_) {}

  Migration run() {
    if (root_.kind != Value::Kind::Object) return finish();
    expect_known_version();
    drop_roots();
    settle_blends();
    write_version();
    return finish();
  }

 private:
  void expect_known_version() const {
    const Value* version = root_.find("recipe_version");
    if (!version) return;
    const bool is_whole = version->kind == Value::Kind::Number && version->number >= 0 &&
                          version->number == std::floor(version->number);
    if (!is_whole)
      throw text_error(path_.string(), version->place,
                       "/recipe_version: expected a whole number, found " + version->describe());
    if (version->number > kRecipeVersion)
      throw text_error(path_.string(), version->place,
                       fmt::format("/recipe_version: {} is newer than {}, which this tool reads; nothing is "
                                   "changed (a newer skinforge reads it)",
                                   version->text, kRecipeVersion));
  }

  void note(const TextPlace& place, const std::string& what) {
    changes_.push_back({place, text_error(path_.string(), place, what).what()});
  }

  void drop_roots() {
    Value* inputs = root_.find("inputs");
    if (!inputs) return;
    for (Value::Member& input : inputs->members) {
      auto& members = input.value.members;
      const auto root = std::find_if(members.begin(), members.end(), [](const Value::Member& m) {
        return m.key == "root" && m.value.kind == Value::Kind::String;
      });
      if (root == members.end()) continue;
      note(root->place, pointer_to("/inputs", input.key) + "/root is gone; nothing ever read it");
      edits_.remove_member(root->place);
      members.erase(root);
    }
  }

  void settle_blends() {
    Value* operations = root_.find("ops");
    if (!operations) return;
    for (std::size_t i = 0; i < operations->items.size(); ++i) {
      Value& operation = operations->items[i];
      const Value* kind = operation.find("op");
      Value* blend = operation.find("blend");
      if (!kind || !blend || blend->kind != Value::Kind::String) continue;
      const bool says_nothing = (kind->text == "replace" && blend->text == "union") ||
                                (kind->text == "attach" && blend->text == "blend");
      if (!says_nothing) continue;
      note(blend->place, fmt::format("/ops/{}/blend: \"{}\" is \"auto\" now; a {} never did that", i,
                                     blend->text, kind->text == "replace" ? "replacement" : "part attached"));
      edits_.replace_word(blend->place, blend->text, "auto");
      blend->text = "auto";
    }
  }

  // Only of whole recipes: what is laid over others or taken into them has the version of those.
  void write_version() {
    const std::string present = std::to_string(kRecipeVersion);
    if (Value* version = root_.find("recipe_version")) {
      if (version->number == kRecipeVersion) return;
      note(version->place, fmt::format("/recipe_version: {} -> {}", version->text, present));
      edits_.replace_word(version->place, version->text, present);
      version->number = kRecipeVersion;
      version->text = present;
      return;
    }
    const bool is_whole = root_.find("inputs") && root_.find("base") && !root_.find("extends");
    if (!is_whole) return;
    const auto first = std::find_if(root_.members.begin(), root_.members.end(),
                                    [](const Value::Member& m) { return m.key != "$schema"; });
    note(first->place, "/recipe_version: " + present + " is written");
    edits_.insert_member(first->place, "recipe_version", present);
    Value version;
    version.kind = Value::Kind::Number;
    version.number = kRecipeVersion;
    version.text = present;
    root_.members.insert(first, {"recipe_version", first->place, version});
  }

  Migration finish() {
    Migration result{edits_.text()};
    std::stable_sort(changes_.begin(), changes_.end(), [](const Change& a, const Change& b) {
      return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
    });
    for (Change& change : changes_) result.changes.push_back(std::move(change.text));
    if (!result.changes.empty() && !is_as_meant(result.text))
      throw Error(ExitCode::Usage, fmt::format("{}: cannot be changed in place; by hand: {}", path_.string(),
                                               result.changes.front()));
    return result;
  }

  bool is_as_meant(const std::string& text) const {
    try {
      return value_text(parse_value_text(text, path_)) == value_text(root_);
    } catch (const Error&) {
      return false;
    }
  }

  struct Change {
    TextPlace place;
    std::string text;
  };
  fs::path path_;
  Value root_;
  TextEdits edits_;
  std::vector<Change> changes_;
};
}  // namespace

Migration migrate_recipe(const std::string& text, const fs::path& path) {
  return Migrator(text, path).run();
}

}  // namespace skinforge
