#include "recipe/variables.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "recipe/compose.h"
#include "recipe/value_reader.h"

namespace skinforge {

namespace {
constexpr int kMaxDepth = 16;              // ours: variables in variables
constexpr std::size_t kMaxWork = 1 << 22;  // ours: characters and values; refuses what multiplies itself

[[noreturn]] void fail(const Value& at, const std::string& message) {
  throw text_error(at.file_name(), at.place, message);
}

// One variable as "vars" declares it.
struct Declaration {
  Value preset;
  std::string type;
  std::vector<Value> choices;
  std::optional<double> least, most;
};

std::string type_of(const Value& value) {
  switch (value.kind) {
    case Value::Kind::Bool:
      return "boolean";
    case Value::Kind::Number:
      return "number";
    case Value::Kind::String:
      return "string";
    case Value::Kind::Array:
      return "list";
    case Value::Kind::Object:
      return "object";
    case Value::Kind::Null:
      break;
  }
  return "null";
}

bool is_of_type(const Value& value, const std::string& type) {
  if (type == "integer") return value.kind == Value::Kind::Number && value.number == std::floor(value.number);
  return type_of(value) == type;
}

Declaration declaration(const Value& value, const std::string& pointer) {
  Declaration d{value, type_of(value), {}, {}, {}};
  if (value.kind == Value::Kind::Null) fail(value, pointer + ": a variable needs a value");
  if (value.kind != Value::Kind::Object) return d;
  const std::string file = value.file_name();
  const ObjectReader object =
      ValueReader(value, file, pointer).object({"type", "default", "choices", "min", "max", "description"});
  d.preset = object.at("default").value();
  d.type = type_of(d.preset);
  if (const auto type = object.find("type"))
    d.type = type->choice<const char*>({{"string", "string"},
                                        {"number", "number"},
                                        {"integer", "integer"},
                                        {"boolean", "boolean"},
                                        {"list", "list"}});
  if (const auto choices = object.find("choices"))
    for (const ValueReader& choice : choices->items()) d.choices.push_back(choice.value());
  if (const auto least = object.find("min")) d.least = least->number();
  if (const auto most = object.find("max")) d.most = most->number();
  return d;
}

// `place`: what the message points at.
void expect_allowed(const Declaration& d, const Value& value, const std::string& name) {
  const auto refuse = [&](const std::string& wanted) {
    fail(value,
         fmt::format("variable \"{}\": expected {}, found {}", printable(name), wanted, value.describe()));
  };
  if (!is_of_type(value, d.type)) refuse(d.type == "integer" ? "an integer" : "a " + d.type);
  if (d.least && value.number < *d.least) refuse(fmt::format("a number from {}", *d.least));
  if (d.most && value.number > *d.most) refuse(fmt::format("a number up to {}", *d.most));
  if (d.choices.empty()) return;
  std::string all;
  for (const Value& choice : d.choices) {
    if (value_text(choice) == value_text(value)) return;
    all += (all.empty() ? "" : ", ") + value_text(choice);
  }
  refuse("one of " + all);
}

// The word of --set for a variable of that type: a string stays one, even where it looks like a number.
Value typed(const std::string& word, const Declaration& d, const std::shared_ptr<const std::string>& file) {
  Value value = value_of_word(word, file);
  if (d.type != "string" || value.kind == Value::Kind::String) return value;
  value.kind = Value::Kind::String;
  value.text = word.substr(word.find('=') + 1);
  return value;
}

// Replaces references in one tree.
class Substitution {
 public:
  explicit Substitution(const Variables& variables) : variables_(variables) {}

  Value in(const Value& value) {
    expect_bounded(value, 1);
    Value result = value;
    if (value.kind == Value::Kind::String) return text(value);
    for (Value& item : result.items) item = in(item);
    for (Value::Member& member : result.members) member.value = in(member.value);
    return result;
  }

