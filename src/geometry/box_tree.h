#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/math.h"

namespace skinforge {

/// Axis-aligned box; the default holds nothing.
using Box3 = Eigen::AlignedBox3d;

/// A tree of boxes, four children a node, so that one pass of vector arithmetic tests all four.
struct BoxTree {
  static constexpr int kWidth = 4;
  /// Enough for a depth-first walk that keeps the children still to visit on a stack: at most 57 levels.
  static constexpr int kStackSize = 192;
  using Lanes = Eigen::Array<double, kWidth, 1>;

  /// `count` > 0: a leaf with the items order[first .. first + count); 0: the node `first`; `first` -1: no
  /// child.
  struct Child {
    std::int32_t first = -1;
    std::int32_t count = 0;
    bool is_none() const { return first < 0; }
    bool is_leaf() const { return count > 0; }
  };
  struct Node {
    std::array<Lanes, 3> low, high;  ///< by axis; an absent child has low = +inf, high = -inf
    std::array<Child, kWidth> children;
    std::int32_t begin = 0, end = 0;  ///< all items below: order[begin .. end)
  };

  std::vector<Node> nodes;          ///< root first, parents before their children; empty without items
  std::vector<std::int32_t> order;  ///< item numbers, leaf after leaf

  /// Squared distance from `p` to each child's box, 0 inside; huge for absent children.
  static Lanes distances2(const Node& node, const Vec3& p) {
    Lanes sum = Lanes::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      const Lanes outside = (node.low[axis] - p[axis]).max(p[axis] - node.high[axis]).max(0.0);
      sum += outside * outside;
    }
    return sum;
  }
};

/// Calls `visit(item, place in tree.order)` for all items of the leaves whose boxes overlap `wanted`, in no
/// order that means anything. The boxes of the items themselves are for the visitor to look at.
template <class Visit>
void visit_near(const BoxTree& tree, const Box3& wanted, Visit visit) {
  std::array<std::int32_t, BoxTree::kStackSize> open;
  std::size_t size = 0;
  if (!tree.nodes.empty()) open[size++] = 0;
  while (size > 0) {
    const BoxTree::Node& node = tree.nodes[static_cast<std::size_t>(open[--size])];
    for (int lane = 0; lane < BoxTree::kWidth; ++lane) {
      const BoxTree::Child child = node.children[lane];
      bool meets = !child.is_none();
      for (int axis = 0; axis < 3; ++axis)
        meets = meets && node.low[axis][lane] <= wanted.max()[axis] &&
                node.high[axis][lane] >= wanted.min()[axis];
      if (!meets) continue;
      if (!child.is_leaf()) open[size++] = child.first;
      for (std::int32_t i = child.first; i < child.first + child.count; ++i)
        visit(tree.order[static_cast<std::size_t>(i)], i);
    }
  }
}

/// Builds the tree over boxes by the binned surface area heuristic along the longest axis of the centres
/// (Wald 2007), at most `leaf_size` items a leaf. Deterministic. O(n log n).
BoxTree build_box_tree(std::span<const Box3> boxes, int leaf_size);

}  // namespace skinforge
