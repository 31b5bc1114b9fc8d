#include "deform/morph_basis.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace skinforge {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kRounds = 12;  // ours: the human of the course gains nothing after ten
constexpr double kNoise =
    1e-7;                      // ours: a shape that moves nothing by more than this share of the largest one
constexpr double kCalm = 0.5;  // ours: what has no error keeps a third of its weight, what has most keeps all

/// Distances that are left, the largest of each vertex and of each frame.
struct Left {
  VectorXd vertex, frame;
  double largest = 0;
};

// Columns are independent: parallel, the same bits for any number of threads.
MatrixXd gram(const MatrixXd& columns, const VectorXd& rows) {
  MatrixXd result(columns.cols(), columns.cols());
  parallel_for(static_cast<std::size_t>(columns.cols()), [&](std::size_t j) {
    const VectorXd weighted = rows.cwiseProduct(columns.col(static_cast<Index>(j)));
    result.col(static_cast<Index>(j)) = columns.transpose() * weighted;
  });
  return result;
}

Left what_is_left(const MatrixXd& offsets, const MatrixXd& targets, const MatrixXd& mix) {
  Left left{VectorXd::Zero(offsets.rows() / 3), VectorXd::Zero(offsets.cols()), 0};
  MatrixXd distance(offsets.rows() / 3, offsets.cols());
  parallel_for(static_cast<std::size_t>(offsets.cols()), [&](std::size_t f) {
    const auto frame = static_cast<Index>(f);
    const VectorXd residual = offsets.col(frame) - targets * mix.col(frame);
    for (Index v = 0; v < distance.rows(); ++v) distance(v, frame) = residual.segment<3>(3 * v).norm();
    left.frame[frame] = distance.col(frame).maxCoeff();
  });
  left.vertex = distance.rowwise().maxCoeff();
  left.largest = left.frame.maxCoeff();
  return left;
}

VectorXd more_weight(const VectorXd& weight, const VectorXd& left, double largest) {
  const VectorXd raised = weight.array() * (kCalm + left.array() / largest);
  return raised / raised.maxCoeff();
}

class BasisSearch {
 public:
  BasisSearch(const MatrixXd& offsets, std::size_t count)
      : offsets_(offsets),
        count_(static_cast<Index>(count)),
        vertices_(VectorXd::Ones(offsets.rows() / 3)),
        frames_(VectorXd::Ones(offsets.cols())) {}

  MorphBasis search() {
    MorphBasis best;
    for (int round = 0; round < kRounds; ++round) {
      MorphBasis basis = decompose();
      if (basis.targets.cols() == 0) return basis;
      if (round == 0 || basis.largest < best.largest) best = std::move(basis);
      if (left_.largest <= kNoise * offsets_.cwiseAbs().maxCoeff()) break;
      vertices_ = more_weight(vertices_, left_.vertex, left_.largest);
      frames_ = more_weight(frames_, left_.frame, left_.largest);
    }
    return best;
  }

 private:
  // Left singular vectors of the weighted offsets, by the small Gram matrix of frames.
  MorphBasis decompose() {
    MorphBasis basis;
    basis.rows = vertices_.replicate(1, 3).transpose().reshaped();
    const VectorXd roots = frames_.cwiseSqrt();
    const MatrixXd weighted = offsets_ * roots.asDiagonal();
    const MatrixXd products = gram(weighted, basis.rows);
    const Eigen::SelfAdjointEigenSolver<MatrixXd> modes(products);
    const Index last = products.cols() - 1;
    const double strongest = std::sqrt(std::max(modes.eigenvalues()[last], 0.0));
    Index count = 0;
    while (count < std::min(count_, last + 1) &&
           std::sqrt(std::max(modes.eigenvalues()[last - count], 0.0)) > kNoise * strongest)
      ++count;
    const MatrixXd chosen = modes.eigenvectors().rightCols(count).rowwise().reverse();
    const VectorXd strengths = modes.eigenvalues().tail(count).reverse();
    basis.targets = weighted * chosen;
    const MatrixXd mix = strengths.cwiseInverse().asDiagonal() * (chosen.transpose() * products) *
                         roots.cwiseInverse().asDiagonal();
    left_ = what_is_left(offsets_, basis.targets, mix);
    basis.largest = left_.largest;
    return basis;
  }

  const MatrixXd& offsets_;
  Index count_;
  VectorXd vertices_, frames_;
  Left left_;
};

}  // namespace

MorphBasis find_morph_basis(const MatrixXd& offsets, std::size_t count) {
  return BasisSearch(offsets, count).search();
}

}  // namespace skinforge
