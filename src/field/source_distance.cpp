#include "field/source_distance.h"

#include <algorithm>
#include <cmath>

#include "base/expect.h"
#include "base/parallel.h"
#include "field/sampling_cells.h"

namespace skinforge {
namespace {

struct Sample {
  float distance = 0, presence = 0;
};

// Values at the corners of all cubes, on the grown lattice, not cut at the band; others stay 0.
class Corners {
 public:
  Corners(const SamplingCells& cells, const TriangleBvh& bvh,
          std::span<const std::array<std::int32_t, 3>> triangles, std::span<const double> presence,
          double band)
      : cells_(cells),
        bvh_(bvh),
        triangles_(triangles),
        presence_(presence),
        band_(band),
        samples_(cells.lattice.count()) {}

  void ask_row(std::int32_t j, std::int32_t k) {
    for (std::int32_t i = 0; i < cells_.lattice.size[0]; ++i) {
      const SamplingCells::Cell& cell = cells_.finest_around(i, j, k);
      if (((i | j | k) & (cell.size - 1)) == 0) samples_[cells_.lattice.index(i, j, k)] = ask(i, j, k, cell);
    }
  }

  // Trilinear in the finest cube at a point; at a corner what was asked. The weights are whole numbers, so
  // that the sums do not depend on which way the axes run.
  Sample at(std::int32_t i, std::int32_t j, std::int32_t k) const {
    const std::int32_t size = cells_.finest_around(i, j, k).size;
    const std::array<std::int32_t, 3> along = {i & (size - 1), j & (size - 1), k & (size - 1)};
    double distance = 0, presence = 0;
    for (int corner = 0; corner < 8; ++corner) {
      std::array<std::int32_t, 3> at = {i, j, k};
      std::int32_t weight = 1;
      for (int axis = 0; axis < 3; ++axis) {
        const bool is_high = corner >> axis & 1;
        weight *= is_high ? along[axis] : size - along[axis];
        at[axis] += (is_high ? size : 0) - along[axis];
      }
      if (weight == 0) continue;
      const Sample& sample = samples_[cells_.lattice.index(at[0], at[1], at[2])];
      distance += weight * static_cast<double>(sample.distance);
      presence += weight * static_cast<double>(sample.presence);
    }
    const double volume = static_cast<double>(size) * size * size;
    return {static_cast<float>(std::clamp(distance / volume, -band_, band_)),
            static_cast<float>(presence / volume)};
  }

 private:
  Sample ask(std::int32_t i, std::int32_t j, std::int32_t k, const SamplingCells::Cell& cell) const {
    const Vec3 point = cells_.lattice.point(i, j, k);
    const ClosestPoint nearest = bvh_.closest_from_hint(point, cell.triangle);
    const bool inside =
        cell.side == Side::Unknown ? bvh_.winding_number(point) > 0.5 : cell.side == Side::Inside;
    const double length = nearest.distance / cells_.lattice.voxel;
    const auto& corners = triangles_[nearest.triangle];
    double presence = 0;
    for (int c = 0; c < 3; ++c) presence += nearest.barycentric[c] * presence_[corners[c]];
    return {static_cast<float>(inside ? -length : length), static_cast<float>(presence)};
  }

  const SamplingCells& cells_;
  const TriangleBvh& bvh_;
  std::span<const std::array<std::int32_t, 3>> triangles_;
  std::span<const double> presence_;
  double band_;
  std::vector<Sample> samples_;
};

}  // namespace

SourceSamples sample_source(const Lattice& lattice, const TriangleBvh& bvh,
                            std::span<const std::array<std::int32_t, 3>> triangles,
                            std::span<const double> presence, double band) {
  SF_EXPECT(band > 0);
  SourceSamples samples;
  samples.distance.assign(lattice.count(), static_cast<float>(band));
  samples.presence.assign(lattice.count(), 0);
  if (triangles.empty() || lattice.count() == 0) return samples;
  const SamplingCells cells = sampling_cells(lattice, bvh);
  Corners corners(cells, bvh, triangles, presence, band);
  const auto& size = cells.lattice.size;
  const auto rows = static_cast<std::size_t>(size[1]) * size[2];
  parallel_for(rows, [&](std::size_t row) {
    corners.ask_row(static_cast<std::int32_t>(row % size[1]), static_cast<std::int32_t>(row / size[1]));
  });
  for (std::int32_t k = 0; k < lattice.size[2]; ++k)
    for (std::int32_t j = 0; j < lattice.size[1]; ++j)
      for (std::int32_t i = 0; i < lattice.size[0]; ++i) {
        const Sample sample = corners.at(i + cells.first[0], j + cells.first[1], k + cells.first[2]);
        const std::size_t at = lattice.index(i, j, k);
        samples.distance[at] = sample.distance;
        samples.presence[at] = sample.presence;
      }
  return samples;
}

}  // namespace skinforge
