#pragma once

#include <string>
#include <vector>

#include "diff/character_diff.h"

namespace skinforge {

template <class Archive>
void fields(Archive& a, DiffFinding& f) {
  a(f.group, f.name, f.text, f.is_over);
}

/// How the result differs from the golden of the recipe.
struct GoldenComparison {
  bool is_missing = false;  ///< there is no golden yet
  std::vector<DiffFinding> findings;
  std::string text;  ///< for people, as `diff` prints it

  template <class Archive>
  friend void fields(Archive& a, GoldenComparison& c) {
    a(c.is_missing, c.findings, c.text);
  }
};

}  // namespace skinforge
