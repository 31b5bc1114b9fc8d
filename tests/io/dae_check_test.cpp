#include "io/dae_check.h"

#include <gmock/gmock.h>

#include "base/error.h"

namespace skinforge {
namespace {

/// Two joints, three vertices; the last number pair is to be replaced.
const std::string kSkin =
    "<source id=\"names\" name=\"x\"><Name_array id=\"a\" count=\"2\">low high</Name_array></source>"
    "<vertex_weights count=\"2\"><input semantic=\"JOINT\" source=\"#names\" offset=\"0\"/>"
    "<input semantic=\"WEIGHT\" source=\"#w\" offset=\"1\"/><vcount>1 1 1</vcount>"
    "<v>0 7 1 8\n-1 9 </v></vertex_weights>";

std::vector<Issue> checked(const std::string& text) {
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  std::vector<Issue> issues;
  check_dae({"skin.dae", Bytes(begin, begin + text.size()), {}}, issues);
  return issues;
}

std::string refusal(std::string text, const std::string& from, const std::string& to) {
  try {
    checked(text.replace(text.find(from), from.size(), to));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::BadInput);
    return error.what();
  }
  return "nothing was refused";
}

TEST(DaeCheck, JointsThatAreNotThere) {
  EXPECT_TRUE(checked(kSkin).empty());
  EXPECT_EQ(refusal(kSkin, "1 8", "2 8"), "COLLADA: vertex_weights name joint 2, the skin has 2");
  EXPECT_EQ(refusal(kSkin, "-1 9", "-2 9"), "COLLADA: vertex_weights name joint -2, the skin has 2");
  EXPECT_EQ(refusal(kSkin, "1 8", "1 99"), "nothing was refused");  // a weight, not a joint
}

TEST(DaeCheck, WhatIsNotUnderstoodIsLeftAlone) {
  for (const char* part : {"<source id", "Name_array", "offset=\"0\"", "</v>", "#names", "0 7"})
    EXPECT_EQ(refusal(kSkin, part, "?"), "nothing was refused") << part;
}

TEST(DaeCheck, DocumentType) {
  const auto issues = checked("<?xml version=\"1.0\"?><!DOCTYPE x [<!ENTITY a \"b\">]>" + kSkin);
  ASSERT_EQ(issues.size(), 1u);
  EXPECT_EQ(issues[0].code, "doctype-ignored");
}

}  // namespace
}  // namespace skinforge
