#include "deform/morph_basis.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <Eigen/SVD>
#include <random>

#include "base/parallel.h"

namespace skinforge {
namespace {

double left_by_least_squares(const Eigen::MatrixXd& offsets, const MorphBasis& basis) {
  const Eigen::VectorXd roots = basis.rows.cwiseSqrt();
  const Eigen::MatrixXd weighted = roots.asDiagonal() * basis.targets;
  const Eigen::MatrixXd mix =
      weighted.colPivHouseholderQr().solve(Eigen::MatrixXd(roots.asDiagonal() * offsets));
  const Eigen::MatrixXd residual = offsets - basis.targets * mix;
  double largest = 0;
  for (Eigen::Index f = 0; f < residual.cols(); ++f)
    for (Eigen::Index v = 0; v < residual.rows(); v += 3)
      largest = std::max(largest, residual.col(f).segment<3>(v).norm());
  return largest;
}

Eigen::MatrixXd random_offsets(int vertices, int frames, int rank) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const auto filled = [&](int rows, int columns) {
    return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); }));
  };
  return filled(3 * vertices, rank) * filled(rank, frames);
}

TEST(MorphBasis, AllShapesOfFewAreExact) {
  const Eigen::MatrixXd offsets = random_offsets(50, 20, 3);
  const MorphBasis basis = find_morph_basis(offsets, 8);
  EXPECT_EQ(basis.targets.cols(), 3);
  EXPECT_LT(basis.largest, 1e-9);
}

// What it says is left is left, the shapes are orthogonal by its weights, and plain singular vectors leave
// more.
TEST(MorphBasis, LeavesLessThanSingularVectors) {
  Eigen::MatrixXd offsets = random_offsets(60, 30, 10);
  offsets.col(7) *= 0.1;
  offsets.block(0, 7, 3, 1)
      .setConstant(5);  // one vertex in one frame, which the mean square does not care for
  const MorphBasis basis = find_morph_basis(offsets, 6);
  EXPECT_NEAR(left_by_least_squares(offsets, basis), basis.largest, 1e-9 * basis.largest);
  const Eigen::MatrixXd products = basis.targets.transpose() * basis.rows.asDiagonal() * basis.targets;
  const Eigen::MatrixXd diagonal = products.diagonal().asDiagonal();
  EXPECT_LT((products - diagonal).norm(), 1e-8 * products.norm());
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(offsets, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const MorphBasis plain{svd.matrixU().leftCols(6), Eigen::VectorXd::Ones(offsets.rows()), 0};
  EXPECT_LT(basis.largest, 0.95 * left_by_least_squares(offsets, plain));
}

TEST(MorphBasis, NothingToMove) {
  EXPECT_EQ(find_morph_basis(Eigen::MatrixXd::Zero(9, 4), 2).targets.cols(), 0);
}

TEST(MorphBasis, SameBitsWithAnyNumberOfThreads) {
  const Eigen::MatrixXd offsets = random_offsets(80, 25, 12);
  const MorphBasis many = find_morph_basis(offsets, 5);
  set_thread_limit(1);
  EXPECT_EQ(find_morph_basis(offsets, 5).targets, many.targets);
  set_thread_limit(2);
}

}  // namespace
}  // namespace skinforge
