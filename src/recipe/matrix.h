#pragma once

#include <string>
#include <vector>

#include "recipe/value_tree.h"

namespace skinforge {

/// One cell of a recipe's matrix.
struct MatrixCell {
  std::string label;                     ///< "body=horse torso=knight"; empty where there is no matrix
  Value values;                          ///< an object: axis -> value
  std::vector<Value::Member> variables;  ///< those of an "include" that name no axis: they stand for "vars"
};

/// The cells of "matrix" (null: one cell without a label): every combination of the axes' values, the last
/// axis fastest, without those that an item of "exclude" fits, then those of "include". `only`: words
/// "axis=value"; of one axis any, of several all must fit. A value that is an object goes by its "name". At
/// most 10000 cells. Throws Error (Usage) for what is no matrix, for axes and values that are not there, and
/// when nothing is left.
std::vector<MatrixCell> matrix_cells(const Value* matrix, const std::vector<std::string>& only);

/// The value itself and all below it.
std::size_t count_values(const Value& value);

/// Of all cells together.
constexpr std::size_t kMaxMatrixValues = 4'000'000;  // ours: 1 GB; refuses what multiplies itself, not work

}  // namespace skinforge
