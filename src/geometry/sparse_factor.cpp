#include "geometry/sparse_factor.h"

#include <Eigen/SparseCholesky>

#include "base/error.h"
#include "base/expect.h"

namespace skinforge {
namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, std::int32_t>;

// Columns of a block that are solved together: a row of them fills registers, and more do not help.
constexpr int kWidest = 8;

template <int N>
struct Lower {
  std::span<const std::int32_t> begin, row;
  std::span<const double> value, diagonal;

  void solve(double* x) const {
    using Row = Eigen::Map<Eigen::Array<double, N, 1>>;
    const std::size_t n = diagonal.size();
    for (std::size_t j = 0; j < n; ++j) {
      const Eigen::Array<double, N, 1> xj = Row(x + j * N);
      for (auto p = static_cast<std::size_t>(begin[j]); p < static_cast<std::size_t>(begin[j + 1]); ++p)
        Row(x + static_cast<std::size_t>(row[p]) * N) -= value[p] * xj;
      Row(x + j * N) = xj / diagonal[j];
    }
    for (std::size_t j = n; j-- > 0;) {
      Eigen::Array<double, N, 1> xj = Row(x + j * N);
      for (auto p = static_cast<std::size_t>(begin[j]); p < static_cast<std::size_t>(begin[j + 1]); ++p)
        xj -= value[p] * Row(x + static_cast<std::size_t>(row[p]) * N);
      Row(x + j * N) = xj;
    }
  }
};

}  // namespace

SparseFactor::SparseFactor(const LowerColumns& matrix) {
  const auto n = static_cast<std::int32_t>(matrix.size());
  const Eigen::Map<const Matrix> lower(n, n, static_cast<Eigen::Index>(matrix.row.size()),
                                       matrix.begin.data(), matrix.row.data(), matrix.value.data());
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<std::int32_t>> ldlt;
  ldlt.compute(lower);
  const bool is_definite = ldlt.info() == Eigen::Success && (n == 0 || ldlt.vectorD().minCoeff() > 0);
  if (!is_definite)
    throw Error(ExitCode::StageFailed, "a linear system over the surface has no single solution");
  const Matrix& l = ldlt.matrixL().nestedExpression();
  begin_.assign(l.outerIndexPtr(), l.outerIndexPtr() + n + 1);
  row_.assign(l.innerIndexPtr(), l.innerIndexPtr() + l.nonZeros());
  value_.assign(l.valuePtr(), l.valuePtr() + l.nonZeros());
  const Eigen::VectorXd d = ldlt.vectorD();
  diagonal_.assign(d.data(), d.data() + n);
  place_.assign(ldlt.permutationP().indices().data(), ldlt.permutationP().indices().data() + n);
}

void SparseFactor::solve(std::span<double> block, std::size_t columns) const {
  SF_EXPECT(block.size() == size() * columns);
  const auto run = [&]<int N>(std::size_t first) {
    std::vector<double> x(size() * N);
    for (std::size_t i = 0; i < size(); ++i)
      std::copy_n(block.data() + i * columns + first, N, x.data() + static_cast<std::size_t>(place_[i]) * N);
    Lower<N>{begin_, row_, value_, diagonal_}.solve(x.data());
    for (std::size_t i = 0; i < size(); ++i)
      std::copy_n(x.data() + static_cast<std::size_t>(place_[i]) * N, N, block.data() + i * columns + first);
  };
  for (std::size_t c = 0; c < columns;) {
    const std::size_t left = columns - c;
    if (left >= kWidest) {
      run.operator()<kWidest>(c), c += kWidest;
    } else if (left >= 4) {
      run.operator()<4>(c), c += 4;
    } else if (left == 3) {
      run.operator()<3>(c), c += 3;
    } else if (left == 2) {
      run.operator()<2>(c), c += 2;
    } else {
      run.operator()<1>(c), c += 1;
    }
  }
}

}  // namespace skinforge
