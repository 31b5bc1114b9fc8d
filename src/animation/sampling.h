#pragma once

#include "model/clip.h"
#include "skeleton/pose.h"

namespace skinforge {

/// Value of a track at `time` (glTF 2.0 semantics: LINEAR lerp or shortest-arc slerp, STEP, CUBICSPLINE;
/// clamped at both ends). The track must not be empty.
Vec3 sample(const Vec3Track& track, double time);
Quat sample(const QuatTrack& track, double time);
std::vector<double> sample(const WeightsTrack& track, double time);

/// What tracks make of a joint at `time`; without a track a property is as in `bind`.
Transform sample(const JointTracks& tracks, double time, const Transform& bind);

/// Pose of the skeleton at `time` in seconds; what the clip does not drive stays in the bind pose.
Pose sample(const Skeleton& skeleton, const Clip& clip, double time);

}  // namespace skinforge
