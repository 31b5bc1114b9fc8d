#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace skinforge {

using Vec3f = Eigen::Vector3f;
using TriangleIndices = std::array<std::int32_t, 3>;

/// Triangles seen by a far light along one axis, from both ends: per texel the point nearest to the light at
/// `direction` and the one nearest to the light opposite. Two shadow maps for the price of one.
class DepthMap {
 public:
  /// Covers the ball (`center`, `radius` > 0) with `size` x `size` texels. `direction`: unit, towards the
  /// light. Linear in triangles and covered texels.
  DepthMap(std::span<const Vec3f> positions, std::span<const TriangleIndices> triangles,
           const Vec3f& direction, const Vec3f& center, float radius, int size);

  /// How much of the light at `direction` reaches `p`, in [0, 1], over 4 x 4 texels (a soft edge). Outside
  /// the map: 1.
  float light(const Vec3f& p) const { return filtered(p, nearest_, 1.0F); }
  /// The same for the light at the opposite end.
  float opposite_light(const Vec3f& p) const { return filtered(p, farthest_, -1.0F); }

  /// Edge of a texel in metres.
  float texel() const { return 1 / scale_; }
  const Vec3f& direction() const { return back_; }

 private:
  void draw(const Vec3f& a, const Vec3f& b, const Vec3f& c);
  /// Texel coordinates x, y and height, all in texels.
  Vec3f in_map(const Vec3f& p) const {
    const float x = scale_ * (p.x() - center_.x()), y = scale_ * (p.y() - center_.y());
    const float z = scale_ * (p.z() - center_.z()), half = 0.5F * static_cast<float>(size_);
    return {right_.x() * x + right_.y() * y + right_.z() * z + half,
            up_.x() * x + up_.y() * y + up_.z() * z + half, back_.x() * x + back_.y() * y + back_.z() * z};
  }
  float filtered(const Vec3f& p, const std::vector<float>& depth, float sign) const;

  int size_;
  Vec3f right_, up_, back_, center_;
  float scale_;                  ///< texels per metre
  std::vector<float> nearest_;   ///< greatest height along `direction`, in texels
  std::vector<float> farthest_;  ///< greatest height along -`direction`
};

}  // namespace skinforge
