#include "stages/clip_limits.h"

#include <gmock/gmock.h>

#include "base/error.h"
#include "base/limits.h"

namespace skinforge {
namespace {

using ::testing::HasSubstr;

std::string complaint(const Character& character, const Limits& limits) {
  std::string message;
  set_limits(limits);
  try {
    expect_clips_in_limits(character);
  } catch (const Error& error) {
    message = error.what();
  }
  set_limits({});
  return message;
}

/// By hand: two clips of one second are 2 * (30 + 1) frames.
TEST(ClipLimits, FramesAreCountedBeforeTheyAreMade) {
  Character character;
  character.clips.resize(2);
  for (Clip& clip : character.clips) clip.duration = 1;
  Limits changed;
  changed.frames = 62;
  EXPECT_EQ(complaint(character, changed), "");
  changed.frames = 61;
  EXPECT_THAT(complaint(character, changed), HasSubstr("clips of 2 s are 62 frames"));
  EXPECT_THAT(complaint(character, changed), HasSubstr("the limit is 61; --limit frames=N raises it"));
}

/// By hand: a clip of two seconds is 61 frames of 3 joints, each a transform, a rotation and four floats.
TEST(ClipLimits, BytesAreCountedBeforeTheyAreTaken) {
  Character character;
  character.skeleton.joints.resize(3);
  character.clips.resize(1);
  character.clips[0].duration = 2;
  const std::uint64_t bytes = 61 * 3 * (sizeof(Transform) + sizeof(Quat) + 16);
  Limits changed;
  changed.memory = bytes;
  EXPECT_EQ(complaint(character, changed), "");
  changed.memory = bytes - 1;
  EXPECT_THAT(complaint(character, changed),
              HasSubstr("the limit is " + std::to_string(bytes - 1) + "; --limit memory=N raises it"));
}

}  // namespace
}  // namespace skinforge
