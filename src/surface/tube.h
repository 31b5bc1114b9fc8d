#pragma once

#include <optional>
#include <string>

#include "surface/patch_mirror.h"
#include "surface/tube_chart.h"
#include "surface/tube_domain.h"

namespace skinforge {

/// Tubes of quads between two borders that continue their rows (junction.md b.2): rung 2. One triangle when
/// the borders' counts add up to an odd number.
class QuadTube {
 public:
  /// `domain` says where the quads lie, not how they run. Refers to it; it must outlive the tube. None, with
  /// the reason in `fault`, when it has no coordinates of a tube.
  static std::optional<QuadTube> make(const TubeDomain& domain, std::string& fault);

  /// Rows that continue the pace of both borders and let their counts meet.
  int wanted_rows() const { return wanted_rows_; }

  /// Columns in that many rows; none when the counts do not meet in them.
  std::optional<TubeTable> table(int rows, const TubeOptions& options) const;

  /// The same, columns mirrored (`solve_symmetric_tube`), `borders` naming the images of the fixed vertices;
  /// none, too, when that does not map each border onto itself.
  std::optional<TubeTable> symmetric_table(int rows, const TubeOptions& options,
                                           const PatchMirror& borders) const;

  /// The tube of a table. Vertices: the fixed ones of the domain, those of its seams, the new ones.
  /// `is_polished`: places are evened out first, which serves all but thin and sharp shapes.
  QuadPatch made(const TubeTable& table, int rows, const WantedSurface& surface, bool is_polished) const;

  /// The same, with the images of new vertices exactly across the plane; none when the table is not mirrored.
  std::optional<QuadPatch> made_symmetric(const TubeTable& table, int rows, const WantedSurface& surface,
                                          const PatchMirror& borders, bool is_polished) const;

  /// The same as it lies on the domain, not smoothed yet.
  QuadPatch laid(const TubeTable& table, int rows) const;

 private:
  QuadTube(const TubeDomain& domain, TubeChart chart) : domain_(&domain), chart_(std::move(chart)) {}

  const TubeDomain* domain_;
  TubeChart chart_;
  TubeSide side_a_, side_b_;
  std::vector<double> lengths_;
  int wanted_rows_ = 0;
};

}  // namespace skinforge
