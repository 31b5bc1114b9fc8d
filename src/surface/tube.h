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

  /// The tube of a table as it lies on the domain, not smoothed yet. Vertices: the fixed ones of the domain,
  /// those of its seams, the new ones.
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
