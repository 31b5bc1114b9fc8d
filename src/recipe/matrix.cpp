#include "recipe/matrix.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/text.h"

namespace skinforge {

namespace {
constexpr std::size_t kMaxCells = 10000;  // ours: refuses nonsense, not work

[[noreturn]] void fail(const Value& at, const std::string& message) {
  throw text_error(at.file_name(), at.place, message);
}

// What a value of an axis is called.
std::string name_of(const Value& value) {
  const Value* name = value.find("name");
  const Value& shown = name ? *name : value;
  return shown.kind == Value::Kind::String ? shown.text : value_text(shown);
}

const Value& expect_kind(const Value& value, Value::Kind kind, const std::string& what) {
  if (value.kind != kind) fail(value, fmt::format("/matrix: expected {}, found {}", what, value.describe()));
  return value;
}

class Matrix {
 public:
  explicit Matrix(const Value& value) : value_(expect_kind(value, Value::Kind::Object, "an object of axes")) {
    for (const Value::Member& member : value.members) {
      if (member.key == "include" || member.key == "exclude") continue;
      expect_kind(member.value, Value::Kind::Array,
                  "a list of values for axis \"" + printable(member.key) + "\"");
      if (member.value.items.empty())
        fail(member.value, "/matrix: axis \"" + printable(member.key) + "\" is empty");
      axes_.push_back(&member);
    }
    if (axes_.empty() && !value.find("include")) fail(value, "/matrix: expected at least one axis");
  }

  std::vector<MatrixCell> cells() {
    std::vector<MatrixCell> cells;
    if (!axes_.empty()) combine(0, Value(), cells);
    if (const Value* exclude = value_.find("exclude"))
      for (const Value& item : expect_kind(*exclude, Value::Kind::Array, "a list in \"exclude\"").items)
        leave_out(item, cells);
    if (const Value* include = value_.find("include"))
      for (const Value& item : expect_kind(*include, Value::Kind::Array, "a list in \"include\"").items)
        cells.push_back(added(item));
    for (MatrixCell& cell : cells) cell.label = label(cell);
    return cells;
  }

  std::vector<std::string> axis_names() const {
    std::vector<std::string> names;
    for (const Value::Member* axis : axes_) names.push_back(axis->key);
    return names;
  }

 private:
  void combine(std::size_t axis, Value so_far, std::vector<MatrixCell>& cells) {
    if (axis == axes_.size()) {
      if (cells.size() == kMaxCells) fail(value_, fmt::format("/matrix: more than {} cells", kMaxCells));
      value_count_ += count_values(so_far);
      if (value_count_ > kMaxMatrixValues)
        fail(value_, fmt::format("/matrix: its cells make more than {} values", kMaxMatrixValues));
      cells.push_back({{}, std::move(so_far), {}});
      return;
    }
    so_far.kind = Value::Kind::Object;
    so_far.file = value_.file;
    so_far.members.push_back({axes_[axis]->key, axes_[axis]->place, {}});
    for (const Value& value : axes_[axis]->value.items) {
      so_far.members.back().value = value;
      combine(axis + 1, so_far, cells);
    }
  }

  void expect_axis(const Value& at, const std::string& name) const {
    const auto names = axis_names();
    if (std::find(names.begin(), names.end(), name) == names.end())
      fail(at, fmt::format("/matrix: no axis \"{}\"{}", printable(name), nearest_hint(name, names)));
  }

  void leave_out(const Value& item, std::vector<MatrixCell>& cells) const {
    expect_kind(item, Value::Kind::Object, "an object in \"exclude\"");
    for (const Value::Member& member : item.members) expect_axis(member.value, member.key);
    const auto fits = [&](const MatrixCell& cell) {
      return std::all_of(item.members.begin(), item.members.end(), [&](const Value::Member& member) {
        return name_of(*cell.values.find(member.key)) == name_of(member.value);
      });
    };
    if (std::erase_if(cells, fits) == 0) fail(item, "/matrix/exclude: this fits no cell");
  }

  MatrixCell added(const Value& item) const {
    MatrixCell cell;
    cell.values = expect_kind(item, Value::Kind::Object, "an object in \"include\"");
    cell.values.members.clear();
    const auto names = axis_names();
    for (const Value::Member& member : item.members)
      (std::find(names.begin(), names.end(), member.key) != names.end() || axes_.empty() ? cell.values.members
                                                                                         : cell.variables)
          .push_back(member);
    for (const std::string& name : names)
      if (!cell.values.find(name))
        fail(item, fmt::format("/matrix/include: a cell needs a value for axis \"{}\"", printable(name)));
    return cell;
  }

  static std::string label(const MatrixCell& cell) {
    std::string text;
    for (const Value::Member& member : cell.values.members)
      text += fmt::format("{}{}={}", text.empty() ? "" : " ", printable(member.key),
                          printable(name_of(member.value)));
    return text;
  }

  const Value& value_;
  std::vector<const Value::Member*> axes_;
  std::size_t value_count_ = 0;  ///< of all cells
};

// "torso=knight" words, by axis.
std::map<std::string, std::set<std::string>> wanted_values(const std::vector<std::string>& only,
                                                           const std::vector<MatrixCell>& cells) {
  std::map<std::string, std::set<std::string>> wanted;
  for (const std::string& word : only) {
    const std::size_t equals = word.find('=');
    const std::string axis = word.substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : word.substr(equals + 1);
    std::set<std::string> axes, values;
    for (const MatrixCell& cell : cells)
      for (const Value::Member& member : cell.values.members) {
        axes.insert(member.key);
        if (member.key == axis) values.insert(name_of(member.value));
      }
    const auto hint = [](const std::string& name, const std::set<std::string>& names) {
      return nearest_hint(name, std::vector<std::string>(names.begin(), names.end()));
    };
    if (!axes.contains(axis))
      throw Error(ExitCode::Usage, fmt::format("--only {}: the matrix has no axis \"{}\"{}", printable(word),
                                               printable(axis), hint(axis, axes)));
    if (!values.contains(value))
      throw Error(ExitCode::Usage,
                  fmt::format("--only {}: axis \"{}\" has no value \"{}\"{}", printable(word),
                              printable(axis), printable(value), hint(value, values)));
    wanted[axis].insert(value);
  }
  return wanted;
}
}  // namespace

std::vector<MatrixCell> matrix_cells(const Value* matrix, const std::vector<std::string>& only) {
  if (!matrix && !only.empty()) throw Error(ExitCode::Usage, "--only: the recipe has no matrix");
  if (!matrix) return {MatrixCell()};
  std::vector<MatrixCell> cells = Matrix(*matrix).cells();
  const auto wanted = wanted_values(only, cells);
  std::erase_if(cells, [&](const MatrixCell& cell) {
    return std::any_of(wanted.begin(), wanted.end(), [&](const auto& axis) {
      const Value* value = cell.values.find(axis.first);
      return !value || !axis.second.contains(name_of(*value));
    });
  });
  if (cells.empty()) fail(*matrix, "/matrix: no cell is left");
  return cells;
}

std::size_t count_values(const Value& value) {
  std::size_t count = 1;
  for (const Value& item : value.items) count += count_values(item);
  for (const Value::Member& member : value.members) count += count_values(member.value);
  return count;
}

}  // namespace skinforge
