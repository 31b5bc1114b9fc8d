#pragma once

#include <span>
#include <vector>

#include "model/polygon_mesh.h"
#include "model/skeleton.h"
#include "model/skin_weights.h"
#include "surface/selection.h"

namespace skinforge {

/// Faces that are on the wrong side of a cut, because the joints that hold them are not in the sub-tree that
/// goes (or comes): a hoof that follows an IK control, eyes with an armature of their own.
struct LoosePart {
  std::size_t faces = 0;
  std::vector<JointId> joints;  ///< that hold it, the topmost, rising
  FaceId beside;                ///< a face on the other side of the cut, near it
};

/// Parts of `side` (faces of one side of a cut) that have lost the rest of their side.
/// `cut_at`: the joints at the top of the cut; they, those above them (a skirt of the hips stays with the
/// hips although the legs go) and those below them (which are named already) never count as holding a loose
/// part.
///  - An island of a component that the cut leaves in several: loose when it is not the largest, and most of
///  its weight lies on joints that have most of their weight in it.
///  - A whole component: loose when it is twice as near to the other side as to what is not loose on its own
///  (from the largest part on, component by component).
/// Sorted by their first face. Linear but for two BVHs and as many rounds as parts hang on each other.
std::vector<LoosePart> loose_parts(const PolygonMesh& mesh, const SkinWeights& weights,
                                   const Skeleton& skeleton, const FaceSet& side,
                                   std::span<const JointId> cut_at);

}  // namespace skinforge
