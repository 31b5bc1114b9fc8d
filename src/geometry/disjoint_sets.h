#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace skinforge {

/// The numbers 0 to n - 1 in sets that grow together; each set is called by one of its numbers.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

  std::int32_t root(std::int32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  bool is_root(std::int32_t i) const { return parent_[i] == i; }
  void unite(std::int32_t a, std::int32_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<std::int32_t> parent_;
};

}  // namespace skinforge
