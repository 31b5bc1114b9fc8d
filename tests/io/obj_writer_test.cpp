#include <gmock/gmock.h>

#include <sstream>

#include "io/export.h"
#include "testing/toy_character.h"

namespace skinforge {
namespace {

using ::testing::HasSubstr;

std::vector<std::string> lines(const std::string& text, const std::string& keyword) {
  std::vector<std::string> list;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with(keyword + " ")) list.push_back(line);
  return list;
}

TEST(ObjWriter, WritesTheToyByHand) {
  const std::string obj = write_obj(testing::ToyCharacter::make());
  const auto v = lines(obj, "v"), vt = lines(obj, "vt"), vn = lines(obj, "vn"), f = lines(obj, "f");
  ASSERT_EQ(v.size(), 19u);
  EXPECT_EQ(v[1], "v 2 0 0 0 0.5 0.75");                 // colour of its first corner
  EXPECT_EQ(v[9], "v 3 0.309016994 0.951056516 1 1 1");  // cos, sin of 72 degrees; a part without colours
  EXPECT_THAT(vt, ::testing::ElementsAre("vt 0 0", "vt 1 0", "vt 1 1", "vt 0 1"));  // v up
  EXPECT_EQ(vn.size(), 6u);
  ASSERT_EQ(f.size(), 9u);
  EXPECT_EQ(f[0], "f 1/1/1 3/2/1 4/3/1 2/4/1");
  EXPECT_EQ(f[7], "f 14//6 15//6 16//6 17//6 18//6 19//6");  // no UVs, still a hexagon
  EXPECT_THAT(lines(obj, "usemtl"), ::testing::ElementsAre("usemtl plain", "usemtl textured", "usemtl none"));
  EXPECT_THAT(lines(obj, "g"), ::testing::ElementsAre("g body", "g face"));
}

TEST(ObjWriter, NamesAreOneWord) {
  Character toy = testing::ToyCharacter::make();
  toy.name = "a b\nf 1 1 1";
  toy.materials[0].name = "";
  const std::string obj = write_obj(toy);
  EXPECT_THAT(obj, HasSubstr("o a_b_f_1_1_1\n"));
  EXPECT_THAT(obj, HasSubstr("usemtl unnamed\n"));
}

TEST(ObjWriter, LeavesOutWhatIsNotThere) {
  Character toy = testing::ToyCharacter::make();
  toy.mesh.colors.clear();
  for (Vec3& normal : toy.mesh.normals) normal.setZero();
  const std::string obj = write_obj(toy);
  EXPECT_TRUE(lines(obj, "vn").empty());
  EXPECT_EQ(lines(obj, "v")[0], "v 0 0 0");
  EXPECT_EQ(lines(obj, "f")[0], "f 1/1 3/2 4/3 2/4");
}

}  // namespace
}  // namespace skinforge
