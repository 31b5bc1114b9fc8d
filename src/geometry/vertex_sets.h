#pragma once

#include <algorithm>
#include <vector>

#include "base/id.h"

namespace skinforge {

/// Disjoint sets of vertices that grow together; each is called after its lowest vertex.
class VertexSets {
 public:
  explicit VertexSets(std::size_t count) : parent_(count) {
    for (std::size_t v = 0; v < count; ++v) parent_[v] = VertexId(v);
  }
  VertexId find(VertexId v) {
    while (parent_[v.index()] != v) v = parent_[v.index()] = parent_[parent_[v.index()].index()];
    return v;
  }
  void join(VertexId a, VertexId b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b).index()] = std::min(a, b);
  }

 private:
  std::vector<VertexId> parent_;
};

}  // namespace skinforge
