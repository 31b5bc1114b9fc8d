#include "deform/correctives.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "deform/morph_basis.h"
#include "deform/unposing.h"
#include "skinning/linear_blend.h"

namespace skinforge {
namespace {

constexpr std::size_t kMostNumbers = std::size_t{1} << 26;  // ours: 512 MB of offsets at once

double as_float(double x) {
  return static_cast<double>(static_cast<float>(x));
}

Vec3 as_float(const Vec3& v) {
  return v.cast<float>().cast<double>();
}

Eigen::Map<const Eigen::VectorXd> as_column(const std::vector<Vec3>& list) {
  return {list.front().data(), static_cast<Eigen::Index>(3 * list.size())};
}

void add(std::vector<Vec3>& shape, double weight, const std::vector<Vec3>& target) {
  if (weight == 0) return;
  for (std::size_t v = 0; v < shape.size(); ++v) shape[v] += weight * target[v];
}

struct Distance {
  double largest = 0, squares = 0;
};
Distance distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  Distance d;
  for (std::size_t v = 0; v < a.size(); ++v) {
    const double squared = (a[v] - b[v]).squaredNorm();
    d.largest = std::max(d.largest, squared);
    d.squares += squared;
  }
  d.largest = std::sqrt(d.largest);
  return d;
}

/// Makes targets from unposed frames and measures them.
class Baker {
 public:
  Baker(std::span<const Vec3> rest, const SkinWeights& weights, std::size_t count,
        const std::function<CorrectiveFrame(std::size_t)>& frame, const CorrectiveOptions& options)
      : rest_(rest), weights_(weights), count_(count), frame_(frame), options_(options) {}

  Correctives bake() {
    if (count_ == 0 || rest_.empty()) return {};
    find_targets();
    find_weights();
    measure();
    cut_to_enough();
    return std::move(result_);
  }

 private:
  Unposed unposed(std::size_t i) const {
    const CorrectiveFrame frame = frame_(i);
    return unpose(rest_, frame.goal, weights_, frame.palette);
  }

  void find_targets() {
    const std::size_t room = std::max(kMostNumbers / (3 * rest_.size()), 2 * options_.targets);
    const std::size_t basis = std::min({count_, options_.basis, room});
    Eigen::MatrixXd offset(static_cast<Eigen::Index>(3 * rest_.size()), static_cast<Eigen::Index>(basis));
    parallel_for(basis, [&](std::size_t b) {
      offset.col(static_cast<Eigen::Index>(b)) = as_column(unposed(b * count_ / basis).offsets);
    });
    const MorphBasis found = find_morph_basis(offset, options_.targets);
    rows_ = found.rows;
    for (Eigen::Index t = 0; t < found.targets.cols(); ++t) add_target(found.targets.col(t));
  }

  // Rounded, so that weights are fitted to what files hold.
  void add_target(const Eigen::VectorXd& mode) {
    std::vector<Vec3>& target = result_.targets.emplace_back(rest_.size());
    for (std::size_t v = 0; v < target.size(); ++v) target[v] = as_float(Vec3(mode.segment<3>(3 * v)));
  }

  void find_weights() {
    const auto n = static_cast<Eigen::Index>(result_.targets.size());
    Eigen::MatrixXd gram(n, n);
    for (Eigen::Index a = 0; a < n; ++a)
      for (Eigen::Index b = 0; b < n; ++b) gram(a, b) = column(a).dot(rows_.cwiseProduct(column(b)));
    const Eigen::LDLT<Eigen::MatrixXd> factor(gram);
    result_.weights.resize(count_);
    std::vector<std::size_t> damped(count_, 0);
    parallel_for(count_, [&](std::size_t i) {
      const Unposed frame = unposed(i);
      damped[i] = frame.damped.size();
      Eigen::VectorXd right(n);
      const Eigen::VectorXd weighted = rows_.cwiseProduct(as_column(frame.offsets));
      for (Eigen::Index t = 0; t < n; ++t) right[t] = column(t).dot(weighted);
      const Eigen::VectorXd weights = n == 0 ? right : Eigen::VectorXd(factor.solve(right));
      result_.weights[i].assign(weights.data(), weights.data() + n);
    });
    result_.damped = std::accumulate(damped.begin(), damped.end(), std::size_t{0});
    scale_to_one();
  }
  Eigen::Map<const Eigen::VectorXd> column(Eigen::Index target) const {
    return as_column(result_.targets[static_cast<std::size_t>(target)]);
  }

