#pragma once

#include <vector>

#include "model/character.h"

namespace skinforge {

/// Which joints and vertices of one character stand for which of another.
struct Correspondence {
  std::vector<JointId> joints;     ///< per joint of A: that of B; invalid when there is none
  std::vector<VertexId> vertices;  ///< per vertex of A: that of B; invalid when none is near
  /// Per vertex of B: that of A, found in the same way; where several lie at one place not the inverse.
  std::vector<VertexId> back = {};

  /// Joints of B that no joint of A stands for, rising.
  std::vector<JointId> joints_only_in(const Character& b) const;
};

/// Two vertices further apart than this share of A's bounding box diagonal are not the same one. Ours: 16
/// times the step of 14-bit positions, a fortieth of the shortest edges of the characters tried.
constexpr double kSameVertex = 1e-3;

/// Joints by name; those whose names the other file lost, by bind position below the same parent. Vertices by
/// bind position; of several at one place the one with the nearest weights. O(n log n) where vertices spread.
Correspondence correspond(const Character& a, const Character& b);

/// Sum of |w_a - w_b| over joints, in [0, 2]; `b_of_a`: per joint of A. Joints without a counterpart count
/// whole.
double weight_distance(std::span<const Influence> a, std::span<const Influence> b,
                       std::span<const JointId> b_of_a);

}  // namespace skinforge
