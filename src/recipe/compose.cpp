#include "recipe/compose.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/text.h"
#include "recipe/recipe_file.h"
#include "recipe/recipe_files.h"

namespace skinforge {
namespace fs = std::filesystem;

namespace {
constexpr std::size_t kMaxDepth = 16;    // ours: files on files on files
constexpr std::size_t kMaxFiles = 1000;  // ours: refuses what multiplies itself, not work

[[noreturn]] void fail(const Value& at, const std::string& message) {
  throw text_error(at.file_name(), at.place, message);
}

std::string unescaped(std::string_view step) {
  std::string key;
  for (std::size_t i = 0; i < step.size(); ++i) {
    const bool is_escape =
        step[i] == '~' && i + 1 < step.size() && (step[i + 1] == '0' || step[i + 1] == '1');
    key += is_escape ? (step[++i] == '0' ? '~' : '/') : step[i];
  }
  return key;
}

// Reads files and what they name; `chain` are the files that led here.
class Composer {
 public:
  explicit Composer(const std::vector<std::string>& inputs_under) : inputs_under_(inputs_under) {}

  Value file(const fs::path& path, const Value* named_by) {
    enter(path, named_by);
    Value root = with_context_of(named_by, [&] { return read_value_file(path); });
    root = document(std::move(root));
    chain_.pop_back();
    return root;
  }

  Value text(Value root, const fs::path& path) {
    enter(path, nullptr);
    return document(std::move(root));
  }

 private:
  // A file that cannot be read is told with the place that names it.
  template <class Body>
  static Value with_context_of(const Value* named_by, const Body& body) {
    if (!named_by) return body();
    try {
      return body();
    } catch (const Error& error) {
      if (error.code() != ExitCode::BadInput) throw;
      throw text_error(named_by->file_name(), named_by->place, error.what());
    }
  }

  void enter(const fs::path& path, const Value* named_by) {
    std::error_code error;
    for (const fs::path& before : chain_)
      if (named_by && fs::equivalent(before, path, error))
        fail(*named_by, fmt::format("\"{}\" leads back to itself", printable(path.string())));
    if (named_by && !inputs_under_.empty() && !lies_under(path, inputs_under_))
      fail(*named_by, fmt::format("{} is not below a folder of --inputs-under", printable(path.string())));
    if (named_by && chain_.size() >= kMaxDepth)
      fail(*named_by, fmt::format("files on files deeper than {}", kMaxDepth));
    if (named_by && ++files_ > kMaxFiles) fail(*named_by, fmt::format("more than {} files", kMaxFiles));
    chain_.push_back(path);
  }

  Value document(Value root) {
    Value expanded = including(std::move(root), true);
    Value* extends = expanded.find("extends");
    if (!extends) return expanded;
    const Value wanted = *extends;
    std::erase_if(expanded.members, [](const Value::Member& m) { return m.key == "extends"; });
    if (wanted.kind != Value::Kind::Array) return merged(base(wanted), expanded);
    if (wanted.items.empty()) fail(wanted, "/extends: expected at least one file");
    Value all = base(wanted.items.front());
    for (std::size_t i = 1; i < wanted.items.size(); ++i) all = merged(std::move(all), base(wanted.items[i]));
    return merged(std::move(all), expanded);
  }

  Value base(const Value& name) { return file(resolved(name, name.text), &name); }

  static fs::path resolved(const Value& name, const std::string& text) {
    if (name.kind != Value::Kind::String || text.empty())
      fail(name, "expected a path, found " + name.describe());
    if (fs::path(text).is_absolute()) fail(name, "the path is absolute; write it relative to this file");
    return (fs::path(name.file_name()).parent_path() / text).lexically_normal();
  }

  // `is_root`: whose "matrix" has an "include" of its own.
  Value including(Value value, bool is_root) {
    for (Value::Member& member : value.members)
      if (!(is_root && member.key == "matrix")) member.value = including(std::move(member.value), false);
    std::vector<Value> items;
    for (Value& item : value.items) {
      const bool was_include = item.find("include") != nullptr;
      Value taken = including(std::move(item), false);
      if (was_include && taken.kind == Value::Kind::Array)
        std::move(taken.items.begin(), taken.items.end(), std::back_inserter(items));
      else
        items.push_back(std::move(taken));
    }
    value.items = std::move(items);
    return is_root || !value.find("include") ? value : included(std::move(value));
  }

  Value included(Value value) {
    const Value name = *value.find("include");
    const auto hash = name.text.find('#');
    Value taken = file(resolved(name, name.text.substr(0, hash)), &name);
    const std::string pointer = hash == std::string::npos ? "" : name.text.substr(hash + 1);
    const Value* found = find_value(taken, pointer);
    if (!found) fail(name, fmt::format("\"{}\" has nothing at {}", printable(name.text), printable(pointer)));
    std::erase_if(value.members, [](const Value::Member& m) { return m.key == "include"; });
    if (value.members.empty()) return *found;
    if (found->kind != Value::Kind::Object)
      fail(name, "only an object can have further members laid over it, found " + found->describe());
    return merged(*found, value);
  }

  const std::vector<std::string>& inputs_under_;
  std::vector<fs::path> chain_;
  std::size_t files_ = 0;
};
}  // namespace

Value merged(Value base, const Value& patch) {
  if (patch.kind != Value::Kind::Object) return patch;
  if (base.kind != Value::Kind::Object) {
    base = patch;
    base.members.clear();
  }
  for (const Value::Member& member : patch.members) {
    const auto same = std::find_if(base.members.begin(), base.members.end(),
                                   [&](const Value::Member& m) { return m.key == member.key; });
    if (member.value.kind == Value::Kind::Null) {
      if (same != base.members.end()) base.members.erase(same);
    } else if (same == base.members.end()) {
      base.members.push_back({member.key, member.place, merged(Value(), member.value)});
    } else {
      same->value = merged(std::move(same->value), member.value);
    }
  }
  return base;
}

const Value* find_value(const Value& root, std::string_view pointer) {
  const Value* at = &root;
  while (at && !pointer.empty()) {
    if (pointer.front() != '/') return nullptr;
    const std::size_t end = std::min(pointer.find('/', 1), pointer.size());
    const std::string key = unescaped(pointer.substr(1, end - 1));
    pointer.remove_prefix(end);
    if (at->kind == Value::Kind::Array) {
      double index = -1;
      const bool is_index = parse_json_number(key, index) && index >= 0 && index < double(at->items.size());
      at = is_index ? &at->items[static_cast<std::size_t>(index)] : nullptr;
    } else {
      at = at->find(key);
    }
  }
  return at;
}

Value compose_file(const fs::path& path, const std::vector<std::string>& inputs_under) {
  return Composer(inputs_under).file(path, nullptr);
}

Value compose(Value root, const fs::path& path, const std::vector<std::string>& inputs_under) {
  return Composer(inputs_under).text(std::move(root), path);
}

}  // namespace skinforge
