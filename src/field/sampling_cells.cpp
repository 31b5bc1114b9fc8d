#include "field/sampling_cells.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"

namespace skinforge {
namespace {

constexpr std::int32_t kBlock = 16;  // ours: enough blocks for a few threads on the smallest lattices in use
constexpr double kDoubt = 0.02;  // ours: error of the winding number (3e-3 measured) and of the bound below
constexpr std::int32_t kFinestAsked = 2;  // smaller cubes would ask as often as their corners

// Voxels between the surface and all of a cube, at least. Ours: source_distance.md says what they cost.
double least_distance(std::int32_t size, Side side) {
  if (size == 2) return side == Side::Inside ? 12 : 6;
  return side == Side::Inside ? 20 : 16;
}

std::int32_t floor_to(std::int32_t value, std::int32_t step) {
  const std::int32_t rest = value % step;
  return value - (rest < 0 ? rest + step : rest);
}

class Classifier {
 public:
  Classifier(const TriangleBvh& bvh, SamplingCells& cells) : bvh_(bvh), cells_(cells) {}

  // Cells [begin, begin + size) along each axis, as far as there are any. `known`: of the cube around it.
  void visit(const std::array<std::int32_t, 3>& begin, std::int32_t size,
             const SamplingCells::Cell& known) const {
    const Vec3 center = cells_.lattice.point(begin[0], begin[1], begin[2]) +
                        Vec3::Constant(cells_.lattice.voxel * size / 2.0);
    const double radius = std::sqrt(3.0) / 2 * size * cells_.lattice.voxel;
    const ClosestPoint nearest = bvh_.closest_from_hint(center, known.triangle);
    SamplingCells::Cell here{nearest.triangle, static_cast<std::uint8_t>(size), known.side};
    if (here.side == Side::Unknown) here.side = side(center, nearest.distance, radius);
    const double spare = nearest.distance - radius;
    const bool is_far = size <= SamplingCells::kCoarsest && here.side != Side::Unknown &&
                        spare >= least_distance(size, here.side) * cells_.lattice.voxel;
    if (is_far) return fill(begin, size, here);
    if (size > kFinestAsked) return split(begin, size, here);
    here.size = 1;
    fill(begin, size, here);
  }

 private:
  // The side of all points within `radius` of the center, if it is sure. Beside a straight rim at distance d
  // the winding number changes by at most log(1 / (1 - s)) / (2 pi) on a way of s d; that is taken as the
  // bound for every surface.
  Side side(const Vec3& center, double distance, double radius) const {
    if (radius > distance) return Side::Unknown;
    const double winding = bvh_.winding_number(center);
    const double spare = std::abs(winding - 0.5) - kDoubt;
    if (radius > distance * -std::expm1(-2 * std::numbers::pi * spare)) return Side::Unknown;
    return winding > 0.5 ? Side::Inside : Side::Outside;
  }

  void fill(const std::array<std::int32_t, 3>& begin, std::int32_t size,
            const SamplingCells::Cell& cell) const {
    const auto n = cells_.count();
    for (std::int32_t k = begin[2]; k < begin[2] + size; ++k)
      for (std::int32_t j = begin[1]; j < begin[1] + size; ++j)
        std::fill_n(cells_.cells.begin() + (static_cast<std::ptrdiff_t>(k) * n[1] + j) * n[0] + begin[0],
                    size, cell);
  }

  void split(const std::array<std::int32_t, 3>& begin, std::int32_t size,
             const SamplingCells::Cell& here) const {
    const auto n = cells_.count();
    for (int octant = 0; octant < 8; ++octant) {
      std::array<std::int32_t, 3> part = begin;
      bool is_there = true;
      for (int axis = 0; axis < 3; ++axis) {
        part[axis] += (octant >> axis & 1) * size / 2;
        is_there &= part[axis] < n[axis];
      }
      if (is_there) visit(part, size / 2, here);
    }
  }

  const TriangleBvh& bvh_;
  SamplingCells& cells_;
};

SamplingCells grown(const Lattice& lattice) {
  constexpr std::int32_t step = SamplingCells::kCoarsest;
  SamplingCells cells;
  cells.lattice.voxel = lattice.voxel;
  for (int axis = 0; axis < 3; ++axis) {
    const auto low = static_cast<std::int32_t>(std::lround(lattice.origin[axis] / lattice.voxel));
    const std::int32_t begin = floor_to(low, step), end = -floor_to(-(low + lattice.size[axis] - 1), step);
    cells.first[axis] = low - begin;
    cells.lattice.size[axis] = std::max(end - begin, step) + 1;
    cells.lattice.origin[axis] = lattice.origin[axis] - cells.first[axis] * lattice.voxel;
  }
  const auto n = cells.count();
  cells.cells.resize(static_cast<std::size_t>(n[0]) * n[1] * n[2]);
  return cells;
}

}  // namespace

const SamplingCells::Cell& SamplingCells::finest_around(std::int32_t i, std::int32_t j,
                                                        std::int32_t k) const {
  const auto n = count();
  const Cell* finest = &at(std::min(i, n[0] - 1), std::min(j, n[1] - 1), std::min(k, n[2] - 1));
  for (std::int32_t z = std::max(k - 1, 0); z <= std::min(k, n[2] - 1); ++z)
    for (std::int32_t y = std::max(j - 1, 0); y <= std::min(j, n[1] - 1); ++y)
      for (std::int32_t x = std::max(i - 1, 0); x <= std::min(i, n[0] - 1); ++x)
        if (at(x, y, z).size < finest->size) finest = &at(x, y, z);
  return *finest;
}

SamplingCells sampling_cells(const Lattice& lattice, const TriangleBvh& bvh) {
  SamplingCells cells = grown(lattice);
  std::vector<std::array<std::int32_t, 3>> blocks;
  const auto n = cells.count();
  for (std::int32_t k = 0; k < n[2]; k += kBlock)
    for (std::int32_t j = 0; j < n[1]; j += kBlock)
      for (std::int32_t i = 0; i < n[0]; i += kBlock) blocks.push_back({i, j, k});
  const Classifier classifier(bvh, cells);
  parallel_for(blocks.size(), [&](std::size_t b) { classifier.visit(blocks[b], kBlock, {}); });
  return cells;
}

}  // namespace skinforge
