#include "surface/quad_patch.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/scaled_jacobian.h"

namespace skinforge {
namespace {

constexpr int kLaplacianRounds = 10, kRectangleRounds = 30;  // junction.md b.2
constexpr double kSmoothing = 0.15;                          // share of the neighbours' mean in each round
constexpr double kSameLength = 1e-6;  // ours: of squared diagonals; equal ones must not hang on the last bit

// The rectangle nearest to a quad in shape: its middle lines made square to each other, lengths kept.
std::array<Vec3, 4> best_rectangle(const std::array<Vec3, 4>& p) {
  const Vec3 centre = 0.25 * (p[0] + p[1] + p[2] + p[3]);
  const Vec3 along = 0.5 * (p[1] - p[0] + p[2] - p[3]), up = 0.5 * (p[3] - p[0] + p[2] - p[1]);
  const double width = along.norm(), height = up.norm();
  if (!(width > 0) || !(height > 0)) return p;
  const Vec3 sum = along / width + up / height, difference = along / width - up / height;
  if (!(sum.norm() > 0) || !(difference.norm() > 0)) return p;
  const Vec3 s = sum.normalized(), d = difference.normalized();
  const Vec3 x = 0.5 * width * (s + d) / std::sqrt(2.0), y = 0.5 * height * (s - d) / std::sqrt(2.0);
  return {centre - x - y, centre + x - y, centre + x + y, centre - x + y};
}

class Polisher {
 public:
  Polisher(QuadPatch& patch, const Projection& project)
      : patch_(patch), project_(project), neighbours_(patch.positions.size()) {
    for (const Quad& q : patch.quads)
      for (std::size_t k = 0; k < 4; ++k) join(q[k], q[(k + 1) % 4]);
    for (const Triangle& t : patch.triangles)
      for (std::size_t k = 0; k < 3; ++k) join(t[k], t[(k + 1) % 3]);
  }

  void run() {
    for (int round = 0; round < kLaplacianRounds; ++round)
      move([&](std::size_t v) { return neighbour_mean(v); });
    for (int round = 0; round < kRectangleRounds; ++round) {
      sum_rectangles();
      move([&](std::size_t v) {
        const Vec3 mean = neighbour_mean(v);
        if (uses_[v] == 0) return mean;
        return Vec3((1 - kSmoothing) * (sum_[v] / uses_[v]) + kSmoothing * mean);
      });
    }
  }

 private:
  void join(std::int32_t a, std::int32_t b) {
    neighbours_[a].insert(b);
    neighbours_[b].insert(a);
  }

  Vec3 neighbour_mean(std::size_t v) const {
    Vec3 sum = Vec3::Zero();
    for (const std::int32_t n : neighbours_[v]) sum += patch_.positions[n];
    return sum / static_cast<double>(neighbours_[v].size());
  }

  void sum_rectangles() {
    sum_.assign(patch_.positions.size(), Vec3::Zero());
    uses_.assign(patch_.positions.size(), 0);
    for (const Quad& q : patch_.quads) {
      std::array<Vec3, 4> p;
      for (std::size_t k = 0; k < 4; ++k) p[k] = patch_.positions[q[k]];
      const auto target = best_rectangle(p);
      for (std::size_t k = 0; k < 4; ++k) sum_[q[k]] += target[k], uses_[q[k]] += 1;
    }
  }

  template <class Place>
  void move(const Place& place) {
    std::vector<Vec3> moved = patch_.positions;
    for (std::size_t v = patch_.fixed; v < moved.size(); ++v) moved[v] = project_(place(v));
    patch_.positions = std::move(moved);
  }

  QuadPatch& patch_;
  const Projection& project_;
  std::vector<std::set<std::int32_t>> neighbours_;
  std::vector<Vec3> sum_;
  std::vector<int> uses_;
};

template <class Take>
void for_each_jacobian(const QuadPatch& patch, const Take& take) {
  const auto at = [&](std::int32_t v) { return patch.positions[v]; };
  for (const Quad& q : patch.quads) take(scaled_jacobian_of_quad(at(q[0]), at(q[1]), at(q[2]), at(q[3])));
  for (const Triangle& t : patch.triangles) take(scaled_jacobian_of_triangle(at(t[0]), at(t[1]), at(t[2])));
}

}  // namespace

double least_scaled_jacobian(const QuadPatch& patch) {
  double least = 1;
  for_each_jacobian(patch, [&](double jacobian) { least = std::min(least, jacobian); });
  return least;
}

double mean_scaled_jacobian(const QuadPatch& patch) {
  double sum = 0;
  for_each_jacobian(patch, [&](double jacobian) { sum += jacobian; });
  const std::size_t faces = patch.quads.size() + patch.triangles.size();
  return faces == 0 ? 1 : sum / static_cast<double>(faces);
}

void polish(QuadPatch& patch, const Projection& project) {
  Polisher(patch, project).run();
}

TrianglePatch halved(const QuadPatch& patch) {
  TrianglePatch result{patch.positions, {}, patch.fixed};
  for (const Quad& q : patch.quads) {
    const double first = (patch.positions[q[0]] - patch.positions[q[2]]).squaredNorm();
    const double second = (patch.positions[q[1]] - patch.positions[q[3]]).squaredNorm();
    const std::size_t k = second < (1 - kSameLength) * first ? 1 : 0;
    result.triangles.push_back({q[k], q[k + 1], q[k + 2]});
    result.triangles.push_back({q[k], q[k + 2], q[(k + 3) % 4]});
  }
  result.triangles.insert(result.triangles.end(), patch.triangles.begin(), patch.triangles.end());
  return result;
}

}  // namespace skinforge
