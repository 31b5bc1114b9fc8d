#include "field/signed_distance.h"

#include <algorithm>
#include <cmath>

#include "base/expect.h"

namespace skinforge {
namespace {

// The cell below a coordinate and the place within it, kept inside the lattice.
struct Cell {
  int first = 0, second = 0;
  double t = 0;
};

// Inlined by force: half of the time of a large junction is spent in here.
[[gnu::always_inline]] inline Cell cell_at(double coordinate, int points) {
  const double inside = std::min(std::max(coordinate, 0.0), static_cast<double>(points - 1));
  const int first = std::min(static_cast<int>(inside), std::max(points - 2, 0));
  return {first, std::min(first + 1, points - 1), inside - first};
}

double lerp(double a, double b, double t) {
  return a + t * (b - a);
}

using Cells = std::array<Cell, 3>;

Cells cells_at(const Lattice& lattice, const Vec3& p) {
  const Vec3 index = (p - lattice.origin) / lattice.voxel;
  return {cell_at(index.x(), lattice.size[0]), cell_at(index.y(), lattice.size[1]),
          cell_at(index.z(), lattice.size[2])};
}

double interpolate(const DistanceField& field, const Cells& cells) {
  const Cell &x = cells[0], &y = cells[1], &z = cells[2];  // no binding: clang 14 cannot capture one
  const auto row = [&](int j, int k) -> double {
    const float* values = field.values.data() + field.lattice.index(0, j, k);
    return lerp(values[x.first], values[x.second], x.t);
  };
  const auto layer = [&](int k) { return lerp(row(y.first, k), row(y.second, k), y.t); };
  return lerp(layer(z.first), layer(z.second), z.t);
}

}  // namespace

double DistanceField::at(const Vec3& p) const {
  SF_EXPECT(lattice.count() > 0 && values.size() == lattice.count());
  return lattice.voxel * interpolate(*this, cells_at(lattice, p));
}

Vec3 DistanceField::gradient(const Vec3& p) const {
  SF_EXPECT(lattice.count() > 0 && values.size() == lattice.count());
  const double half = lattice.voxel / 2;
  const Cells centre = cells_at(lattice, p);
  const Cells above = cells_at(lattice, p + Vec3::Constant(half));
  const Cells below = cells_at(lattice, p - Vec3::Constant(half));
  Vec3 result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Cells high = centre, low = centre;
    high[axis] = above[axis];
    low[axis] = below[axis];
    result[static_cast<Eigen::Index>(axis)] = interpolate(*this, high) - interpolate(*this, low);
  }
  return result;
}

}  // namespace skinforge
