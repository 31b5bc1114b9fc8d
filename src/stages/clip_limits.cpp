#include "stages/clip_limits.h"

#include <fmt/format.h>

#include "animation/completion.h"
#include "base/limits.h"

namespace skinforge {

void expect_clips_in_limits(const Character& character) {
  double frames = 0, seconds = 0;
  for (const Clip& clip : character.clips) {
    seconds += clip.duration;
    frames += clip.duration * kSearchRate + 1;
  }
  // A pose, its global rotations, and those seen from the result, of each joint.
  constexpr std::size_t kPerJoint = sizeof(Transform) + sizeof(Quat) + 4 * sizeof(float);
  const double bytes = frames * static_cast<double>(character.skeleton.size()) * kPerJoint;
  const auto refuse = [&](const char* limit) {
    throw Error(ExitCode::BadInput, fmt::format("clips of {:.6g} s are {:.6g} frames of {:.3g} bytes, {}",
                                                seconds, frames, bytes, limit_hint(limit)));
  };
  if (frames > static_cast<double>(limits().frames)) refuse("frames");
  if (bytes > static_cast<double>(limits().memory)) refuse("memory");
}

}  // namespace skinforge
