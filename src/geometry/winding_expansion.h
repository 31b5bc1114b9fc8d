#pragma once

#include <array>
#include <span>

#include "geometry/box_tree.h"
#include "geometry/triangle_math.h"

namespace skinforge {

/// Moments of a cluster of triangles about a centre p, for its far field (Barill 2018, Sec. 3): with area
/// normal n and d = x - p, the polynomials in r  integral of (n.r), of (n.r)(d.r) and of (n.r)(d.r)^2. Their
/// coefficients are those of x, y, z; of xx, yy, zz, yz, xz, xy; and of xxx, yyy, zzz, xxy, xxz, xyy, yyz,
/// xzz, yzz, xyz.
struct WindingMoments {
  using Linear = Eigen::Matrix<double, 3, 1>;
  using Quadratic = Eigen::Matrix<double, 6, 1>;
  using Cubic = Eigen::Matrix<double, 10, 1>;

  Vec3 centre = Vec3::Zero();
  double area = 0;
  Linear order0 = Linear::Zero();
  Quadratic order1 = Quadratic::Zero();
  Cubic order2 = Cubic::Zero();

  /// Moments of one triangle about its centroid; all zero for a degenerate one.
  static WindingMoments of(const TriangleCorners& t);
  /// Moments of the union about the area-weighted mean centre. Zero area gives the first centre.
  static WindingMoments sum(std::span<const WindingMoments> parts);
  /// The same cluster about another centre.
  WindingMoments about(const Vec3& new_centre) const;
};

/// Far fields of the four children of a node, side by side.
struct WindingExpansion {
  using Lanes = BoxTree::Lanes;
  std::array<Lanes, 3> centre;
  Lanes
      far2;  ///< squared distance from the centre beyond which the expansion holds; +inf for an absent child
  std::array<Lanes, 3> order0;
  std::array<Lanes, 6> order1;   ///< without its trace: harmonic part only, times 3
  std::array<Lanes, 10> order2;  ///< without its trace, times 15/2

  WindingExpansion();
  /// Sets one lane; `radius`: largest distance of a vertex of the cluster from its centre.
  void set(int lane, const WindingMoments& moments, double radius);

  /// 4 pi times the winding number of each cluster at `query`, and its squared distance in `distance2`.
  struct Value {
    Lanes solid_angle, distance2;
  };
  Value at(const Vec3& query) const;
};

}  // namespace skinforge
