#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "base/math.h"

namespace skinforge {

/// A ball of a limb that turns about one joint, and a ball that may stand in its way, in one pose. Places in
/// the frame of the joint's parent, from the joint.
struct LimbPair {
  Vec3 ball, obstacle;
  double touching = 0;  ///< distance at which they cut
};

/// How deep a limb cuts once it is turned.
struct LimbCut {
  double squares = 0;  ///< sum over all pairs of their depth, squared
  double deepest = 0;
};
LimbCut cut_of(std::span<const LimbPair> pairs, const Quat& turn);

/// Whether a turn of at most `most` radians can bring the two together.
bool may_meet(const LimbPair& pair, double most);

/// The least turn found that brings the limb out, of at most `most` radians; Gauss-Newton (Levenberg) from
/// where it is, and where that leaves it cutting from a few turns to all sides, too.
Quat clearing_turn(std::span<const LimbPair> pairs, double most);

}  // namespace skinforge
