#include "field/source_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/expect.h"
#include "base/parallel.h"
#include "field/sampling_cells.h"

namespace skinforge {
namespace {

struct Sample {
  float distance = 0, presence = 0;
};

constexpr double kWindingError = 0.02;  // ours: 3e-3 measured
constexpr std::int32_t kBlock = 8;      // ours: points along an edge of what is asked by one task

using Point = std::array<std::int32_t, 3>;

// The side that a point is on, and by how much the winding number may change before that is no longer sure.
struct SureSide {
  bool is_inside = false;
  double spare = 0;

  // Of a way of s d from a point at distance d from the surface. A closed surface has one winding number
  // wherever one comes without crossing it. What holes let through changes it fastest in the middle of a
  // round one, at the rate 1 / 2d.
  static double change(double s) { return -std::log1p(-s) / 2; }
  double reach(double distance) const { return distance * -std::expm1(-2 * spare); }
};

// Whether as many triangles run along each edge in one direction as in the other.
bool is_closed(std::span<const std::array<std::int32_t, 3>> triangles) {
  std::vector<std::pair<std::array<std::int32_t, 2>, bool>> sides;  // lower vertex first, whether it runs up
  sides.reserve(3 * triangles.size());
  for (const auto& t : triangles)
    for (int c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax(t[c], t[(c + 1) % 3]);
      if (low != high) sides.push_back({{low, high}, low == t[c]});
    }
  std::sort(sides.begin(), sides.end());
  for (std::size_t i = 0; i < sides.size();) {
    const auto edge = sides[i].first;
    int up = 0;
    for (; i < sides.size() && sides[i].first == edge; ++i) up += sides[i].second ? 1 : -1;
    if (up != 0) return false;
  }
  return true;
}

// Values at the corners of all cubes, on the grown lattice, not cut at the band; others stay 0.
class Corners {
 public:
  Corners(const SamplingCells& cells, const TriangleBvh& bvh,
          std::span<const std::array<std::int32_t, 3>> triangles, std::span<const double> presence,
          float band)
      : cells_(cells),
        bvh_(bvh),
        triangles_(triangles),
        presence_(presence),
        is_closed_(is_closed(triangles)),
        band_(band),
        samples_(cells.lattice.count()) {}

  void ask() {
    std::vector<Point> blocks;
    const auto& size = cells_.lattice.size;
    for (std::int32_t k = 0; k < size[2]; k += kBlock)
      for (std::int32_t j = 0; j < size[1]; j += kBlock)
        for (std::int32_t i = 0; i < size[0]; i += kBlock) blocks.push_back({i, j, k});
    parallel_for(blocks.size(), [&](std::size_t b) { ask_block(blocks[b]); });
  }

  // Values of the points (first, j, k) and so on, cut at the band. Trilinear in the finest cube at a point;
  // at a corner what was asked.
  void read_row(const Point& first, std::span<float> distance, std::span<float> presence) const {
    std::vector<SamplingCells::Around> around(distance.size());
    cells_.look_around(first[0], first[1], first[2], around);
    Ends ends;
    for (std::size_t n = 0; n < around.size(); ++n) {
      const Point p = {first[0] + static_cast<std::int32_t>(n), first[1], first[2]};
      const Sample sample = around[n].size == 1 ? samples_[cells_.lattice.index(p[0], p[1], p[2])]
                                                : between(p, around[n].size, ends);
      distance[n] = std::clamp(sample.distance, -band_, band_);
      presence[n] = sample.presence;
    }
  }

 private:
  // A point that was asked for its distance, not for its side.
  struct Sideless {
    Point at;
    Sample* sample;
    std::optional<SureSide> side;
  };

  void ask_block(const Point& begin) {
    const auto& size = cells_.lattice.size;
    std::vector<Sideless> sideless;
    std::array<SamplingCells::Around, kBlock> around;
    const std::span row(around.data(), static_cast<std::size_t>(std::min(kBlock, size[0] - begin[0])));
    std::int32_t near = cells_.around(begin[0], begin[1], begin[2]).triangle;
    for (std::int32_t k = begin[2]; k < std::min(begin[2] + kBlock, size[2]); ++k)
      for (std::int32_t j = begin[1]; j < std::min(begin[1] + kBlock, size[1]); ++j) {
        cells_.look_around(begin[0], j, k, row);
        for (std::size_t r = 0; r < row.size(); ++r) {
          const Point p = {begin[0] + static_cast<std::int32_t>(r), j, k};
          if (((p[0] | j | k) & (row[r].size - 1)) != 0) continue;
          Sample& sample = samples_[cells_.lattice.index(p[0], j, k)];
          sample = ask(p, near);
          if (row[r].side == Side::Inside) sample.distance = -sample.distance;
          if (row[r].side == Side::Unknown) sideless.push_back({p, &sample, {}});
        }
      }
    tell_sides(sideless);
  }

