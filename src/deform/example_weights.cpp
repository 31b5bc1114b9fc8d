#include "deform/example_weights.h"

#include <Eigen/LU>
#include <cmath>

#include "base/expect.h"

namespace skinforge {
namespace {

constexpr double kSamePose = 1e-9;  // ours: of the largest distance between examples
constexpr double kLeastSum =
    0.05;  // ours: Eq. 8 divides by it; at 0.08 weights were still in use, at 0.001 absurd

double largest_distance(std::span<const Eigen::VectorXd> poses) {
  double largest = 0;
  for (const auto& a : poses)
    for (const auto& b : poses) largest = std::max(largest, (a - b).norm());
  return largest;
}

}  // namespace

Eigen::VectorXd pose_point(std::span<const Quat> local, std::span<const std::size_t> joints) {
  Eigen::VectorXd point(static_cast<Eigen::Index>(9 * joints.size()));
  for (std::size_t i = 0; i < joints.size(); ++i)
    point.segment<9>(static_cast<Eigen::Index>(9 * i)) = local[joints[i]].toRotationMatrix().reshaped();
  return point;
}

ExampleWeights::ExampleWeights(std::span<const Eigen::VectorXd> poses, RadialKernel kernel)
    : kernel_(kernel) {
  SF_EXPECT(!poses.empty());
  const double same = kSamePose * largest_distance(poses);
  for (const Eigen::VectorXd& pose : poses) {
    std::size_t at = 0;
    while (at < centers_.size() && (pose - centers_[at]).norm() > same) ++at;
    if (at == centers_.size()) {
      centers_.push_back(pose);
      sharers_.push_back(0);
    }
    place_.push_back(at);
    ++sharers_[at];
  }
  const auto n = static_cast<Eigen::Index>(centers_.size());
  if (kernel_ == RadialKernel::Gaussian && n > 1) {
    double sum = 0;
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < i; ++j)
        sum += (centers_[static_cast<std::size_t>(i)] - centers_[static_cast<std::size_t>(j)]).norm();
    width_ = sum / (static_cast<double>(n * (n - 1)) / 2);
  }
  Eigen::MatrixXd matrix(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      matrix(i, j) =
          phi((centers_[static_cast<std::size_t>(i)] - centers_[static_cast<std::size_t>(j)]).norm());
  coefficients_ = n == 1 ? Eigen::MatrixXd::Identity(1, 1)
                         : Eigen::MatrixXd(matrix.partialPivLu().solve(Eigen::MatrixXd::Identity(n, n)));
}

double ExampleWeights::phi(double distance) const {
  if (kernel_ == RadialKernel::Linear) return distance;
  const double ratio = distance / width_;
  return std::exp(-ratio * ratio);
}

Eigen::VectorXd ExampleWeights::raw(const Eigen::VectorXd& pose) const {
  const auto n = static_cast<Eigen::Index>(centers_.size());
  if (n == 1) return Eigen::VectorXd::Ones(1);
  Eigen::VectorXd values(n);
  for (Eigen::Index t = 0; t < n; ++t) values[t] = phi((pose - centers_[static_cast<std::size_t>(t)]).norm());
  return coefficients_ * values;
}

bool ExampleWeights::is_far(const Eigen::VectorXd& pose) const {
  return std::abs(raw(pose).sum()) < kLeastSum;
}

std::vector<double> ExampleWeights::operator()(const Eigen::VectorXd& pose) const {
  Eigen::VectorXd of_center = raw(pose);
  if (std::abs(of_center.sum()) < kLeastSum)
    for (Eigen::Index t = 0; t < of_center.size(); ++t)
      of_center[t] = 1 / std::max((pose - centers_[static_cast<std::size_t>(t)]).squaredNorm(), 1e-12);
  of_center /= of_center.sum();
  std::vector<double> weights;
  for (const std::size_t center : place_)
    weights.push_back(of_center[static_cast<Eigen::Index>(center)] / sharers_[center]);
  return weights;
}

}  // namespace skinforge
