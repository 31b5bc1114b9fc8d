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

// Voxels between the surface and all of a cube, at least.
double least_distance(const SamplingReach& reach, std::int32_t size, Side side) {
  if (size == 2) return side == Side::Inside ? reach.pairs_inside : reach.pairs_outside;
  return side == Side::Inside ? reach.fours_inside : reach.fours_outside;
}

std::int32_t floor_to(std::int32_t value, std::int32_t step) {
  const std::int32_t rest = value % step;
  return value - (rest < 0 ? rest + step : rest);
}

// What is known of a cube, or of the one around it.
struct Known {
  std::int32_t triangle = 0;
  Side side = Side::Unknown;
  double distance = 0;  // of its centre from the surface
};

class Classifier {
 public:
  Classifier(const TriangleBvh& bvh, const SamplingReach& reach, SamplingCells& cells)
      : bvh_(bvh), reach_(reach), cells_(cells) {}

  // Cells [begin, begin + size) along each axis, as far as there are any. `around`: of the cube around it.
  void visit(const std::array<std::int32_t, 3>& begin, std::int32_t size, const Known& around) const {
    const double radius = std::sqrt(3.0) / 2 * size * cells_.lattice.voxel;
    // The centre of the cube around it is as far from its own as the corners are.
    if (size <= SamplingCells::kCoarsest && is_far(around.side, around.distance - 2 * radius, size))
      return fill(begin, size, size, around);
    if (size == kFinestAsked && !may_be_far(around.distance, size)) return fill(begin, size, 1, around);
    const Vec3 centre = cells_.lattice.point(begin[0], begin[1], begin[2]) +
                        Vec3::Constant(cells_.lattice.voxel * size / 2.0);
    const ClosestPoint nearest = bvh_.closest_from_hint(centre, around.triangle);
    Known here{nearest.triangle, around.side, nearest.distance};
    if (here.side == Side::Unknown) here.side = side(centre, nearest.distance, radius);
    const std::int32_t asked_by = std::min(size, SamplingCells::kCoarsest);
    if (is_far(here.side, here.distance - radius, asked_by)) return fill(begin, size, asked_by, here);
    if (size > kFinestAsked) return split(begin, size, here);
    fill(begin, size, 1, here);
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

  bool is_far(Side side, double spare, std::int32_t size) const {
    return side != Side::Unknown && spare >= least_distance(reach_, size, side) * cells_.lattice.voxel;
  }

  bool may_be_far(double spare, std::int32_t size) const {
    return is_far(Side::Outside, spare, size) || is_far(Side::Inside, spare, size);
  }

  void fill(const std::array<std::int32_t, 3>& begin, std::int32_t size, std::int32_t asked_by,
            const Known& known) const {
    const auto n = cells_.count();
    const auto end = [&](int axis) { return std::min((begin[axis] + size) / 2, n[axis]); };
    for (std::int32_t k = begin[2] / 2; k < end(2); ++k)
      for (std::int32_t j = begin[1] / 2; j < end(1); ++j) {
        const auto row = cells_.cubes.begin() + (static_cast<std::ptrdiff_t>(k) * n[1] + j) * n[0];
        std::fill(row + begin[0] / 2, row + end(0),
                  SamplingCells::Cube{known.triangle, static_cast<std::uint8_t>(asked_by), known.side});
      }
  }

  void split(const std::array<std::int32_t, 3>& begin, std::int32_t size, const Known& here) const {
    for (int octant = 0; octant < 8; ++octant) {
      std::array<std::int32_t, 3> part = begin;
      bool is_there = true;
      for (int axis = 0; axis < 3; ++axis) {
        part[axis] += (octant >> axis & 1) * size / 2;
        is_there &= part[axis] + 1 < cells_.lattice.size[axis];
      }
      if (is_there) visit(part, size / 2, here);
    }
  }

  const TriangleBvh& bvh_;
  const SamplingReach& reach_;
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
  cells.cubes.resize(static_cast<std::size_t>(n[0]) * n[1] * n[2]);
  return cells;
}

}  // namespace

void SamplingCells::look_around(std::int32_t i, std::int32_t j, std::int32_t k,
                                std::span<Around> points) const {
  const auto n = count();
  const auto end = i + static_cast<std::int32_t>(points.size());
  std::fill(points.begin(), points.end(), Around{});
  // A point with an odd coordinate lies in the middle of a cube, one with an even one between two.
  for (std::int32_t z = std::max(k - 1, 0) / 2; z <= std::min(k / 2, n[2] - 1); ++z)
    for (std::int32_t y = std::max(j - 1, 0) / 2; y <= std::min(j / 2, n[1] - 1); ++y)
      for (std::int32_t x = std::max(i - 1, 0) / 2; x <= std::min((end - 1) / 2, n[0] - 1); ++x) {
        const Cube& cube = at(x, y, z);
        for (std::int32_t p = std::max(2 * x, i); p < std::min(2 * x + 3, end); ++p) {
          Around& point = points[static_cast<std::size_t>(p - i)];
          point.size = std::min(point.size, cube.size);
          if (point.side == Side::Unknown) point.side = cube.side;
        }
      }
}

SamplingCells sampling_cells(const Lattice& lattice, const TriangleBvh& bvh, const SamplingReach& reach) {
  SamplingCells cells = grown(lattice);
  std::vector<std::array<std::int32_t, 3>> blocks;
  const auto& size = cells.lattice.size;
  for (std::int32_t k = 0; k + 1 < size[2]; k += kBlock)
    for (std::int32_t j = 0; j + 1 < size[1]; j += kBlock)
      for (std::int32_t i = 0; i + 1 < size[0]; i += kBlock) blocks.push_back({i, j, k});
  const Classifier classifier(bvh, reach, cells);
  parallel_for(blocks.size(), [&](std::size_t b) { classifier.visit(blocks[b], kBlock, {}); });
  return cells;
}

}  // namespace skinforge
