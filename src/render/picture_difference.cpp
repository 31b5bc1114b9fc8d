#include "render/picture_difference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "base/expect.h"
#include "render/canvas.h"
#include "render/color.h"

namespace skinforge {
namespace {

constexpr int kSameCode =
    8;  // ours: of 255; rounding moves codes by 1 or 2, the eye sees 4 beside each other

std::size_t pixel_count(const Raster& raster) {
  return static_cast<std::size_t>(raster.width) * static_cast<std::size_t>(raster.height);
}

const std::uint8_t* pixel(const Raster& raster, std::size_t i) {
  return raster.rgba.data() + 4 * i;
}

// Rec. 601, in [0, 255].
double luma_of(const std::uint8_t* p) {
  return 0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2];
}

int largest_difference(const std::uint8_t* a, const std::uint8_t* b) {
  int most = 0;
  for (int k = 0; k < 3; ++k) most = std::max(most, std::abs(a[k] - b[k]));
  return most;
}

// Whether `other` has the colour at a pixel or between its neighbours, in each channel.
bool has_near(const Raster& other, int x, int y, const std::uint8_t* color) {
  std::array<int, 3> low{255, 255, 255}, high{0, 0, 0};
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, other.height - 1); ++v)
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, other.width - 1); ++u) {
      const std::uint8_t* p = other.rgba.data() + 4 * (static_cast<std::ptrdiff_t>(v) * other.width + u);
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min<int>(low[k], p[k]);
        high[k] = std::max<int>(high[k], p[k]);
      }
    }
  for (std::size_t k = 0; k < 3; ++k)
    if (color[k] < low[k] - kSameCode || color[k] > high[k] + kSameCode) return false;
  return true;
}

bool is_changed(const Raster& a, const Raster& b, std::size_t i) {
  if (largest_difference(pixel(a, i), pixel(b, i)) <= kSameCode) return false;
  const int x = static_cast<int>(i) % a.width, y = static_cast<int>(i) / a.width;
  return !has_near(b, x, y, pixel(a, i)) || !has_near(a, x, y, pixel(b, i));
}

using Plane = std::vector<double>;

Plane luma(const Raster& raster) {
  Plane values(pixel_count(raster));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = luma_of(pixel(raster, i));
  return values;
}

Plane product(const Plane& a, const Plane& b) {
  Plane values(a.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = a[i] * b[i];
  return values;
}

// Means under the Gaussian window around each pixel; at the rim of the picture, under what of it lies inside.
class Window {
 public:
  Window(int width, int height) : width_(width), height_(height) {
    constexpr double kSigma = 1.5;  // Wang et al. 2004
    for (int i = 0; i <= kReach; ++i)
      weights_[static_cast<std::size_t>(i)] = std::exp(-i * i / (2 * kSigma * kSigma));
  }

  Plane means(const Plane& values) const {
    Plane rows(values.size()), all(values.size());
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) rows[at(x, y)] = mean(values, at(0, y), 1, x, width_);
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x)
        all[at(x, y)] = mean(rows, at(x, 0), static_cast<std::size_t>(width_), y, height_);
    return all;
  }

 private:
  static constexpr int kReach = 5;  // 11 x 11

  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  double mean(const Plane& values, std::size_t begin, std::size_t stride, int center, int size) const {
    double sum = 0, weight = 0;
    for (int i = std::max(center - kReach, 0); i <= std::min(center + kReach, size - 1); ++i) {
      const double w = weights_[static_cast<std::size_t>(std::abs(i - center))];
      sum += w * values[begin + stride * static_cast<std::size_t>(i)];
      weight += w;
    }
    return sum / weight;
  }

  int width_, height_;
  std::array<double, kReach + 1> weights_{};
};

// SSIM at every pixel (Wang et al. 2004, Eq. 13).
Plane similarities(const Raster& a, const Raster& b) {
  constexpr double kC1 = (0.01 * 255) * (0.01 * 255), kC2 = (0.03 * 255) * (0.03 * 255);
  const Window window(a.width, a.height);
  const Plane x = luma(a), y = luma(b);
  Plane mean_x = window.means(x), mean_y = window.means(y), xx = window.means(product(x, x)),
        yy = window.means(product(y, y)), xy = window.means(product(x, y));
  for (std::size_t i = 0; i < xy.size(); ++i) {
    const double mx = mean_x[i], my = mean_y[i];
    const double spread = xx[i] - mx * mx + yy[i] - my * my, common = xy[i] - mx * my;
    xy[i] = (2 * mx * my + kC1) * (2 * common + kC2) / ((mx * mx + my * my + kC1) * (spread + kC2));
  }
  return xy;
}

std::array<Vec3, 256> heat_codes() {
  std::array<Vec3, 256> codes;
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const Vec3 color = heat_color(static_cast<double>(i) / 255);
    for (int k = 0; k < 3; ++k) codes[i][k] = srgb_from_linear(static_cast<float>(color[k]));
  }
  return codes;
}

Raster heat_of(const Raster& a, const Raster& b) {
  constexpr double kPale = 120, kInk = 0.43;  // ours: a grey that no heat colour is lost on
  constexpr int kStrength = 4;                // ours: a quarter of the range is as dark as all of it
  const std::array<Vec3, 256> codes = heat_codes();
  Raster heat = a;
  for (std::size_t i = 0; i < pixel_count(a); ++i) {
    const std::uint8_t *p = pixel(a, i), *q = pixel(b, i);
    const int step = std::min(255, kStrength * largest_difference(p, q));
    const double grey = kPale + kInk * luma_of(p);
    const double share = std::min(1.0, step / 64.0);  // a quarter: from there on all heat
    const Vec3 color = (1 - share) * Vec3::Constant(grey) + share * codes[static_cast<std::size_t>(step)];
    for (int k = 0; k < 3; ++k)
      heat.rgba[4 * i + static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(std::lround(color[k]));
  }
  return heat;
}

Raster opaque(Raster raster) {
  for (std::size_t i = 3; i < raster.rgba.size(); i += 4) raster.rgba[i] = 255;
  return raster;
}

}  // namespace

PictureDifference picture_difference(const Raster& a, const Raster& b) {
  SF_EXPECT(a.width == b.width && a.height == b.height);
  PictureDifference difference;
  if (a.rgba == b.rgba) return difference;
  const Plane similarity = similarities(a, b);
  double counted = 0, changed = 0, error = 0, alike = 0, both = 0, either = 0;
  for (std::size_t i = 0; i < similarity.size(); ++i) {
    const std::uint8_t *p = pixel(a, i), *q = pixel(b, i);
    both += std::min(p[3], q[3]);
    either += std::max(p[3], q[3]);
    if (p[3] == 0 && q[3] == 0) continue;
    ++counted;
    changed += is_changed(a, b, i);
    alike += similarity[i];
    for (int k = 0; k < 3; ++k) error += std::abs(p[k] - q[k]) / (3 * 255.0);
  }
  if (counted > 0) difference = {changed / counted, error / counted, alike / counted, both / either};
  return difference;
}

Raster picture_of_difference(const Raster& a, const Raster& b, const std::string& title) {
  SF_EXPECT(a.width == b.width && a.height == b.height);
  const LabelOptions small{.scale = 1};
  constexpr int kMargin = 6;
  std::array<Raster, 3> shown = {opaque(a), opaque(b), opaque(heat_of(a, b))};
  label(shown[0], kMargin, kMargin, "A  " + title, small);
  label(shown[1], kMargin, kMargin, "B", small);
  label(shown[2], kMargin, kMargin, "difference", small);
  return tile(shown, {.gap = 2});
}

}  // namespace skinforge
