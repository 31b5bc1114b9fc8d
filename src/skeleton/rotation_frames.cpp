#include "skeleton/rotation_frames.h"

#include <fmt/format.h>

#include <Eigen/SVD>

#include "base/error.h"
#include "skeleton/rotations.h"

namespace skinforge {
namespace {

constexpr double kNormalised = 1e-5;      // ours: files hold 1e-7; what is farther off is worth a word
constexpr double kShortest = 1e-6;        // ours: shorter quaternions have no direction worth the name
constexpr double kFarFromRotation = 0.1;  // ours: a scaled or sheared matrix, not rounding

class FrameReader {
 public:
  FrameReader(const Eigen::MatrixXd& table, std::size_t bones)
      : table_(table), bones_(bones), rows_each_(table.cols() == 3 ? 3 : 1) {
    if (table.cols() != 3 && table.cols() != 4 && table.cols() != 9)
      throw Error(ExitCode::BadInput,
                  fmt::format("{} columns; rotations have 4 (x y z w), 9 or 3 (matrices)", table.cols()));
    if (table.rows() == 0 || table.rows() % static_cast<Eigen::Index>(bones * rows_each_) != 0)
      throw Error(ExitCode::BadInput, fmt::format("{} rows are no whole frames of {} bones{}", table.rows(),
                                                  bones, rows_each_ == 3 ? " with 3 rows each" : ""));
  }

  RotationFrames read() {
    const std::size_t count = static_cast<std::size_t>(table_.rows()) / (bones_ * rows_each_);
    for (std::size_t f = 0; f < count; ++f) {
      result_.frames.emplace_back();
      for (std::size_t k = 0; k < bones_; ++k)
        with_context(fmt::format("frame {} bone {}", f, k),
                     [&] { result_.frames[f].push_back(continuous(f, k, rotation(f * bones_ + k))); });
    }
    return std::move(result_);
  }

 private:
  Quat rotation(std::size_t index) {
    const auto row = static_cast<Eigen::Index>(index * rows_each_);
    if (table_.cols() == 4)
      return unit(quaternion_xyzw(table_(row, 0), table_(row, 1), table_(row, 2), table_(row, 3)));
    Mat3 m;
    for (Eigen::Index i = 0; i < 9; ++i)
      m(i / 3, i % 3) = table_.cols() == 9 ? table_(row, i) : table_(row + i / 3, i % 3);
    return nearest(m);
  }

  Quat unit(const Quat& q) {
    const double length = q.norm();
    if (length < kShortest) throw Error(ExitCode::BadInput, "a quaternion of length zero");
    if (std::abs(length - 1) > kNormalised) ++result_.normalised;
    return q.normalized();
  }

  Quat nearest(const Mat3& m) {
    const Mat3 rotation = nearest_rotation(m);
    const double off = (m - rotation).norm();
    if (off > kFarFromRotation) throw Error(ExitCode::BadInput, "a matrix that is no rotation");
    if (off > kNormalised) ++result_.normalised;
    return Quat(rotation);
  }

  Quat continuous(std::size_t frame, std::size_t bone, const Quat& q) {
    if (frame == 0 || q.dot(result_.frames[frame - 1][bone]) >= 0) return q;
    ++result_.flips;
    return Quat(-q.coeffs());
  }

  const Eigen::MatrixXd& table_;
  std::size_t bones_;
  std::size_t rows_each_;  ///< rows of the table for one rotation
  RotationFrames result_;
};

}  // namespace

RotationFrames rotation_frames(const Eigen::MatrixXd& table, std::size_t bones) {
  return FrameReader(table, bones).read();
}

}  // namespace skinforge
