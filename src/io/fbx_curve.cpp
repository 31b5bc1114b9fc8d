#include "io/fbx_curve.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/error.h"

namespace skinforge {
namespace {

constexpr double kTicksPerSecond = 46'186'158'000;  // FBX time
constexpr std::uint32_t kConstant = 0x2, kCubic = 0x8;
constexpr std::uint32_t kConstantNext = 0x100;  // with kConstant: the value of the key that ends the piece
constexpr std::uint32_t kRightWeighted = 0x1000000, kLeftWeighted = 0x2000000;
constexpr double kWeightUnit = 9999;     // weights are stored as 16-bit parts of this
constexpr double kPlainWeight = 2.5e-4;  // a third, stored in these units, is this far off

double weight(std::uint32_t stored) {
  const double value = std::clamp(stored / kWeightUnit, 1e-4, 1.0);
  return std::abs(value - 1.0 / 3) < kPlainWeight ? 1.0 / 3 : value;
}

double bezier(double a, double b, double c, double d, double s) {
  const double r = 1 - s;
  return r * r * r * a + 3 * r * r * s * b + 3 * r * s * s * c + s * s * s * d;
}

/// The parameter where a Bezier curve in time, from 0 to 1 with inner points b and c, has the time x.
double parameter_at(double b, double c, double x) {
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {  // halves down to the last bit
    const double middle = (low + high) / 2;
    (bezier(0, b, c, 1, middle) < x ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace

FbxCurve::FbxCurve(const FbxNode& node) {
  const std::vector<double> times = numbers_of(node.child("KeyTime"));
  const std::vector<double> values = numbers_of(node.child("KeyValueFloat"));
  const std::vector<double> flags = numbers_of(node.child("KeyAttrFlags"));
  const std::vector<double> repeats = numbers_of(node.child("KeyAttrRefCount"));
  const std::vector<float> data = floats_of(node.child("KeyAttrDataFloat"));
  if (times.size() != values.size() || flags.size() != repeats.size() || data.size() < 4 * flags.size())
    throw Error(ExitCode::BadInput, "FBX: the lists of an animation curve do not match");
  std::size_t group = 0;
  double left = repeats.empty() ? 0 : repeats[0];
  for (std::size_t k = 0; k < times.size(); ++k) {
    while (left <= 0 && group + 1 < repeats.size()) left = repeats[++group];
    left -= 1;
    const double seconds = times[k] / kTicksPerSecond;
    if (!std::isfinite(seconds) || !std::isfinite(values[k]) || (!times_.empty() && seconds <= times_.back()))
      continue;
    times_.push_back(seconds);
    values_.push_back(values[k]);
    const bool known = group < flags.size() && flags[group] >= 0 && flags[group] < 4294967296.0;
    pieces_.push_back(known ? read_piece(static_cast<std::uint32_t>(flags[group]), &data[4 * group])
                            : Piece{});
  }
  is_constant_ = find_constant();
}

FbxCurve::Piece FbxCurve::read_piece(std::uint32_t flags, const float* data) const {
  Piece piece;
  if (flags & kConstant) piece.kind = flags & kConstantNext ? Kind::ConstantNext : Kind::Constant;
  if (flags & kCubic) piece.kind = Kind::Cubic;
  piece.right_slope = std::isfinite(data[0]) ? data[0] : 0;
  piece.left_slope = std::isfinite(data[1]) ? data[1] : 0;
  const auto packed = std::bit_cast<std::uint32_t>(data[2]);
  if (flags & kRightWeighted) piece.right_weight = weight(packed & 0xffff);
  if (flags & kLeftWeighted) piece.left_weight = weight(packed >> 16);
  return piece;
}

double FbxCurve::between(std::size_t key, double time) const {
  const Piece& piece = pieces_[key];
  const double a = values_[key], d = values_[key + 1];
  if (piece.kind == Kind::Constant) return a;
  if (piece.kind == Kind::ConstantNext) return d;
  const double length = times_[key + 1] - times_[key], x = (time - times_[key]) / length;
  if (piece.kind == Kind::Linear) return a + (d - a) * x;
  const double b = a + piece.right_slope * piece.right_weight * length;
  const double c = d - piece.left_slope * piece.left_weight * length;
  const bool is_plain = piece.right_weight == 1.0 / 3 && piece.left_weight == 1.0 / 3;
  return bezier(a, b, c, d, is_plain ? x : parameter_at(piece.right_weight, 1 - piece.left_weight, x));
}

double FbxCurve::at(double time, bool from_left) const {
  if (times_.empty()) return 0;
  if (is_constant_) return values_.front();
  const auto next = from_left ? std::lower_bound(times_.begin(), times_.end(), time)
                              : std::upper_bound(times_.begin(), times_.end(), time);
  if (next == times_.begin()) return values_.front();
  const auto key = static_cast<std::size_t>(next - times_.begin()) - 1;
  if (next == times_.end()) return values_.back();
  return between(key, time);
}

bool FbxCurve::find_constant() const {
  for (std::size_t k = 0; k + 1 < times_.size(); ++k)
    if (values_[k] != values_[k + 1] ||
        (pieces_[k].kind == Kind::Cubic && (pieces_[k].right_slope != 0 || pieces_[k].left_slope != 0)))
      return false;
  return true;
}

}  // namespace skinforge
