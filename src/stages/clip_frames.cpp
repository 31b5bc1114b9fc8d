#include "stages/clip_frames.h"

#include "animation/morphing.h"
#include "animation/sampling.h"
#include "skinning/linear_blend.h"

namespace skinforge {

std::vector<ClipFrame> frames_at(const Character& character, const Clip& clip,
                                 const std::vector<double>& times) {
  std::vector<ClipFrame> frames;
  for (const double time : times) {
    const Pose pose = sample(character.skeleton, clip, time);
    frames.push_back({time,
                      linear_blend(morphed_positions(character, clip, time), character.weights,
                                   skinning_palette(character.skeleton, pose)),
                      {}});
  }
  return frames;
}

}  // namespace skinforge