  // The weight largest in size becomes 1: engines that show or clamp weights expect such numbers.
  void scale_to_one() {
    for (std::size_t t = 0; t < result_.targets.size(); ++t) {
      double peak = 0;
      for (const auto& weights : result_.weights)
        if (std::abs(weights[t]) > std::abs(peak)) peak = weights[t];
      if (peak == 0) peak = 1;
      for (Vec3& offset : result_.targets[t]) offset = as_float(Vec3(peak * offset));
      for (auto& weights : result_.weights) weights[t] = as_float(weights[t] / peak);
    }
  }

  void measure() {
    const std::size_t n = result_.targets.size();
    std::vector<std::vector<Distance>> errors(count_);  // [frame][number of targets]
    parallel_for(count_, [&](std::size_t i) {
      const CorrectiveFrame frame = frame_(i);
      std::vector<Vec3> shape(rest_.begin(), rest_.end());
      for (std::size_t t = 0; t <= n; ++t) {
        if (t > 0) add(shape, result_.weights[i][t - 1], result_.targets[t - 1]);
        errors[i].push_back(distance(linear_blend(shape, weights_, frame.palette), frame.goal));
      }
    });
    result_.by_count.assign(n + 1, 0.0);
    double squares = 0;
    for (const auto& of_frame : errors) {
      for (std::size_t t = 0; t <= n; ++t)
        result_.by_count[t] = std::max(result_.by_count[t], of_frame[t].largest);
      squares += of_frame[n].squares;
    }
    result_.before = result_.by_count.front();
    result_.largest = result_.by_count.back();
    result_.rms = std::sqrt(squares / static_cast<double>(count_ * rest_.size()));
  }

  void cut_to_enough() {
    if (options_.enough <= 0) return;
    const auto& errors = result_.by_count;
    const auto first =
        std::find_if(errors.begin(), errors.end(), [&](double error) { return error <= options_.enough; });
    if (first == errors.end() || first + 1 == errors.end()) return;
    result_.targets.resize(static_cast<std::size_t>(first - errors.begin()));
    for (auto& weights : result_.weights) weights.resize(result_.targets.size());
    measure();
  }

  std::span<const Vec3> rest_;
  const SkinWeights& weights_;
  std::size_t count_;
  const std::function<CorrectiveFrame(std::size_t)>& frame_;
  CorrectiveOptions options_;
  Eigen::VectorXd rows_;  ///< weights of coordinates in least squares
  Correctives result_;
};

}  // namespace

double replay_error(std::span<const Vec3> rest, const SkinWeights& weights,
                    std::span<const std::vector<Vec3>> targets, std::size_t count,
                    const std::function<CorrectiveFrame(std::size_t)>& frame,
                    const std::function<std::vector<double>(std::size_t)>& blend) {
  std::vector<double> errors(count, 0.0);
  parallel_for(count, [&](std::size_t i) {
    const CorrectiveFrame wanted = frame(i);
    const std::vector<double> row = blend(i);
    std::vector<Vec3> shape(rest.begin(), rest.end());
    for (std::size_t t = 0; t < targets.size(); ++t) add(shape, row[t], targets[t]);
    errors[i] = distance(linear_blend(shape, weights, wanted.palette), wanted.goal).largest;
  });
  return count == 0 ? 0 : *std::max_element(errors.begin(), errors.end());
}

Correctives bake_correctives(std::span<const Vec3> rest, const SkinWeights& weights, std::size_t count,
                             const std::function<CorrectiveFrame(std::size_t)>& frame,
                             const CorrectiveOptions& options) {
  return Baker(rest, weights, count, frame, options).bake();
}

Correctives example_correctives(std::span<const Vec3> rest, const SkinWeights& weights,
                                const Deformer& deformer, std::size_t count,
                                const std::function<PosedBones(std::size_t)>& frame) {
  Correctives result;
  for (const std::vector<Vec3>& offsets : deformer.example_offsets()) {
    std::vector<Vec3>& target = result.targets.emplace_back();
    for (const Vec3& offset : offsets) target.push_back(as_float(offset));
  }
  double squares = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const PosedBones bones = frame(i);
    const std::vector<double> a = deformer.example_weights(bones);
    const std::vector<Vec3> goal = deformer(bones);
    std::vector<Vec3> shape(rest.begin(), rest.end());
    result.before =
        std::max(result.before, distance(linear_blend(shape, weights, bones.palette), goal).largest);
    std::vector<double>& row = result.weights.emplace_back();
    for (std::size_t t = 0; t < result.targets.size(); ++t) {
      row.push_back(as_float(a[t]));
      add(shape, row.back(), result.targets[t]);
    }
    const Distance d = distance(linear_blend(shape, weights, bones.palette), goal);
    result.largest = std::max(result.largest, d.largest);
    squares += d.squares;
  }
  result.by_count = {result.before, result.largest};
  if (count > 0 && !rest.empty()) result.rms = std::sqrt(squares / static_cast<double>(count * rest.size()));
  return result;
}

}  // namespace skinforge
