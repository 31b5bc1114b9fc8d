#pragma once

#include <string>
#include <vector>

namespace skinforge {

/// Lines of cells, set in columns as wide as their widest cell, two spaces apart and `indent` from the left.
/// A cell that starts with a digit, a sign followed by one, or a dash alone is set to the right. Trailing
/// spaces are cut.
class TextTable {
 public:
  void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  bool is_empty() const { return rows_.empty(); }
  std::string str(std::size_t indent = 2) const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace skinforge
