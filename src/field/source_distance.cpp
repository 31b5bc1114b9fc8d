#include "field/source_distance.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/expect.h"
#include "base/parallel.h"

namespace skinforge {
namespace {

constexpr int kBlock = 16;       // ours: enough blocks for a few threads on the smallest lattices in use
constexpr double kDoubt = 0.02;  // ours: error of the winding number (3e-3 measured) and of the bound below

// Lattice points [begin, end) along each axis.
struct Block {
  std::array<std::int32_t, 3> begin{}, end{};

  std::int32_t extent(int axis) const { return end[axis] - begin[axis]; }
  bool is_point() const { return extent(0) == 1 && extent(1) == 1 && extent(2) == 1; }
  Vec3 centre(const Lattice& lattice) const {
    const Vec3 sum(begin[0] + end[0] - 1, begin[1] + end[1] - 1, begin[2] + end[2] - 1);
    return lattice.origin + lattice.voxel / 2 * sum;
  }
  double radius(const Lattice& lattice) const {
    return lattice.voxel / 2 * Vec3(extent(0) - 1, extent(1) - 1, extent(2) - 1).norm();
  }
};

// What the block above knows.
struct Known {
  std::int32_t triangle = 0;   // near the block; any will do
  std::optional<bool> inside;  // of every point of the block
};

class Sampler {
 public:
  Sampler(const Lattice& lattice, const TriangleBvh& bvh,
          std::span<const std::array<std::int32_t, 3>> triangles, std::span<const double> presence,
          double band, SourceSamples& samples)
      : lattice_(lattice),
        bvh_(bvh),
        triangles_(triangles),
        presence_(presence),
        band_(band),
        samples_(samples) {}

  void sample(const Block& block, const Known& above) const {
    const Vec3 centre = block.centre(lattice_);
    const double radius = block.radius(lattice_);
    const ClosestPoint nearest = bvh_.closest_from_hint(centre, above.triangle);
    Known here{nearest.triangle, above.inside};
    if (!here.inside) here.inside = side(centre, nearest.distance, radius);
    if (block.is_point() || (here.inside && nearest.distance - radius >= band_))
      fill(block, *here.inside, nearest);
    else
      split(block, here);
  }

 private:
  // The side of all points within `radius` of the centre, if it is sure. Beside a straight rim at distance d
  // the winding number changes by at most log(1 / (1 - s)) / (2 pi) on a way of s d; that is taken as the
  // bound for every surface.
  std::optional<bool> side(const Vec3& centre, double distance, double radius) const {
    if (radius > distance) return std::nullopt;
    const double winding = bvh_.winding_number(centre);
    const double spare = std::abs(winding - 0.5) - kDoubt;
    if (radius > 0 && radius > distance * -std::expm1(-2 * std::numbers::pi * spare)) return std::nullopt;
    return winding > 0.5;
  }

  void fill(const Block& block, bool inside, const ClosestPoint& nearest) const {
    const double length = std::min(nearest.distance, band_);
    const auto distance = static_cast<float>(inside ? -length : length);
    const auto& corners = triangles_[nearest.triangle];
    double presence = 0;
    for (int i = 0; i < 3; ++i) presence += nearest.barycentric[i] * presence_[corners[i]];
    for (std::int32_t k = block.begin[2]; k < block.end[2]; ++k)
      for (std::int32_t j = block.begin[1]; j < block.end[1]; ++j) {
        const std::size_t row = lattice_.index(block.begin[0], j, k);
        std::fill_n(samples_.distance.begin() + row, block.extent(0), distance);
        std::fill_n(samples_.presence.begin() + row, block.extent(0), static_cast<float>(presence));
      }
  }

  void split(const Block& block, const Known& here) const {
    for (int octant = 0; octant < 8; ++octant) {
      Block part = block;
      bool is_empty = false;
      for (int axis = 0; axis < 3; ++axis) {
        const std::int32_t middle = block.begin[axis] + (block.extent(axis) + 1) / 2;
        (octant >> axis & 1 ? part.begin : part.end)[axis] = middle;
        is_empty |= part.extent(axis) == 0;
      }
      if (!is_empty) sample(part, here);
    }
  }

  const Lattice& lattice_;
  const TriangleBvh& bvh_;
  std::span<const std::array<std::int32_t, 3>> triangles_;
  std::span<const double> presence_;
  double band_;
  SourceSamples& samples_;
};

std::vector<Block> top_blocks(const Lattice& lattice) {
  std::vector<Block> blocks;
  const auto& size = lattice.size;
  for (std::int32_t k = 0; k < size[2]; k += kBlock)
    for (std::int32_t j = 0; j < size[1]; j += kBlock)
      for (std::int32_t i = 0; i < size[0]; i += kBlock)
        blocks.push_back(
            {{i, j, k},
             {std::min(i + kBlock, size[0]), std::min(j + kBlock, size[1]), std::min(k + kBlock, size[2])}});
  return blocks;
}

}  // namespace

SourceSamples sample_source(const Lattice& lattice, const TriangleBvh& bvh,
                            std::span<const std::array<std::int32_t, 3>> triangles,
                            std::span<const double> presence, double band) {
  SF_EXPECT(band > 0);
  SourceSamples samples;
  samples.distance.assign(lattice.count(), static_cast<float>(band));
  samples.presence.assign(lattice.count(), 0);
  if (triangles.empty()) return samples;
  const Sampler sampler(lattice, bvh, triangles, presence, band, samples);
  const std::vector<Block> blocks = top_blocks(lattice);
  parallel_for(blocks.size(), [&](std::size_t i) { sampler.sample(blocks[i], {}); });
  return samples;
}

}  // namespace skinforge
