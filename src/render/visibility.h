#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "render/view.h"

namespace skinforge {

/// Samples of one pixel: a rotated lattice, 16 different rows and 16 different columns.
inline constexpr int kSamples = 16;
/// Offset of a sample from its pixel's centre, in pixels.
constexpr std::array<float, 2> sample_offset(int sample) {
  return {(static_cast<float>(sample) + 0.5F) / kSamples - 0.5F,
          (static_cast<float>(sample * 5 % kSamples) + 0.5F) / kSamples - 0.5F};
}

/// Picture space of a view: homogeneous pixel coordinates (x * w, y * w, w), w = metres before the eye; x to
/// the right, y down, the first pixel's centre at (0.5, 0.5).
struct Projection {
  Projection(const View& view, int width, int height);

  Vec3 operator()(const Vec3& model) const { return pixel_from_model * (model - eye); }
  /// Direction in model space (not unit) of the ray through picture point (x, y).
  Vec3 ray(double x, double y) const { return model_from_pixel * Vec3(x, y, 1); }

  Vec3 eye;
  Mat3 pixel_from_model, model_from_pixel;
  int width, height;
  double near;  ///< metres
};

/// A triangle ready to be drawn (homogeneous rasterisation, Olano and Greer 1997): linear functions (a, b, c)
/// of the picture point (x, y, 1); no clipping is needed.
struct ScreenTriangle {
  std::array<Vec3, 3> edge;  ///< per corner: >= 0 inside; the weight of that corner over w, times |det|
  Vec3 inverse_w;            ///< 1 / w
  bool is_front;             ///< counter-clockwise as seen
  std::array<int, 4> box;    ///< first and last pixel: x0, y0, x1, y1

  /// Weights of the three corners at a picture point, summing to 1 (perspective-correct).
  Vec3 barycentric(double x, double y) const;
  /// Distance in pixels from a picture point to the line of the edge opposite `corner`.
  double edge_distance(int corner, double x, double y) const;
};

/// The triangle of three projected corners; none when it is degenerate, off the picture or behind the eye.
std::optional<ScreenTriangle> screen_triangle(const std::array<Vec3, 3>& corners,
                                              const Projection& projection);

/// Depth and owner of each sample of a block of pixels. Neighbouring triangles leave no gap and the nearest
/// one wins; of equally near ones, the first drawn.
class VisibilityTile {
 public:
  static constexpr int kEdge = 32;  ///< pixels; ours: 128 KB of samples, which stay in the second-level cache
  static constexpr std::int32_t kNone = -1;

  /// The block that starts at pixel (x0, y0), cleared.
  VisibilityTile(int x0, int y0, double near);

  /// Whether the surface exists at a picture point (cut-out materials); the last argument is the sample.
  using Cutout = std::function<bool(double x, double y, int sample)>;

  /// Draws under the name `owner`. `cutout`: empty = everywhere.
  void draw(const ScreenTriangle& triangle, std::int32_t owner, const Cutout& cutout = {});

  /// Owners of the samples of a pixel of the picture inside this block.
  const std::array<std::int32_t, kSamples>& owners(int x, int y) const { return owner_[pixel(x, y)]; }

 private:
  std::size_t pixel(int x, int y) const { return static_cast<std::size_t>((y - y0_) * kEdge + (x - x0_)); }
  void cut(const Cutout& cutout, int x, int y, std::array<std::int32_t, kSamples>& covered) const;

  int x0_, y0_;
  float nearest_;                                   ///< 1 / near
  std::vector<std::array<float, kSamples>> depth_;  ///< 1 / w, 0 = nothing
  std::vector<std::array<std::int32_t, kSamples>> owner_;
};

}  // namespace skinforge
