#pragma once

#include <optional>
#include <string>

#include "surface/junction_loop.h"
#include "surface/quad_patch.h"
#include "surface/tube_chart.h"

namespace skinforge {

/// Tubes of quads between two borders that continue their rows (junction.md b.2): rung 2. One triangle when
/// the borders' counts add up to an odd number.
class QuadTube {
 public:
  /// `domain`: a triangulated tube between the borders, as rung 1 gives it; it says where the quads lie, not
  /// how they run. Its fixed vertices are those of `loops`. Refers to `domain`, which must outlive it. None,
  /// with the reason in `fault`, when the domain is no tube.
  static std::optional<QuadTube> make(const TrianglePatch& domain, const std::vector<JunctionLoop>& loops,
                                      std::string& fault);

  /// Rows that continue the pace of both borders and let their counts meet.
  int wanted_rows() const { return wanted_rows_; }

  /// With that many rows; `project` brings a free vertex back onto the wanted surface. None when the counts
  /// do not meet in them.
  std::optional<QuadPatch> with(int rows, const TubeOptions& options, const Projection& project) const;

 private:
  QuadTube(const TrianglePatch& domain, TubeChart chart) : domain_(&domain), chart_(std::move(chart)) {}

  const TrianglePatch* domain_;
  TubeChart chart_;
  IndexLoop b_;  // border B, in the direction in which theta rises
  TubeSide side_a_, side_b_;
  double depth_a_ = 0, depth_b_ = 0;
  std::vector<double> lengths_;
  int wanted_rows_ = 0;
};

}  // namespace skinforge
