#pragma once

#include "io/fbx_scene.h"
#include "io/raw_scene.h"

namespace skinforge {

/// Gives back what Assimp leaves out of FBX animation: it takes the keys alone, so that a curve between two
/// far keys becomes a straight line or one slerp. Where keys are farther apart than a frame and a half and
/// that misses the motion by more than 1e-3 (of lengths, or radians), or where a moving node has pivots, its
/// tracks in the animation of the stack's name are replaced by cubic splines through the curve at its keys
/// and at each frame between. Stacks with several layers stay as they are, with an issue.
/// Throws Error (BadInput) for curves that are damaged or longer than a clip may be. Takes time with the keys
/// of the curves that clips hold and with the frames between them, at most as many as `Limits::keys` has room
/// for; however often connections say the same.
void restore_fbx_curves(const FbxScene& fbx, RawScene& scene);

}  // namespace skinforge
