#pragma once

#include <span>
#include <vector>

#include "base/issue.h"
#include "model/material.h"
#include "model/polygon_mesh.h"
#include "model/skin_weights.h"
#include "skinning/bone_segments.h"

namespace skinforge {

/// Handles H_k (ETH Sec. 4.1): for each vertex the joint that holds it with weight 1; invalid = free.
using Handles = std::vector<JointId>;

struct HandleRule {
  double factor =
      1.5;  ///< a vertex is a candidate up to this times the closest distance; >= 1 (ETH Sec. 4.1)
  std::size_t at_least =
      12;  ///< ours: vertices of each joint that the rule widens itself to take; 0 = the sheet's
};

/// The geometric rule: vertex v is a candidate of joint k where d_k(v) <= factor * min over v of d_k, with
/// d_k the distance to the nearest segment of k; claimed by several, it goes to the nearest (lowest joint on
/// ties). Ours: where fewer than `at_least` vertices come out for a joint, as where a bone touches or leaves
/// the surface and the closest distance is about zero, the joint takes the `at_least` nearest of those
/// vertices that are nearest to it of all joints. Cost: vertices times segments.
Handles handles_by_distance(std::span<const Vec3> positions, std::span<const BoneSegment> segments,
                            const HandleRule& rule = {});

/// From an existing skin: the joint of the largest weight, where that is above `threshold`.
Handles handles_of_weights(const SkinWeights& weights, double threshold = 0.6);

/// From face groups: a vertex all of whose faces are in parts named after one joint. Parts with other names
/// leave their vertices free. Throws Error (BadInput) with the names there are where no part is named so.
Handles handles_of_groups(const PolygonMesh& mesh, const Skeleton& skeleton);

/// A painted image: `color` says which joint the colour stands for.
struct LabelColor {
  std::array<std::uint8_t, 3> color{};  ///< 8-bit sRGB, as painted
  JointId joint;
};

/// Looked up at the UVs of each vertex (nearest pixel, set 0): a vertex all of whose corners show one label's
/// colour within `tolerance` a channel. Others are free. Throws Error (BadInput) where the mesh has no UVs.
Handles handles_of_image(const PolygonMesh& mesh, std::span<const LabelColor> labels, const Raster& image,
                         int tolerance = 8);

/// What came out for one joint.
struct HandleCount {
  JointId joint;
  std::size_t vertices = 0;
};
/// One entry a joint of `joint_count`, in order.
std::vector<HandleCount> count_handles(const Handles& handles, std::size_t joint_count);

/// Handles from a table of labels (one column): the number of a bone, or -1 for free. Throws Error (BadInput)
/// for another shape, for numbers that are not whole, and for labels without a bone, with the row.
Handles handles_of_labels(const Eigen::MatrixXd& table, std::size_t vertices,
                          std::span<const JointId> joint_of_bone);
/// The table again, by joint number.
Eigen::MatrixXd label_table(const Handles& handles);

}  // namespace skinforge
