#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/id.h"
#include "model/transform.h"

namespace skinforge {

/// Node of the skeleton.
struct Joint {
  std::string name;  ///< unique in its skeleton, never empty
  JointId parent;    ///< invalid for the root
  Transform bind;    ///< parent_from_joint in the bind pose; also the pose of a joint that no clip drives
  Affine3 joint_from_model =
      Affine3::Identity();  ///< inverse bind matrix, as the file has it (to the last bit
                            ///< where it had one), else the inverse of the bind pose's matrix

  template <class Archive>
  friend void fields(Archive& a, Joint& j) {
    a(j.name, j.parent, j.bind, j.joint_from_model);
  }
};

/// One tree of joints. Parents stand before their children, so one pass in order visits each parent first;
/// joint 0 is the one root. Chaining `bind` from the root gives the inverse of `joint_from_model` (to
/// rounding).
struct Skeleton {
  std::vector<Joint> joints;

  std::size_t size() const { return joints.size(); }
  const Joint& operator[](JointId id) const { return joints[id.index()]; }
  Joint& operator[](JointId id) { return joints[id.index()]; }

  /// The joint of that name; none if there is no such joint. Linear.
  std::optional<JointId> find(std::string_view name) const;
  /// All names in joint order.
  std::vector<std::string> names() const;
  /// Children of each joint, in joint order.
  std::vector<std::vector<JointId>> children() const;
  /// For each joint, whether it is `top` or below it.
  std::vector<bool> subtree(JointId top) const;
  /// model_from_joint of the bind pose, one per joint (inverse of `joint_from_model`).
  std::vector<Affine3> model_from_joint() const;

  template <class Archive>
  friend void fields(Archive& a, Skeleton& s) {
    a(s.joints);
  }
};

}  // namespace skinforge
