#include "io/fbx_curve.h"

#include <gmock/gmock.h>

#include "base/error.h"

namespace skinforge {
namespace {

constexpr double kRounding = 1e-12;
constexpr double kWeight = 1e-4;  // weights are stored in steps of this

/// A curve through `values` at 0 s, 1 s, ... whose pieces have these flags and attributes.
FbxCurve curve(const std::string& values, const std::string& flags, const std::string& attributes,
               const std::string& repeats) {
  const std::string times = "0,46186158000,92372316000";
  const std::string text = "KeyTime: *3 { a: " + times + " }\nKeyValueFloat: *3 { a: " + values +
                           " }\nKeyAttrFlags: *1 { a: " + flags +
                           " }\nKeyAttrDataFloat: *4 { a: " + attributes +
                           " }\nKeyAttrRefCount: *1 { a: " + repeats + " }\n";
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  const Bytes bytes(begin, begin + text.size());
  return FbxCurve(parse_fbx(bytes).root);
}

TEST(FbxCurve, LinearPiecesAndConstantEnds) {
  const FbxCurve c = curve("2,4,4", "4", "0,0,0,0", "3");
  EXPECT_THAT(c.times(), ::testing::ElementsAre(0, 1, 2));
  EXPECT_EQ(c.at(-1), 2);
  EXPECT_NEAR(c.at(0.25), 2.5, kRounding);
  EXPECT_EQ(c.at(1), 4);
  EXPECT_EQ(c.at(9), 4);
  EXPECT_FALSE(c.is_constant());
}

TEST(FbxCurve, ConstantPiecesJumpAtTheirEnd) {
  const FbxCurve c = curve("2,4,6", "2", "0,0,0,0", "3");
  EXPECT_EQ(c.at(0.99), 2);
  EXPECT_EQ(c.at(1, true), 2);
  EXPECT_EQ(c.at(1), 4);
  const FbxCurve next = curve("2,4,6", "258", "0,0,0,0", "3");  // 0x102: already the value of the next key
  EXPECT_EQ(next.at(0.01), 4);
}

// Flat at both ends: 3 x^2 - 2 x^3.
TEST(FbxCurve, CubicPiece) {
  const FbxCurve c = curve("0,1,1", "8", "0,0,0,0", "3");
  EXPECT_NEAR(c.at(0.25), 0.15625, kRounding);
  EXPECT_NEAR(c.at(0.5), 0.5, kRounding);
  EXPECT_NEAR(c.at(1.5), 1, kRounding);
}

// 1065353216 is 1.0f: slope 1 at both ends of a rise of 1 is the line.
TEST(FbxCurve, SlopesAreValuesASecond) {
  const FbxCurve c = curve("0,1,2", "8", "1065353216,1065353216,0,0", "3");
  EXPECT_NEAR(c.at(0.2), 0.2, kRounding);
  EXPECT_NEAR(c.at(1.7), 1.7, kRounding);
  EXPECT_FALSE(curve("1,1,1", "8", "1065353216,0,0,0", "3").is_constant());
  EXPECT_TRUE(curve("1,1,1", "8", "0,0,0,0", "3").is_constant());
}

// Flat ends, right weight 1 (9999 in the low half), left weight a third: at s = 1/2 of the Bezier curve the
// time is 3/8 * 1 + 3/8 * 2/3 + 1/8 = 3/4 and the value 1/2.
TEST(FbxCurve, WeightsBendTime) {
  const FbxCurve c = curve("0,1,1", "16777224", "0,0,9999,0", "3");  // 0x1000008
  EXPECT_NEAR(c.at(0.75), 0.5, kWeight);
}

TEST(FbxCurve, PiecesWithoutAttributesAreLinear) {
  EXPECT_NEAR(curve("0,1,2", "8", "0,0,0,0", "3").at(0.25), 0.15625, kRounding);
  const std::string text = "KeyTime: *2 { a: 0,46186158000 }\nKeyValueFloat: *2 { a: 0,1 }\n";
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  const Bytes bytes(begin, begin + text.size());
  EXPECT_NEAR(FbxCurve(parse_fbx(bytes).root).at(0.25), 0.25, kRounding);
}

TEST(FbxCurve, RefusesListsThatDoNotMatch) {
  EXPECT_THROW(curve("0,1", "8", "0,0,0,0", "3"), Error);
  EXPECT_THROW(curve("0,1,2", "8", "0,0,0", "3"), Error);
  EXPECT_THROW(curve("0,1,2", "8", "0,0,0,0", "1,2"), Error);
}

TEST(FbxCurve, NoKeys) {
  const FbxCurve c{FbxNode()};
  EXPECT_TRUE(c.times().empty());
  EXPECT_TRUE(c.is_constant());
  EXPECT_EQ(c.at(1), 0);
}

}  // namespace
}  // namespace skinforge
