#pragma once

#include <span>
#include <vector>

#include "base/math.h"

namespace skinforge {

/// A pose as a point: the rotation matrices of some joints, relative to their parents, one after the other
/// (9 numbers each). Matrices and not quaternions: q and -q are one pose, and nothing jumps near half turns.
/// `local`: one rotation a joint; `joints`: which ones, by place in `local`.
Eigen::VectorXd pose_point(std::span<const Quat> local, std::span<const std::size_t> joints);

/// Radial kernel: phi(r) = r, or exp(-(r / s)^2) with s the mean distance of the examples.
enum class RadialKernel : std::uint8_t { Linear, Gaussian };

/// How much each example has to say in a pose (ETH Sec. 8.1.3): radial basis functions with
/// a_j(P_i) = 1 for i = j and 0 else, scaled to sum 1 (Eq. 8).
/// Guards, ours: examples in one pose (closer than 1e-9 of the largest distance) share one weight evenly,
/// since they would make the system singular; one pose alone always has weight 1; where the sum before Eq. 8
/// falls below 0.05, as with the Gaussian far from all examples, weights by inverse squared distance take its
/// place, and `is_far` says so.
class ExampleWeights {
 public:
  ExampleWeights() = default;
  /// `poses`: at least one point, all of one size.
  ExampleWeights(std::span<const Eigen::VectorXd> poses, RadialKernel kernel = RadialKernel::Linear);

  std::size_t size() const { return place_.size(); }
  /// Number of different poses.
  std::size_t distinct() const { return centers_.size(); }
  /// a_j, one an example, sum 1; some may be negative or above 1.
  std::vector<double> operator()(const Eigen::VectorXd& pose) const;
  /// Before Eq. 8, one a distinct pose.
  Eigen::VectorXd raw(const Eigen::VectorXd& pose) const;
  bool is_far(const Eigen::VectorXd& pose) const;

  /// What a run-time driver needs: centres, c_jt (row j, column t), width s of the kernel (1 for Linear).
  const std::vector<Eigen::VectorXd>& centers() const { return centers_; }
  const Eigen::MatrixXd& coefficients() const { return coefficients_; }
  double width() const { return width_; }
  RadialKernel kernel() const { return kernel_; }

 private:
  double phi(double distance) const;

  RadialKernel kernel_ = RadialKernel::Linear;
  double width_ = 1;
  std::vector<Eigen::VectorXd> centers_;  ///< distinct poses
  std::vector<std::size_t> place_;        ///< per example, its centre
  std::vector<double> sharers_;           ///< per centre, how many examples have it
  Eigen::MatrixXd coefficients_;
};

}  // namespace skinforge
