#pragma once

#include <vector>

#include "io/fbx_document.h"

namespace skinforge {

/// One animated number of an FBX file over time in seconds: constant, linear or Bezier between its keys,
/// constant outside.
class FbxCurve {
 public:
  /// From an AnimationCurve node. Keys whose time does not rise are left out. Throws Error (BadInput) when
  /// its lists do not match.
  explicit FbxCurve(const FbxNode& node);

  const std::vector<double>& times() const { return times_; }
  /// Value at a time. At the jump that ends a constant piece: from the right, or as the limit `from_left`.
  double at(double time, bool from_left = false) const;
  bool is_constant() const { return is_constant_; }

 private:
  enum class Kind { Constant, ConstantNext, Linear, Cubic };
  struct Piece {  ///< from one key to the next
    Kind kind = Kind::Linear;
    double right_slope = 0, left_slope = 0;                ///< at its begin and its end, per second
    double right_weight = 1.0 / 3, left_weight = 1.0 / 3;  ///< of its length
  };
  Piece read_piece(std::uint32_t flags, const float* data) const;
  double between(std::size_t key, double time) const;
  bool find_constant() const;

  std::vector<double> times_;
  std::vector<double> values_;
  std::vector<Piece> pieces_;  ///< one per key; that of the last is not used
  bool is_constant_ = true;
};

}  // namespace skinforge
