#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/math.h"

namespace skinforge {

/// Joints and bones as a .tgf file has them (ETH Sec. 1.1): a bone runs from its source joint (towards the
/// root) to its end joint. Bones stand in the order of the file, which everything indexed by bones follows:
/// handle labels, columns of weights, rows of poses.
struct BoneGraph {
  std::vector<Vec3> joints;                        ///< rest positions
  std::vector<std::array<std::int32_t, 2>> bones;  ///< source and end, indices into `joints`
};

}  // namespace skinforge