 private:
  Value text(const Value& value) {
    const std::string& from = value.text;
    Value result = value;
    result.text.clear();
    for (std::size_t i = 0; i < from.size();) {
      if (from.compare(i, 3, "$${") == 0) {
        result.text += "${";
        i += 3;
      } else if (from.compare(i, 2, "${") == 0) {
        const std::size_t end = from.find('}', i);
        if (end == std::string::npos) fail(value, "\"${\" without \"}\"; write $${ for the text itself");
        Value found = resolved(from.substr(i + 2, end - i - 2), value);
        if (i == 0 && end + 1 == from.size()) return found;  // its own kind and origin
        const std::string text = plain(found, value);
        expect_bounded(value, text.size());
        result.text += text;
        i = end + 1;
      } else {
        result.text += from[i++];
      }
    }
    return result;
  }

  void expect_bounded(const Value& at, std::size_t more) {
    work_ += more;
    if (work_ > kMaxWork) fail(at, "variables that make more than a recipe can be");
  }

  static std::string plain(const Value& found, const Value& used_by) {
    if (found.kind == Value::Kind::Array || found.kind == Value::Kind::Object)
      fail(used_by, found.describe() + " cannot stand inside a text");
    return found.kind == Value::Kind::String ? found.text : value_text(found);
  }

  Value resolved(const std::string& name, const Value& used_by) {
    if (++depth_ > kMaxDepth) fail(used_by, fmt::format("\"${{{}}}\" leads back to itself", printable(name)));
    const std::size_t dot = name.find('.');
    const auto found = variables_.find(name.substr(0, dot));
    const Value* value = found == variables_.end() ? nullptr : &found->second;
    if (value && dot != std::string::npos) {
      std::string pointer = name.substr(dot);
      std::replace(pointer.begin(), pointer.end(), '.', '/');
      value = find_value(*value, pointer);
    }
    if (!value)
      fail(used_by, fmt::format("no variable \"{}\"{}", printable(name), nearest_hint(name, names())));
    Value result = in(*value);
    --depth_;
    return result;
  }

  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& [name, value] : variables_) {
      all.push_back(name);
      for (const Value::Member& member : value.members) all.push_back(name + "." + member.key);
    }
    return all;
  }

  const Variables& variables_;
  int depth_ = 0;
  std::size_t work_ = 0;
};
}  // namespace

Value value_of_word(const std::string& word, const std::shared_ptr<const std::string>& file) {
  const std::string text = word.substr(word.find('=') + 1);
  Value value;
  value.kind = Value::Kind::String;
  value.text = text;
  try {
    value = parse_json_text(text, "--set");
  } catch (const Error&) {
  }
  const auto set_origin = [&](const auto& self, Value& v) -> void {
    v.file = file;
    v.origin = "--set " + word;
    for (Value& item : v.items) self(self, item);
    for (Value::Member& member : v.members) self(self, member.value);
  };
  set_origin(set_origin, value);
  return value;
}

Variables read_variables(const Value* vars, const std::vector<std::string>& set) {
  Variables variables;
  std::map<std::string, Declaration> declared;
  std::vector<std::string> names;
  if (vars && vars->kind != Value::Kind::Object)
    fail(*vars, "/vars: expected an object, found " + vars->describe());
  if (vars)
    for (const Value::Member& member : vars->members) {
      const Declaration d = declaration(member.value, pointer_to("/vars", member.key));
      const bool has_reference =
          d.preset.kind == Value::Kind::String && d.preset.text.find("${") != std::string::npos;
      if (!has_reference) expect_allowed(d, d.preset, member.key);
      variables[member.key] = d.preset;
      declared.emplace(member.key, d);
      names.push_back(member.key);
    }
  for (const std::string& word : set) {
    if (word.starts_with('/')) continue;
    const std::string name = word.substr(0, word.find('='));
    const auto found = declared.find(name);
    if (found == declared.end())
      throw Error(ExitCode::Usage, fmt::format("--set {}: the recipe has no variable \"{}\"{}",
                                               printable(word), printable(name), nearest_hint(name, names)));
    const Value value = typed(word, found->second, vars->file);
    expect_allowed(found->second, value, name);
    variables[name] = value;
  }
  return variables;
}

Value substituted(const Value& value, const Variables& variables) {
  return Substitution(variables).in(value);
}

}  // namespace skinforge
