#include "geometry/solid_voxels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "base/expect.h"
#include "base/parallel.h"

namespace skinforge {
namespace {

constexpr std::size_t kChunk = 256;  // ours: cells a task

}  // namespace

SolidVoxels::SolidVoxels(std::span<const Vec3> positions,
                         std::span<const std::array<std::int32_t, 3>> triangles, int resolution) {
  SF_EXPECT(resolution >= 4);
  Eigen::AlignedBox3d box;
  for (const Vec3& p : positions) box.extend(p);
  if (box.isEmpty() || box.diagonal().maxCoeff() <= 0) return;
  size_ = box.diagonal().maxCoeff() / resolution;
  origin_ = box.min() - Vec3::Constant(size_ / 2);  // half a cell free around
  for (int k = 0; k < 3; ++k)
    counts_[static_cast<std::size_t>(k)] = static_cast<int>(std::floor(box.diagonal()[k] / size_)) + 2;
  fill(positions, triangles);
}

void SolidVoxels::fill(std::span<const Vec3> positions,
                       std::span<const std::array<std::int32_t, 3>> triangles) {
  const std::size_t total = static_cast<std::size_t>(counts_[0]) * counts_[1] * counts_[2];
  std::vector<std::uint8_t> solid(total, 0);
  for (const auto& t : triangles) {  // points of each triangle, less than half a cell apart
    const Vec3 &a = positions[static_cast<std::size_t>(t[0])], &b = positions[static_cast<std::size_t>(t[1])],
               &c = positions[static_cast<std::size_t>(t[2])];
    const double longest = std::max({(b - a).norm(), (c - a).norm(), (c - b).norm()});
    const int steps = std::max(1, static_cast<int>(std::ceil(2 * longest / size_)));
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; i + j <= steps; ++j)
        solid[static_cast<std::size_t>(index(cell_of(a + (b - a) * i / steps + (c - a) * j / steps)))] = 1;
  }
  const TriangleBvh bvh(positions, triangles);
  parallel_chunks(total, kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (solid[i]) continue;
      const auto n0 = static_cast<std::size_t>(counts_[0]), n1 = static_cast<std::size_t>(counts_[1]);
      const Vec3 cell(static_cast<double>(i % n0), static_cast<double>(i / n0 % n1),
                      static_cast<double>(i / n0 / n1));
      if (bvh.winding_number(origin_ + size_ * (cell + Vec3::Constant(0.5))) > 0.5) solid[i] = 1;
    }
  });
  filled_.assign(total, -1);
  for (int z = 0; z < counts_[2]; ++z)
    for (int y = 0; y < counts_[1]; ++y)
      for (int x = 0; x < counts_[0]; ++x) {
        const auto i = static_cast<std::size_t>(index({x, y, z}));
        if (!solid[i]) continue;
        filled_[i] = static_cast<std::int32_t>(cells_.size());
        cells_.push_back({x, y, z});
      }
}

std::array<int, 3> SolidVoxels::cell_of(const Vec3& p) const {
  std::array<int, 3> cell{};
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    cell[i] = std::clamp(static_cast<int>(std::floor((p[k] - origin_[k]) / size_)), 0, counts_[i] - 1);
  }
  return cell;
}

std::int64_t SolidVoxels::index(const std::array<int, 3>& cell) const {
  return (static_cast<std::int64_t>(cell[2]) * counts_[1] + cell[1]) * counts_[0] + cell[0];
}

Vec3 SolidVoxels::center(std::size_t cell) const {
  const auto& c = cells_[cell];
  return origin_ + size_ * Vec3(c[0] + 0.5, c[1] + 0.5, c[2] + 0.5);
}

std::int32_t SolidVoxels::nearest(const Vec3& p) const {
  if (cells_.empty()) return -1;
  const std::int32_t own = filled_[static_cast<std::size_t>(index(cell_of(p)))];
  if (own >= 0 && (center(static_cast<std::size_t>(own)) - p).norm() <= size_) return own;
  std::size_t best = 0;
  for (std::size_t c = 1; c < cells_.size(); ++c)
    if ((center(c) - p).squaredNorm() < (center(best) - p).squaredNorm()) best = c;
  return static_cast<std::int32_t>(best);
}

std::vector<double> SolidVoxels::distances_from(std::span<const Vec3> points) const {
  std::vector<double> distance(count(), std::numeric_limits<double>::infinity());
  using Step = std::pair<double, std::int32_t>;
  std::priority_queue<Step, std::vector<Step>, std::greater<>> open;
  const auto reach = [&](std::int32_t cell, double d) {
    if (d >= distance[static_cast<std::size_t>(cell)]) return;
    distance[static_cast<std::size_t>(cell)] = d;
    open.push({d, cell});
  };
  for (const Vec3& p : points)
    if (const std::int32_t cell = nearest(p); cell >= 0)
      reach(cell, (center(static_cast<std::size_t>(cell)) - p).norm());
  while (!open.empty()) {
    const auto [d, from] = open.top();
    open.pop();
    if (d > distance[static_cast<std::size_t>(from)]) continue;
    const auto& c = cells_[static_cast<std::size_t>(from)];
    for (int dz = -1; dz <= 1; ++dz)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const std::array<int, 3> next{c[0] + dx, c[1] + dy, c[2] + dz};
          bool is_inside = true;
          for (std::size_t k = 0; k < 3; ++k) is_inside = is_inside && next[k] >= 0 && next[k] < counts_[k];
          if (!is_inside) continue;
          const std::int32_t to = filled_[static_cast<std::size_t>(index(next))];
          if (to >= 0) reach(to, d + size_ * std::sqrt(static_cast<double>(dx * dx + dy * dy + dz * dz)));
        }
  }
  return distance;
}

}  // namespace skinforge
