#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/math.h"

namespace skinforge {

/// Lower triangle of a symmetric matrix by columns: the diagonal first, then rising rows.
struct LowerColumns {
  std::vector<std::int32_t> begin = {0};  ///< #columns + 1
  std::vector<std::int32_t> row;
  std::vector<double> value;

  std::size_t size() const { return begin.size() - 1; }
};

/// L D L^T of a sparse positive definite matrix under a fill-reducing permutation (approximate minimum
/// degree), for many right-hand sides: all columns of a block are solved in one walk over L, which is what
/// the time goes into. Equal inputs give equal bits.
class SparseFactor {
 public:
  /// Throws Error (StageFailed) where the matrix is not positive definite.
  explicit SparseFactor(const LowerColumns& matrix);

  std::size_t size() const { return diagonal_.size(); }
  std::size_t nonzeros() const { return row_.size(); }

  /// Overwrites `block` by the solution: `columns` numbers a row, row after row. Linear in nonzeros and
  /// columns.
  void solve(std::span<double> block, std::size_t columns) const;

 private:
  std::vector<std::int32_t> begin_, row_;  ///< L by columns, without its unit diagonal
  std::vector<double> value_, diagonal_;
  std::vector<std::int32_t> place_;  ///< row of the factor of each row of the matrix
};

}  // namespace skinforge
