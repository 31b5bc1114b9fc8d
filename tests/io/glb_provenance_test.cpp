#include "io/glb_provenance.h"

#include <gtest/gtest.h>

#include "io/export.h"
#include "testing/glb_file.h"
#include "testing/toy_character.h"

namespace skinforge {
namespace {

TEST(GlbProvenance, IsWhatWasWritten) {
  const Character toy = testing::ToyCharacter::make();
  EXPECT_EQ(provenance_text(write_glb(toy, {.extras_json = R"({"version":"1"})"})), R"({"version":"1"})");
  EXPECT_EQ(provenance_text(write_glb(toy)), "");
  EXPECT_EQ(provenance_text(
                testing::glb_bytes(R"({"nodes": [{"asset": 1}], "asset": {"extras": {"skinforge": 5}}})")),
            "");
  EXPECT_THROW(provenance_text(Bytes(100)), Error);
}

}  // namespace
}  // namespace skinforge