  // Distance and presence; `triangle` is a near one, and then the nearest.
  Sample ask(const Point& p, std::int32_t& triangle) const {
    const ClosestPoint nearest = bvh_.closest_from_hint(cells_.lattice.point(p[0], p[1], p[2]), triangle);
    triangle = nearest.triangle;
    const auto& corners = triangles_[triangle];
    double presence = 0;
    for (int c = 0; c < 3; ++c) presence += nearest.barycentric[c] * presence_[corners[c]];
    return {static_cast<float>(nearest.distance / cells_.lattice.voxel), static_cast<float>(presence)};
  }

  // The farthest from the surface come first: they answer for most of those around them.
  void tell_sides(std::vector<Sideless>& points) const {
    std::stable_sort(points.begin(), points.end(), [](const Sideless& a, const Sideless& b) {
      return a.sample->distance > b.sample->distance;
    });
    std::vector<Sideless*> untold;
    for (Sideless& p : points) untold.push_back(&p);
    for (Sideless& p : points) {
      if (untold.empty()) break;
      if (!p.side) p.side = ask_side(p.at);
      const double distance = p.sample->distance, reach = p.side->reach(distance);
      std::erase_if(untold, [&](Sideless* other) {
        if (other->side) return true;
        const Point& a = p.at;
        const Point& b = other->at;
        const std::int32_t x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2], away2 = x * x + y * y + z * z;
        if (away2 >= reach * reach) return false;
        const double change = SureSide::change(std::sqrt(away2) / distance);
        other->side = SureSide{p.side->is_inside, p.side->spare - change};
        return true;
      });
    }
    for (const Sideless& p : points)
      if (p.side->is_inside) p.sample->distance = -p.sample->distance;
  }

  SureSide ask_side(const Point& p) const {
    const double winding = bvh_.winding_number(cells_.lattice.point(p[0], p[1], p[2]));
    const double spare = std::max(std::abs(winding - 0.5) - kWindingError, 0.0);
    return {winding > 0.5, is_closed_ ? std::numeric_limits<double>::infinity() : spare};
  }

  // Sums of whole multiples of samples, so that they do not depend on which way the axes run.
  struct Sum {
    double distance = 0, presence = 0;
  };
  // Of the cube that the last point of a row lay in, its two sides across the row.
  struct Ends {
    std::int32_t begin = 0, size = 0;
    Sum low, high;
  };

  Sample between(const Point& p, std::int32_t size, Ends& ends) const {
    const std::int32_t along = p[0] & (size - 1), begin = p[0] - along;
    if (ends.size != size || ends.begin != begin) {
      ends = {begin, size, sum_across({begin, p[1], p[2]}, size), {}};
      // The row may end with its low side.
      if (begin + size < cells_.lattice.size[0]) ends.high = sum_across({begin + size, p[1], p[2]}, size);
    }
    const double volume = static_cast<double>(size) * size * size;
    const auto mean = [&](double low, double high) {
      return static_cast<float>(((size - along) * low + along * high) / volume);
    };
    return {mean(ends.low.distance, ends.high.distance), mean(ends.low.presence, ends.high.presence)};
  }

  Sum sum_across(const Point& p, std::int32_t size) const {
    const std::int32_t y = p[1] & (size - 1), z = p[2] & (size - 1);
    Sum sum;
    const auto add = [&](std::int32_t weight, std::int32_t j, std::int32_t k) {
      if (weight == 0) return;
      const Sample& sample = samples_[cells_.lattice.index(p[0], j, k)];
      sum.distance += weight * static_cast<double>(sample.distance);
      sum.presence += weight * static_cast<double>(sample.presence);
    };
    add((size - y) * (size - z), p[1] - y, p[2] - z);
    add(y * (size - z), p[1] - y + size, p[2] - z);
    add((size - y) * z, p[1] - y, p[2] - z + size);
    add(y * z, p[1] - y + size, p[2] - z + size);
    return sum;
  }

  const SamplingCells& cells_;
  const TriangleBvh& bvh_;
  std::span<const std::array<std::int32_t, 3>> triangles_;
  std::span<const double> presence_;
  bool is_closed_;
  float band_;
  std::vector<Sample> samples_;
};

}  // namespace

SourceSamples sample_source(const Lattice& lattice, const TriangleBvh& bvh,
                            std::span<const std::array<std::int32_t, 3>> triangles,
                            std::span<const double> presence, double band, const SamplingReach& reach) {
  SF_EXPECT(band > 0);
  SourceSamples samples;
  samples.distance.assign(lattice.count(), static_cast<float>(band));
  samples.presence.assign(lattice.count(), 0);
  if (triangles.empty() || lattice.count() == 0) return samples;
  const SamplingCells cells = sampling_cells(lattice, bvh, reach);
  Corners corners(cells, bvh, triangles, presence, static_cast<float>(band));
  corners.ask();
  const auto row_length = static_cast<std::size_t>(lattice.size[0]), rows = lattice.count() / row_length;
  parallel_for(rows, [&](std::size_t row) {
    const auto j = static_cast<std::int32_t>(row) % lattice.size[1],
               k = static_cast<std::int32_t>(row) / lattice.size[1];
    corners.read_row({cells.first[0], j + cells.first[1], k + cells.first[2]},
                     std::span(samples.distance).subspan(row * row_length, row_length),
                     std::span(samples.presence).subspan(row * row_length, row_length));
  });
  return samples;
}

}  // namespace skinforge
