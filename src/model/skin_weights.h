#pragma once

#include <span>
#include <vector>

#include "base/id.h"

namespace skinforge {

struct Influence {
  JointId joint;
  double weight = 0;

  auto operator<=>(const Influence&) const = default;
  template <class Archive>
  friend void fields(Archive& a, Influence& i) {
    a(i.joint, i.weight);
  }
};

/// Weighted links from vertices to joints, stored row after row. In a character that passed `validate`: each
/// row is sorted by falling weight (ties by joint), has positive weights only, each joint once, and sums to 1
/// (1e-12). A row may hold any number of influences; the writers cut to 4 or 8.
struct SkinWeights {
  std::vector<std::int32_t> row_begin = {0};  ///< #V + 1
  std::vector<Influence> influences;

  std::size_t vertex_count() const { return row_begin.size() - 1; }
  std::span<const Influence> of(VertexId v) const {
    const auto begin = static_cast<std::size_t>(row_begin[v.index()]);
    return {influences.data() + begin, static_cast<std::size_t>(row_begin[v.index() + 1]) - begin};
  }
  /// Appends the row of the next vertex as it is.
  void push_row(std::span<const Influence> row) {
    influences.insert(influences.end(), row.begin(), row.end());
    row_begin.push_back(static_cast<std::int32_t>(influences.size()));
  }

  template <class Archive>
  friend void fields(Archive& a, SkinWeights& w) {
    a(w.row_begin, w.influences);
  }
};

/// The row in normal form: equal joints summed, weights that are not positive dropped, at most `limit`
/// largest kept (0 = all; of weights within 1/4096 of the sum the lower joint), scaled to sum 1, sorted by
/// falling weight, ties by joint. Empty when nothing positive is left.
std::vector<Influence> normalised_row(std::vector<Influence> row, std::size_t limit = 0);

}  // namespace skinforge
