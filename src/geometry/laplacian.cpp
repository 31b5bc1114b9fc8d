#include "geometry/laplacian.h"

#include <algorithm>

#include "base/parallel.h"
#include "geometry/triangle_math.h"

namespace skinforge {
namespace {

constexpr std::size_t kChunk = 4096;               // ours: triangles a task
const double kEquilateral = 0.5 / std::sqrt(3.0);  // half the cotangent of 60 degrees

// The free block by columns; `local` as in laplacian_block.
class BlockBuilder {
 public:
  BlockBuilder(std::span<const std::int32_t> local, std::size_t rows)
      : local_(local), diagonal_(rows, 0.0), count_(rows + 1, 0) {}

  LowerColumns build(std::span<const VertexTriangle> triangles,
                     std::span<const std::array<double, 3>> half_cotangents) {
    for (const VertexTriangle& t : triangles)
      for_each_edge(t, [&](std::int32_t a, std::int32_t b, int) {
        if (a >= 0 && b >= 0) ++count_[static_cast<std::size_t>(std::min(a, b)) + 1];
      });
    for (std::size_t c = 1; c < count_.size(); ++c) count_[c] += count_[c - 1];
    entries_.resize(static_cast<std::size_t>(count_.back()));
    std::vector<std::int32_t> at(count_.begin(), count_.end() - 1);
    for (std::size_t f = 0; f < triangles.size(); ++f)
      for_each_edge(triangles[f], [&](std::int32_t a, std::int32_t b, int k) {
        const double weight = half_cotangents[f][static_cast<std::size_t>(k)];
        if (a >= 0) diagonal_[static_cast<std::size_t>(a)] += weight;
        if (b >= 0) diagonal_[static_cast<std::size_t>(b)] += weight;
        if (a >= 0 && b >= 0)
          entries_[static_cast<std::size_t>(at[static_cast<std::size_t>(std::min(a, b))]++)] = {
              std::max(a, b), -weight};
      });
    return compressed();
  }

 private:
  struct Entry {
    std::int32_t row = 0;
    double value = 0;
  };

  template <class Visit>
  void for_each_edge(const VertexTriangle& t, const Visit& visit) const {
    const std::array<std::int32_t, 3> at{local_[t[0].index()], local_[t[1].index()], local_[t[2].index()]};
    for (int k = 0; k < 3; ++k)
      visit(at[static_cast<std::size_t>((k + 1) % 3)], at[static_cast<std::size_t>((k + 2) % 3)], k);
  }

  LowerColumns compressed() {
    LowerColumns matrix;
    matrix.begin.reserve(count_.size());
    matrix.row.reserve(entries_.size() + diagonal_.size());
    matrix.value.reserve(entries_.size() + diagonal_.size());
    for (std::size_t c = 0; c < diagonal_.size(); ++c) {
      matrix.row.push_back(static_cast<std::int32_t>(c));
      matrix.value.push_back(diagonal_[c]);
      const auto first = entries_.begin() + count_[c], last = entries_.begin() + count_[c + 1];
      std::stable_sort(first, last, [](const Entry& a, const Entry& b) { return a.row < b.row; });
      for (auto e = first; e != last; ++e) {
        if (matrix.row.back() == e->row) {
          matrix.value.back() += e->value;
          continue;
        }
        matrix.row.push_back(e->row);
        matrix.value.push_back(e->value);
      }
      matrix.begin.push_back(static_cast<std::int32_t>(matrix.row.size()));
    }
    return matrix;
  }

  std::span<const std::int32_t> local_;
  std::vector<double> diagonal_;
  std::vector<std::int32_t> count_;  ///< offsets of columns in `entries_`, after counting
  std::vector<Entry> entries_;
};

}  // namespace

CotangentWeights cotangent_weights(std::span<const Vec3> positions,
                                   std::span<const VertexTriangle> triangles) {
  CotangentWeights weights;
  weights.half_cotangents.resize(triangles.size());
  std::vector<std::uint8_t> degenerate(triangles.size(), 0);
  parallel_chunks(triangles.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const TriangleCorners p{positions[triangles[f][0].index()], positions[triangles[f][1].index()],
                              positions[triangles[f][2].index()]};
      if (is_degenerate(p)) {
        weights.half_cotangents[f].fill(kEquilateral);
        degenerate[f] = 1;
        continue;
      }
      const Vec3 e0 = p[2] - p[1], e1 = p[0] - p[2], e2 = p[1] - p[0];
      const double half_over_area = 0.5 / e0.cross(e1).norm();  // of twice the area
      weights.half_cotangents[f] = {-e1.dot(e2) * half_over_area, -e2.dot(e0) * half_over_area,
                                    -e0.dot(e1) * half_over_area};
    }
  });
  weights.degenerate = static_cast<std::size_t>(std::count(degenerate.begin(), degenerate.end(), 1));
  return weights;
}

LowerColumns laplacian_block(std::span<const VertexTriangle> triangles,
                             std::span<const std::array<double, 3>> half_cotangents,
                             std::span<const std::int32_t> local, std::size_t rows) {
  return BlockBuilder(local, rows).build(triangles, half_cotangents);
}

}  // namespace skinforge
