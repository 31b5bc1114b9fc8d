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

Cell cell_at(double coordinate, int points) {
  const double inside = std::clamp(coordinate, 0.0, static_cast<double>(points - 1));
  const int first = std::min(static_cast<int>(inside), std::max(points - 2, 0));
  return {first, std::min(first + 1, points - 1), inside - first};
}

double lerp(double a, double b, double t) {
  return a + t * (b - a);
}

}  // namespace

double DistanceField::at(const Vec3& p) const {
  SF_EXPECT(lattice.count() > 0 && values.size() == lattice.count());
  const Vec3 index = (p - lattice.origin) / lattice.voxel;
  const Cell x = cell_at(index.x(), lattice.size[0]);
  const Cell y = cell_at(index.y(), lattice.size[1]);
  const Cell z = cell_at(index.z(), lattice.size[2]);
  const auto row = [&](int j, int k) -> double {
    return lerp(values[lattice.index(x.first, j, k)], values[lattice.index(x.second, j, k)], x.t);
  };
  const auto layer = [&](int k) { return lerp(row(y.first, k), row(y.second, k), y.t); };
  return lerp(layer(z.first), layer(z.second), z.t);
}

Vec3 DistanceField::gradient(const Vec3& p) const {
  const double half = lattice.voxel / 2;
  Vec3 result;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 step = half * Vec3::Unit(axis);
    result[axis] = (at(p + step) - at(p - step)) / lattice.voxel;
  }
  return result;
}

}  // namespace skinforge
