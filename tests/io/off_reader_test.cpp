#include "io/off_reader.h"

#include <gmock/gmock.h>

#include "base/error.h"
#include "testing/assets.h"

namespace skinforge {
namespace {

InputFile file_of(const std::string& text) {
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return {"folder/flat.off", Bytes(begin, begin + text.size()), {}};
}

TEST(OffReader, PolygonsAndComments) {
  const RawScene scene = read_off(file_of(
      "OFF # a square and a triangle\r\n5 2 0\r\n0 0 0\r\n1 0 0\r\n1 1 0\r\n\r\n0 1 0\r\n.5 2e0 -1\r\n"
      "4 0 1 2 3\r\n3 3 2 4\r\n"));
  const RawScene::Primitive& p = scene.meshes.at(0).primitives.at(0);
  EXPECT_EQ(p.positions.at(4), Vec3(0.5, 2, -1));
  EXPECT_THAT(p.corners, ::testing::ElementsAre(0, 1, 2, 3, 3, 2, 4));
  EXPECT_THAT(p.face_begin, ::testing::ElementsAre(0, 4, 7));
  EXPECT_EQ(scene.nodes.at(0).name, "flat");
  EXPECT_TRUE(scene.issues.empty());
}

TEST(OffReader, ColoursAreLeftOutAloud) {
  const RawScene scene =
      read_off(file_of("COFF 3 1 0\n0 0 0 255 0 0\n1 0 0 255 0 0\n0 1 0 255 0 0\n3 0 1 2\n"));
  ASSERT_EQ(scene.issues.size(), 1u);
  EXPECT_EQ(scene.issues[0].code, "off-colours-left-out");
}

std::string refusal(const std::string& text) {
  try {
    read_off(file_of(text));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::BadInput);
    return error.what();
  }
  return "nothing was refused";
}

TEST(OffReader, RefusesWhatIsBroken) {
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n", at = "folder/flat.off: line ";
  EXPECT_EQ(refusal("solid\n"), at + "1: \"solid\" instead of OFF");
  EXPECT_EQ(refusal("OFF\n-3 1 0\n"), at + "2: the number of vertices is missing, found \"-3\"");
  EXPECT_EQ(refusal("OFF\n3 1 0\n" + points + "3 0 1 3\n"), at + "6: vertex 3 of 3");
  EXPECT_EQ(refusal("OFF\n3 1 0\n" + points + "3 0 1\n"), at + "6: a corner is missing, found \"\"");
  EXPECT_EQ(refusal("OFF\n3 1 0\n" + points + "2 0 1\n"), at + "6: a face of 2 corners");
  EXPECT_EQ(refusal("OFF\n4000000000 1 0\n" + points), at + "5: the file ends too early");
  EXPECT_EQ(refusal("OFF\n3 1 0\n0 0 nan\n"), at + "3: a coordinate is not finite");
}

// The second line of the file: 4780 vertices, 9556 faces.
TEST(OffReader, ReadsTheHandOfTheCourse) {
  SKINFORGE_NEEDS_SHARED();
  IssueSink issues;
  const Character hand = import_character(testing::shared_file("assignment6/hand/hand.off"), issues);
  EXPECT_EQ(hand.mesh.vertex_count(), 4780u);
  EXPECT_EQ(hand.mesh.face_count(), 9556u);
}

}  // namespace
}  // namespace skinforge
