#include "io/glb_stamp.h"

#include <gtest/gtest.h>

#include "io/export.h"
#include "testing/toy_character.h"

namespace skinforge {
namespace {

Bytes toy_glb(const std::string& extras) {
  return write_glb(testing::ToyCharacter::make(), {.extras_json = extras});
}

// Where a chunk's head is edited, it is no GLB any more.
bool holds(const Bytes& glb) {
  try {
    return check_stamp(glb) == StampState::Right;
  } catch (const Error&) {
    return false;
  }
}

TEST(GlbStamp, HoldsUntilAnythingChanges) {
  const Bytes glb = stamped(toy_glb("{\"content_sha256\":\"" + unset_stamp() + "\"}"));
  EXPECT_EQ(check_stamp(glb), StampState::Right);
  EXPECT_EQ(stamped(glb), glb);
  for (std::size_t i = 40; i < glb.size(); i += 97) {
    Bytes edited = glb;
    edited[i] ^= std::byte{1};
    EXPECT_FALSE(holds(edited)) << i;
  }
}

TEST(GlbStamp, MayBeAbsent) {
  EXPECT_EQ(check_stamp(toy_glb("")), StampState::Absent);
  EXPECT_EQ(check_stamp(toy_glb("{\"content_sha256\":\"short\"}")), StampState::Absent);
  EXPECT_THROW(stamped(toy_glb("")), Error);
  EXPECT_THROW(check_stamp(Bytes(100)), Error);
}

}  // namespace
}  // namespace skinforge
