#pragma once

#include "skeleton/skeleton_shape.h"

namespace skinforge {

/// One open step of a joint map: `joint` has no image yet, its neighbour `mapped` has.
struct MapStep {
  JointId joint;   ///< b_i, in the source
  JointId mapped;  ///< b'_i, in the source, adjacent to `joint`
  JointId image;   ///< b'_j = B(b'_i), in the result
};

/// How alike two joints are by the four criteria of SkinMixer Sec. 5.1, each in [0, 1], 1 = alike.
struct JointSimilarity {
  double geometric = 0;    ///< a) direction from the neighbour, and from the root
  double topological = 0;  ///< b) edges between candidate and image
  double parametric = 0;   ///< c) place between root (0) and leaf (1)
  double valence = 0;      ///< d) number of connections
  double score() const;    ///< weighted sum, in [0, 1]; the injectivity bonus is added by the caller
};

/// Compares `step.joint` of the source with `candidate` of the result (SkinMixer Sec. 5.1).
/// Space: bind positions in model space. Unchanged by translation and uniform scale of either skeleton, not
/// by rotation: both shapes are placed first (Sec. 4.1). Each skeleton is one tree. Constant time. Throws
/// nothing. Where the paper leaves a choice:
///  - c) is printed as the distance |P - P|; we take 1 - |P - P|, so equal places score 1;
///  - a) products of directions lie in [-1, 1]; negative ones count as 0;
///  - a) is 0/0 at a root, or if candidate == image; an undefined term is left out of the mean; none at all
///    scores 0.
JointSimilarity joint_similarity(const SkeletonShape& source, const SkeletonShape& result,
                                 const MapStep& step, JointId candidate);

}  // namespace skinforge
