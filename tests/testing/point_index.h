#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

namespace skinforge::testing {

/// Finds points near a place; sorted along x, then scanned, so fast only when few points share an x.
class PointIndex {
 public:
  using Point = Eigen::Vector3d;

  explicit PointIndex(std::vector<Point> points) : points_(std::move(points)), order_(points_.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_sort(order_.begin(), order_.end(),
                     [this](std::size_t a, std::size_t b) { return points_[a].x() < points_[b].x(); });
  }

  /// All points at most `radius` away, by rising x.
  std::vector<std::size_t> near(const Point& p, double radius) const {
    std::vector<std::size_t> found;
    for (std::size_t i = first_from(p.x() - radius); i < order_.size(); ++i) {
      if (points_[order_[i]].x() > p.x() + radius) break;
      if ((points_[order_[i]] - p).norm() <= radius) found.push_back(order_[i]);
    }
    return found;
  }

  /// The nearest point; there must be one.
  std::size_t nearest(const Point& p) const {
    std::size_t best = order_.front();
    double distance = std::numeric_limits<double>::infinity();
    const auto consider = [&](std::size_t point) {
      const double d = (points_[point] - p).norm();
      if (d < distance) best = point, distance = d;
    };
    const std::size_t middle = first_from(p.x());
    for (std::size_t i = middle; i < order_.size() && points_[order_[i]].x() - p.x() < distance; ++i)
      consider(order_[i]);
    for (std::size_t i = middle; i > 0 && p.x() - points_[order_[i - 1]].x() < distance; --i)
      consider(order_[i - 1]);
    return best;
  }

 private:
  std::size_t first_from(double x) const {
    const auto place = std::lower_bound(order_.begin(), order_.end(), x, [this](std::size_t i, double value) {
      return points_[i].x() < value;
    });
    return static_cast<std::size_t>(place - order_.begin());
  }

  std::vector<Point> points_;
  std::vector<std::size_t> order_;
};

}  // namespace skinforge::testing
