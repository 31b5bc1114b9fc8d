#include <fmt/core.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "base/text.h"
#include "recipe/value_tree.h"

namespace skinforge {

namespace {
TextPlace place_of(const YAML::Mark& mark) {
  return {mark.line + 1, mark.column + 1};
}

bool is_ambiguous_word(std::string word) {
  static constexpr std::array kWords = {"yes", "no", "on", "off", "y", "n"};
  std::transform(word.begin(), word.end(), word.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

// Builds the tree from the events of one document; refuses what a recipe does not need at the first sight of
// it, before anything could be expanded.
class TreeBuilder final : public YAML::EventHandler {
 public:
  explicit TreeBuilder(const std::string& file) : file_(file) {}

  Value take() { return std::move(root_); }
  bool is_empty() const { return !has_root_; }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    expect_no_anchor(mark, anchor);
    add(leaf(mark));
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    fail(mark, "aliases (*name) are not read");
  }
  void OnAnchor(const YAML::Mark& mark, const std::string&) override {
    fail(mark, "anchors (&name) are not read");
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& text) override {
    expect_no_anchor(mark, anchor);
    const bool is_quoted = tag == "!";
    if (!is_quoted) expect_no_tag(mark, tag);
    add(is_quoted ? string(mark, text) : plain(mark, text));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(mark, tag, anchor, Value::Kind::Array);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(mark, tag, anchor, Value::Kind::Object);
  }
  void OnMapEnd() override { close(); }

 private:
  // A list or object under construction; in an object, keys and values come in turn.
  struct Open {
    Value value;
    bool has_key = false;
  };

  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& message) const {
    throw text_error(file_, place_of(mark), message);
  }
  void expect_no_anchor(const YAML::Mark& mark, YAML::anchor_t anchor) const {
    if (anchor != 0) fail(mark, "anchors (&name) are not read");
  }
  void expect_no_tag(const YAML::Mark& mark, const std::string& tag) const {
    if (tag != "?" && !tag.empty()) fail(mark, "tags (!name) are not read");
  }

  static Value leaf(const YAML::Mark& mark) {
    Value value;
    value.place = place_of(mark);
    return value;
  }
  static Value string(const YAML::Mark& mark, const std::string& text) {
    Value value = leaf(mark);
    value.kind = Value::Kind::String;
    value.text = text;
    return value;
  }
  static Value plain(const YAML::Mark& mark, const std::string& text) {
    Value value = string(mark, text);
    if (text == "null" || text == "~") {
      value.kind = Value::Kind::Null;
    } else if (text == "true" || text == "false") {
      value.kind = Value::Kind::Bool;
      value.boolean = text == "true";
    } else if (parse_json_number(text, value.number)) {
      value.kind = Value::Kind::Number;
    } else {
      value.is_ambiguous = is_ambiguous_word(text);
    }
    return value;
  }

  void open(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, Value::Kind kind) {
    expect_no_anchor(mark, anchor);
    expect_no_tag(mark, tag);
    if (open_.size() >= static_cast<std::size_t>(kMaxRecipeDepth))
      fail(mark, fmt::format("nested deeper than {} levels", kMaxRecipeDepth));
    if (!open_.empty() && expects_key()) fail(mark, "a key must be plain text");
    open_.push_back({leaf(mark), false});
    open_.back().value.kind = kind;
  }
  void close() {
    Value value = std::move(open_.back().value);
    open_.pop_back();
    add(std::move(value));
  }

  bool expects_key() const { return open_.back().value.kind == Value::Kind::Object && !open_.back().has_key; }

  void add(Value value) {
    if (open_.empty()) {
      root_ = std::move(value);
      has_root_ = true;
    } else if (expects_key()) {
      add_key(value);
    } else if (open_.back().value.kind == Value::Kind::Object) {
      open_.back().value.members.back().value = std::move(value);
      open_.back().has_key = false;
    } else {
      open_.back().value.items.push_back(std::move(value));
    }
  }

  void add_key(const Value& key) {
    if (key.text == "<<") throw text_error(file_, key.place, "merge keys (<<) are not read");
    if (key.kind == Value::Kind::Null) throw text_error(file_, key.place, "a key must be plain text");
    auto& members = open_.back().value.members;
    for (const auto& other : members)
      if (other.key == key.text)
        throw text_error(
            file_, key.place,
            fmt::format("duplicate key \"{}\" (first at line {})", printable(key.text), other.place.line));
    members.push_back({key.text, key.place, {}});
    open_.back().has_key = true;
  }

  const std::string& file_;
  std::vector<Open> open_;
  Value root_;
  bool has_root_ = false;
};
}  // namespace

Value parse_yaml_text(std::string_view text, const std::string& file) {
  std::istringstream stream{std::string(text)};
  TreeBuilder first(file), second(file);
  try {
    YAML::Parser parser(stream);
    parser.HandleNextDocument(first);
    if (first.is_empty())
      throw text_error(file, {}, "the file is empty; a recipe is an object with inputs, a base and ops");
    if (parser.HandleNextDocument(second))
      throw text_error(file, {}, "a recipe is one YAML document, not several");
  } catch (const YAML::Exception& error) {
    const TextPlace place = error.mark.is_null() ? TextPlace{} : place_of(error.mark);
    throw text_error(file, place, printable(error.msg));
  }
  return first.take();
}

}  // namespace skinforge
