#include "geometry/box_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace skinforge {
namespace {

constexpr int kBins = 16;            // as Wald 2007
constexpr int kHeuristicDepth = 40;  // ours: real meshes need about 10; below it the halves are equal

struct Range {
  std::int32_t begin = 0, end = 0;
  Box3 box;
  std::int32_t size() const { return end - begin; }
};

double half_area(const Box3& box) {
  if (box.isEmpty()) return 0;
  const Vec3 s = box.sizes();
  return s.x() * s.y() + s.y() * s.z() + s.z() * s.x();
}

struct Bin {
  Box3 box;
  std::int32_t count = 0;
};

class Builder {
 public:
  Builder(std::span<const Box3> boxes, int leaf_size) : boxes_(boxes), leaf_size_(leaf_size) {
    tree_.order.resize(boxes.size());
    std::iota(tree_.order.begin(), tree_.order.end(), 0);
    centres_.reserve(boxes.size());
    for (const Box3& box : boxes) centres_.push_back(box.center());
  }

  BoxTree build() {
    if (!boxes_.empty()) add_node(range(0, static_cast<std::int32_t>(boxes_.size())), 0);
    return std::move(tree_);
  }

 private:
  std::size_t item(std::int32_t i) const { return static_cast<std::size_t>(tree_.order[i]); }

  Range range(std::int32_t begin, std::int32_t end) const {
    Range r{begin, end, {}};
    for (std::int32_t i = begin; i < end; ++i) r.box.extend(boxes_[item(i)]);
    return r;
  }

  std::int32_t add_node(const Range& all, int depth) {
    const auto id = static_cast<std::int32_t>(tree_.nodes.size());
    tree_.nodes.emplace_back();
    tree_.nodes.back().begin = all.begin;
    tree_.nodes.back().end = all.end;
    const std::vector<Range> parts = four_parts(all, depth);
    for (int lane = 0; lane < BoxTree::kWidth; ++lane) {
      const bool present = lane < static_cast<int>(parts.size());
      fill_lane(id, lane, present ? parts[lane] : Range{}, depth);
    }
    return id;
  }

  void fill_lane(std::int32_t id, int lane, const Range& part, int depth) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    BoxTree::Child child;
    if (part.size() > leaf_size_)
      child.first = add_node(part, depth + 1);
    else if (part.size() > 0)
      child = {part.begin, part.size()};
    BoxTree::Node& node = tree_.nodes[id];
    node.children[lane] = child;
    for (int axis = 0; axis < 3; ++axis) {
      node.low[axis][lane] = child.is_none() ? kInfinity : part.box.min()[axis];
      node.high[axis][lane] = child.is_none() ? -kInfinity : part.box.max()[axis];
    }
  }

  // Splits the part of largest area until there are four, or leaves only.
  std::vector<Range> four_parts(const Range& all, int depth) {
    std::vector<Range> parts{all};
    while (parts.size() < BoxTree::kWidth) {
      auto widest = parts.end();
      for (auto part = parts.begin(); part != parts.end(); ++part) {
        if (part->size() <= leaf_size_) continue;
        if (widest == parts.end() || half_area(part->box) > half_area(widest->box)) widest = part;
      }
      if (widest == parts.end()) break;
      const std::int32_t middle = split(*widest, depth);
      const Range right = range(middle, widest->end);
      *widest = range(widest->begin, middle);
      parts.insert(widest + 1, right);
    }
    return parts;
  }

  // Reorders the items of `part` into two non-empty halves and returns where the second begins.
  std::int32_t split(const Range& part, int depth) {
    Box3 spread;
    for (std::int32_t i = part.begin; i < part.end; ++i) spread.extend(centres_[item(i)]);
    int axis = 0;
    spread.sizes().maxCoeff(&axis);
    const double low = spread.min()[axis], width = spread.sizes()[axis];
    const std::int32_t middle_of_list = part.begin + part.size() / 2;
    if (!(width > 0) || depth > kHeuristicDepth) return middle_of_list;  // all centres coincide, or nearly
    const auto bin_of = [&](std::int32_t i) {
      const double place = (centres_[static_cast<std::size_t>(i)][axis] - low) / width;
      return std::clamp(static_cast<int>(place * kBins), 0, kBins - 1);
    };
    const int cut = best_cut(part, bin_of);
    const auto begin = tree_.order.begin();
    const auto middle = std::partition(begin + part.begin, begin + part.end,
                                       [&](std::int32_t i) { return bin_of(i) <= cut; });
    return static_cast<std::int32_t>(middle - begin);
  }

  // The bin after which to cut: least sum of area * count. The first and last bins are never empty.
  template <class BinOf>
  int best_cut(const Range& part, const BinOf& bin_of) const {
    std::array<Bin, kBins> bins;
    for (std::int32_t i = part.begin; i < part.end; ++i) {
      Bin& bin = bins[bin_of(tree_.order[i])];
      bin.box.extend(boxes_[item(i)]);
      ++bin.count;
    }
    std::array<double, kBins> cost_right{};
    Bin right;
    for (int b = kBins - 1; b > 0; --b) {
      right.box.extend(bins[b].box);
      right.count += bins[b].count;
      cost_right[b] = half_area(right.box) * right.count;
    }
    Bin left;
    int best = 0;
    double best_cost = std::numeric_limits<double>::infinity();
    for (int b = 0; b + 1 < kBins; ++b) {
      left.box.extend(bins[b].box);
      left.count += bins[b].count;
      const double cost = half_area(left.box) * left.count + cost_right[b + 1];
      if (cost >= best_cost) continue;
      best_cost = cost;
      best = b;
    }
    return best;
  }

  std::span<const Box3> boxes_;
  int leaf_size_;
  std::vector<Vec3> centres_;
  BoxTree tree_;
};

}  // namespace

BoxTree build_box_tree(std::span<const Box3> boxes, int leaf_size) {
  return Builder(boxes, leaf_size).build();
}

}  // namespace skinforge
