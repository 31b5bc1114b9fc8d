#include "io/gltf_rules.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/limits.h"

namespace skinforge {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::vector<GltfFinding> findings(const std::string& members) {
  const std::string text = R"({"asset": {"version": "2.0"}, )" + members + "}";
  const auto bytes = std::as_bytes(std::span(text));
  return check_gltf({{"a.gltf", Bytes(bytes.begin(), bytes.end()), {}}});
}

std::vector<std::string> codes(const std::string& members) {
  std::vector<std::string> all;
  for (const GltfFinding& finding : findings(members)) all.push_back(finding.code);
  return all;
}

std::string skin(const std::string& nodes, const std::string& rest) {
  return R"("nodes": [)" + nodes + R"(], "skins": [{)" + rest + "}]";
}

// Node 0 above 1 and 2, node 3 above 4; by hand.
TEST(GltfRules, JointsHaveACommonRoot) {
  const std::string nodes = R"({"children": [1, 2]}, {}, {}, {"children": [4]}, {})";
  EXPECT_THAT(codes(skin(nodes, R"("joints": [1, 2])")), IsEmpty());
  EXPECT_THAT(codes(skin(nodes, R"("joints": [1, 2, 0], "skeleton": 0)")), IsEmpty());
  EXPECT_THAT(codes(skin(nodes, R"("joints": [1, 1], "skeleton": 1)")), IsEmpty());
  EXPECT_THAT(codes(skin(nodes, R"("joints": [1, 2], "skeleton": 1)")), ElementsAre("SKIN_SKELETON_INVALID"));
  EXPECT_THAT(codes(skin(nodes, R"("joints": [1, 4])")), ElementsAre("SKIN_NO_COMMON_ROOT"));
  EXPECT_THAT(codes(skin(nodes, R"("joints": [4, 3, 2])")), ElementsAre("SKIN_NO_COMMON_ROOT"));
}

// Every joint of a long chain, from its end: no way up is climbed twice.
TEST(GltfRules, AChainOfJointsTakesNoTime) {
  std::string nodes, joints;
  constexpr int kCount = 30'000;
  for (int i = 0; i < kCount; ++i) {
    nodes += i + 1 < kCount ? fmt::format(R"({{"children": [{}]}},)", i + 1) : "{}";
    joints += fmt::format("{}{}", kCount - 1 - i, i + 1 < kCount ? "," : "");
  }
  EXPECT_THAT(codes(skin(nodes, R"("skeleton": 0, "joints": [)" + joints + "]")), IsEmpty());
}

TEST(GltfRules, AttributesOfAnotherTypeAreToldAndNotRead) {
  const auto found = codes(R"("accessors": [{"type": "SCALAR", "componentType": 5126, "count": 4}],
    "meshes": [{"primitives": [{"attributes":
      {"POSITION": 0, "NORMAL": 0, "TANGENT": 0, "JOINTS_0": 0, "WEIGHTS_0": 0}}]}])");
  EXPECT_EQ(std::count(found.begin(), found.end(), "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT"), 3);
}

// Accessors without data take no bytes in the file and all the more in memory.
TEST(GltfRules, NumbersAreLimited) {
  const auto twice = [](std::size_t count) {
    const std::string accessor =
        fmt::format(R"({{"type": "MAT4", "componentType": 5126, "count": {}}})", count);
    return findings(R"("accessors": [)" + accessor + "," + accessor + "]");
  };
  Limits small;
  small.keys = 320;
  set_limits(small);
  EXPECT_THAT(twice(10), IsEmpty());
  const auto refused = twice(11);
  set_limits({});
  ASSERT_THAT(refused, SizeIs(1));
  EXPECT_EQ(refused[0].code, "GLTF_UNREADABLE");
  EXPECT_THAT(refused[0].message,
              HasSubstr("/accessors/1: 352 numbers up to here, the limit is 320; --limit keys=N raises it"));
}

}  // namespace
}  // namespace skinforge
