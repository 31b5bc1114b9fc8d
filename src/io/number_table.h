#pragma once

#include <Eigen/Core>
#include <string>

#include "io/import.h"

namespace skinforge {

/// A .dmat table: the text form (columns, rows, then the values column after column, any white space) or the
/// binary one (a line "0 0", a line with columns and rows, raw little-endian doubles). #rows x #columns.
/// Throws Error (BadInput) with line or place for text that is no number, numbers that are not finite, and
/// counts that do not fit the file.
Eigen::MatrixXd read_dmat(const InputFile& file);

/// The text form, one value a line, in the shortest digits that read back to the same bits.
std::string write_dmat(const Eigen::MatrixXd& table);

}  // namespace skinforge
