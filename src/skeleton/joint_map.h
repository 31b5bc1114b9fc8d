#pragma once

#include <span>
#include <vector>

#include "skeleton/graft.h"

namespace skinforge {

/// Image of one source joint in the result, with the confidence of Sec. 5 in [0, 1].
struct MappedJoint {
  JointId image;
  double confidence = 0;

  template <class Archive>
  friend void fields(Archive& a, MappedJoint& m) {
    a(m.image, m.confidence);
  }
};

/// B_k of SkinMixer Sec. 5: one entry per joint of the source's input, each with a valid image.
using JointMap = std::vector<MappedJoint>;

/// B_k for each source of the graft (by SourceId), from the input skeletons into `graft.skeleton`.
/// `skeletons`: one per input. See joint_similarity.h for the score and where we leave the paper.
std::vector<JointMap> build_joint_maps(std::span<const Skeleton* const> skeletons, const Graft& graft);

}  // namespace skinforge
