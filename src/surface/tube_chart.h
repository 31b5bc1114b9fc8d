#pragma once

#include <optional>

#include "surface/borders.h"
#include "surface/tube_table.h"

namespace skinforge {

/// Coordinates of a triangulated tube between two borders: u harmonic from 0 on A to 1 on B, theta its
/// conjugate, a harmonic 1-form that grows by one once around (junction.md b.2, step 1).
class TubeChart {
 public:
  /// `a`, `b`: the two boundary loops of `patch`, `a` as the faces run along it, `b` against them, so theta
  /// rises along both. None when the patch is no tube between them or theta does not rise along a border.
  static std::optional<TubeChart> make(const TrianglePatch& patch, const IndexLoop& a, const IndexLoop& b);

  const std::vector<double>& theta_a() const { return theta_a_; }  ///< turns, rising, from [0, 1)
  const std::vector<double>& theta_b() const { return theta_b_; }

  /// Mean length along the tube from A to each of `count` + 1 even steps of u, metres: <1 / |grad u|> du.
  std::vector<double> lengths(int count) const;

  /// The point of the patch at (u, theta), u in [0, 1]; outside the last triangle it is extended.
  Vec3 at(double u, double theta) const;

 private:
  struct Corner {
    double u = 0, theta = 0;  // theta unwrapped within its triangle
  };
  TubeChart(const TrianglePatch& patch) : patch_(&patch) {}
  bool solve(const IndexLoop& a, const IndexLoop& b);
  void sort_into_bands();

  const TrianglePatch* patch_;
  std::vector<std::array<Corner, 3>> corners_;    // per triangle
  std::vector<std::vector<std::int32_t>> bands_;  // triangles by theta
  std::vector<double> theta_a_, theta_b_;
};

}  // namespace skinforge
