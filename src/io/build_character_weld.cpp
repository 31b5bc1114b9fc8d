#include "io/build_character_weld.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace skinforge {
namespace {
constexpr double kMostCells = 0x1p62;  // fits the integers of a cell
}

std::size_t PointIndex::CellHash::operator()(const Cell& c) const {
  std::uint64_t hash = 0;
  for (const std::int64_t x : c) hash = (hash ^ static_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15ull;
  return static_cast<std::size_t>(hash ^ (hash >> 32));
}

PointIndex::Cell PointIndex::cell_of(const Vec3& point) const {
  Cell cell;
  for (int axis = 0; axis < 3; ++axis) {
    const double x = point[axis] + 0.0;  // -0 is 0
    const double number = cell_ > 0 ? std::floor(x / cell_) : kMostCells;
    if (std::abs(number) < kMostCells)
      cell[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(number);
    else  // so far out that the tolerance is lost in rounding
      std::memcpy(&cell[static_cast<std::size_t>(axis)], &x, sizeof x);
  }
  return cell;
}

void PointIndex::add(std::size_t id, const Vec3& point) {
  cells_[cell_of(point)].emplace_back(id, point);
}

std::vector<std::size_t> PointIndex::near(const Vec3& point) const {
  const Vec3 reach = Vec3::Constant(tolerance_);
  const Cell low = cell_of(point - reach);
  Cell high = cell_of(point + reach);
  // A reach without end, or one that is lost in rounding on one side only, would take forever.
  for (std::size_t axis = 0; axis < 3; ++axis) high[axis] = std::min(high[axis], low[axis] + 2);
  std::vector<std::size_t> ids;
  for (std::int64_t x = low[0]; x <= high[0]; ++x)
    for (std::int64_t y = low[1]; y <= high[1]; ++y)
      for (std::int64_t z = low[2]; z <= high[2]; ++z) {
        const auto cell = cells_.find({x, y, z});
        if (cell == cells_.end()) continue;
        for (const auto& [id, other] : cell->second)
          if ((other - point).norm() <= tolerance_) ids.push_back(id);
      }
  std::sort(ids.begin(), ids.end());
  return ids;
}

}  // namespace skinforge
