#pragma once

#include <optional>
#include <span>
#include <vector>

#include "animation/completion.h"

namespace skinforge {

/// The factor by which a transform scales lengths in the mean.
double scale_of(const Affine3& transform);

/// Two sources meet where the topmost joint of the one hangs on a joint of the other.
struct Meeting {
  JointOrigin above, below;
};
std::optional<Meeting> meeting_at(const Graft& graft, const GraftSite& site);

/// How places of an input come into the frame of the joint where two sources meet.
struct SeamFrame {
  JointId anchor;  ///< of the input: places are taken relative to it; invalid: to the model
  Affine3 from_anchor = Affine3::Identity();

  /// `joints`: model_from_joint of the input in some pose.
  Affine3 from_model(const std::vector<Affine3>& joints) const {
    return anchor.is_valid() ? Affine3(from_anchor * joints[anchor.index()].inverse()) : from_anchor;
  }
};
SeamFrame seam_frame(const Meeting& meeting, SourceId source, const Skeleton& skeleton);

/// Balls inside the skin: of each joint in `kept` those that lie along the vertices it moves most, as thick
/// as these lie round their axis.
std::vector<SkinBall> skin_balls(const Character& input, std::span<const JointId> kept);

/// The balls of a source at each site where it meets another source, in every frame of its set.
std::vector<SeamBalls> seam_balls(const Character& input, const Graft& graft, SourceId source,
                                  const MotionSet& set);

}  // namespace skinforge
