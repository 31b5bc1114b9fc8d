#include "stages/clip_limits.h"

#include <gmock/gmock.h>

#include "base/error.h"
#include "base/limits.h"

namespace skinforge {
namespace {

using ::testing::HasSubstr;

/// By hand: two clips of one second are 2 * (30 + 1) frames.
TEST(ClipLimits, FramesAreCountedBeforeTheyAreMade) {
  Character character;
  character.clips.resize(2);
  for (Clip& clip : character.clips) clip.duration = 1;
  Limits changed;
  changed.frames = 62;
  set_limits(changed);
  EXPECT_NO_THROW(expect_clips_in_limits(character));
  changed.frames = 61;
  set_limits(changed);
  try {
    expect_clips_in_limits(character);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("clips of 2 s are 62 frames"));
    EXPECT_THAT(error.what(), HasSubstr("the limit is 61; --limit frames=N raises it"));
  }
  set_limits({});
}

}  // namespace
}  // namespace skinforge
