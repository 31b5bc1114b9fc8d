#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "recipe/value_tree.h"

namespace skinforge {

/// Changes to the text of a recipe, JSON or YAML, at the places of its values; all else stays as it is
/// written. Who makes them reads the result again: a layout that is not foreseen gives text that is wrong,
/// not an error.
class TextEdits {
 public:
  /// `root`: the text as a tree.
  TextEdits(std::string text, const Value& root);

  /// Takes out the member, whose value is a plain one, whose key stands there; with its line, if it has one
  /// of its own.
  void remove_member(const TextPlace& key);
  /// The value there, in quotes or not, is `before` and becomes `after`.
  void replace_word(const TextPlace& value, std::string_view before, std::string_view after);
  /// Writes `key: value` before the member whose key stands there, as that one stands in the text.
  void insert_member(const TextPlace& before, const std::string& key, const std::string& value);

  /// The text with all changes.
  std::string text() const;

 private:
  struct Edit {
    std::size_t begin = 0, end = 0;
    std::string text;
  };
  std::size_t offset_of(const TextPlace& place) const;
  std::size_t end_of_member(std::size_t key) const;

  std::string text_;
  bool is_flow_ = false;  // members stand between braces, with commas
  std::vector<Edit> edits_;
};

}  // namespace skinforge
