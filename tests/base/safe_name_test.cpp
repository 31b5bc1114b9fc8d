#include "base/safe_name.h"

#include <gtest/gtest.h>

namespace skinforge {
namespace {

TEST(SafeName, AcceptsPlainNames) {
  for (const char* name : {"centaur", "d1_centaur.glb", "Walk 2", "a", "..a.b"})
    EXPECT_EQ(is_safe_file_name(name), name[0] != '.') << name;
  EXPECT_TRUE(is_safe_file_name(std::string(120, 'a')));
}

TEST(SafeName, RefusesEverythingElse) {
  for (const char* name : {"", ".", "..", ".hidden", "-rf", " a", "a ", "a.", "a/b", "a\\b", "a\nb", "a:b",
                           "a*", "\xc3\xa9", "con", "NUL.txt", "Com1", "lpt9.glb"})
    EXPECT_FALSE(is_safe_file_name(name)) << name;
  EXPECT_FALSE(is_safe_file_name(std::string(121, 'a')));
  EXPECT_FALSE(is_safe_file_name(std::string_view("a\0b", 3)));
}

TEST(SafeName, PathsStayInside) {
  EXPECT_TRUE(is_safe_relative_path("a"));
  EXPECT_TRUE(is_safe_relative_path("pictures/rest.png"));
  for (const char* path : {"", "/a", "a/", "a//b", "../a", "a/../b", "a/./b", "~/a"})
    EXPECT_EQ(is_safe_relative_path(path), false) << path;
}

TEST(SafeName, MakesNamesSafe) {
  EXPECT_EQ(safe_file_name("Walk"), "Walk");
  EXPECT_EQ(safe_file_name("Armature|Walk/2"), "Armature_Walk_2");
  EXPECT_EQ(safe_file_name("../../etc"), "_.._.._etc");
  EXPECT_EQ(safe_file_name(""), "_");
  EXPECT_EQ(safe_file_name("con"), "_con");
  EXPECT_EQ(safe_file_name("end. "), "end._");
  for (const std::string& odd :
       {std::string("."), std::string("-"), std::string(" "), std::string(300, '.'), std::string(1, '\0'),
        std::string("-") + std::string(118, 'a') + " b", std::string("\xff\xfe")})
    EXPECT_TRUE(is_safe_file_name(safe_file_name(odd))) << odd;
}

}  // namespace
}  // namespace skinforge
