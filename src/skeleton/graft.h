#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/archive.h"
#include "model/skeleton.h"

namespace skinforge {

enum class GraftKind : std::uint8_t { Replace, Attach, Remove, Detach };

/// One operation of Sec. 4 with its placement worked out. Operations run in order; each sees the skeleton
/// that the ones before it left.
struct GraftOperation {
  GraftKind kind = GraftKind::Replace;
  std::vector<std::string> at;  ///< joints of the character as it stands; one or more
  std::size_t input = 0;        ///< which input the sub-tree comes from (Replace, Attach)
  std::string joint;            ///< its top joint in that input
  Similarity model_from_input;  ///< placement of that input (Sec. 4.1)

  template <class Archive>
  friend void fields(Archive& a, GraftOperation& o) {
    a(o.kind, o.at, o.input, o.joint, o.model_from_input);
  }
};

/// Where a result joint comes from: parent_from_joint(result) = change * parent_from_joint(source), in the
/// bind pose and at any time of any clip. `change` is the identity for all joints but the topmost of each
/// grafted sub-tree, so all other keys carry over bit for bit.
struct JointOrigin {
  SourceId source;
  JointId joint;  ///< in the input of that source
  Similarity change;

  template <class Archive>
  friend void fields(Archive& a, JointOrigin& o) {
    a(o.source, o.joint, o.change);
  }
};

/// One placed use of an input. Source 0 is the base; each Replace or Attach adds one, so an input used twice
/// is two sources.
struct GraftSource {
  std::size_t input = 0;
  Similarity model_from_input;
  std::vector<JointId> result_joint;  ///< per joint of the input: its copy in the result, or invalid

  template <class Archive>
  friend void fields(Archive& a, GraftSource& s) {
    a(s.input, s.model_from_input, s.result_joint);
  }
};

/// What one operation did, for the surface (Sec. 6): which joints left which source.
struct GraftSite {
  GraftKind kind = GraftKind::Replace;
  SourceId host;   ///< the source that owned the first `at` joint
  SourceId donor;  ///< invalid for Remove and Detach
  JointId fused;   ///< result joint at the top of the grafted sub-tree; the new root for Detach; invalid for
                   ///< Remove
  std::vector<std::pair<SourceId, JointId>>
      removed;  ///< input joints that this operation took away from the result
  std::vector<std::pair<SourceId, JointId>> at;  ///< the `at` joints, as input joints
  std::vector<std::pair<SourceId, JointId>>
      parents;  ///< the parents of the `at` joints as the operation met them, as input joints; each once

  template <class Archive>
  friend void fields(Archive& a, GraftSite& s) {
    a(s.kind, s.host, s.donor, s.fused, s.removed, s.at, s.parents);
  }
};

/// S_R with its history.
struct Graft {
  Skeleton skeleton;
  std::vector<JointOrigin> origins;  ///< one per joint of `skeleton`
  std::vector<GraftSource> sources;  ///< by SourceId
  std::vector<GraftSite> sites;      ///< one per operation

  template <class Archive>
  friend void fields(Archive& a, Graft& g) {
    a(g.skeleton, g.origins, g.sources, g.sites);
  }
};

/// Carries out the operations on the skeletons (SkinMixer Sec. 4; names as the README says).
///  - Replace: the sub-trees at `at` go, the sub-tree at `joint` hangs under the parent of `at` (with several
///  `at`:
///    under the nearest common ancestor of their parents); at and joint become one joint that keeps `joint`'s
///    name.
///  - Attach: the sub-tree at `joint` becomes one more child of `at`.
///  - Remove: the sub-trees at `at` go. Detach: only the sub-tree at `at` stays; its top becomes the root.
/// A joint keeps its name; where it is taken, it becomes `<input>_<name>`, then `<input>_<name>_2`, ...
/// `skeletons` and `input_names`: one per input; `base`: index of the base input.
/// Throws Error (Usage) for an unknown joint (with the nearest names), for removing the root, for replacing
/// at the root, and for a Detach of several joints. Warns when a parent's scale is not uniform (the placement
/// is then the nearest similarity).
Graft graft_skeletons(std::span<const Skeleton* const> skeletons, std::span<const std::string> input_names,
                      std::size_t base, std::span<const GraftOperation> operations, class IssueSink& issues);

}  // namespace skinforge
