// FBX files small enough to write out here, in both forms.
#include "io/fbx_document.h"

#include <gmock/gmock.h>

#include "base/error.h"

namespace skinforge {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Bytes bytes_of(const std::string& text) {
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return {begin, begin + text.size()};
}

template <class T>
std::string raw(const T& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

/// A node of a binary file that is to begin at byte `at`. `Offset`: 32 bits before version 7500.
template <class Offset>
std::string binary_node(std::size_t at, const std::string& name, Offset count, const std::string& values,
                        const std::string& children = "") {
  const std::size_t head = 3 * sizeof(Offset) + 1 + name.size();
  const auto end = static_cast<Offset>(at + head + values.size() + children.size());
  return raw(end) + raw(count) + raw(static_cast<Offset>(values.size())) + static_cast<char>(name.size()) +
         name + values + children;
}

const std::string kHead("Kaydara FBX Binary  \0\x1a\0", 23);

template <class Offset>
std::string binary_file(std::uint32_t version) {
  const std::string empty(3 * sizeof(Offset) + 1, '\0');
  const std::string values =
      "Y" + raw(std::int16_t{-2}) + "D" + raw(0.5) + "S" + raw(std::uint32_t{3}) + std::string("a\0b", 3);
  const std::size_t inner = kHead.size() + 4 + 3 * sizeof(Offset) + 1 + 5 + values.size();
  const std::string list =
      "d" + raw(std::uint32_t{2}) + raw(std::uint32_t{0}) + raw(std::uint32_t{16}) + raw(1.5) + raw(-3.0);
  const std::string child = binary_node<Offset>(inner, "List", 1, list) + empty;
  return kHead + raw(version) + binary_node<Offset>(kHead.size() + 4, "Outer", 3, values, child) + empty;
}

void expect_outer_and_list(const FbxNode& root) {
  const FbxNode* outer = root.child("Outer");
  ASSERT_TRUE(outer);
  EXPECT_EQ(outer->integer(0), -2);
  EXPECT_EQ(outer->number(1), 0.5);
  EXPECT_EQ(outer->text(2), std::string("a\0b", 3));
  EXPECT_EQ(outer->integer(7), 0);
  EXPECT_EQ(outer->text(0), "");
  EXPECT_THAT(numbers_of(outer->child("List")), ElementsAre(1.5, -3.0));
  EXPECT_TRUE(numbers_of(outer->child("Nothing")).empty());
}

TEST(FbxDocument, BinaryFormWithNarrowAndWideOffsets) {
  const Bytes narrow = bytes_of(binary_file<std::uint32_t>(7400));
  const Bytes wide = bytes_of(binary_file<std::uint64_t>(7500));
  const FbxFile older = parse_fbx(narrow), newer = parse_fbx(wide);
  EXPECT_EQ(older.version, 7400);
  EXPECT_EQ(newer.version, 7500);
  expect_outer_and_list(older.root);
  expect_outer_and_list(newer.root);
}

TEST(FbxDocument, TextForm) {
  const Bytes bytes = bytes_of(
      "; comment\n"
      "FBXHeaderExtension:  {\n  FBXVersion: 7300\n}\n"
      "Outer: -2, 0.5,\n  \"name: {x}\" {\n"
      "  List: *3 {\n    a: 1.5,\n-3,2e2\n  }\n"
      "  Bits: *2 { a: 1065353216,0 }\n"
      "  Empty: *0 {\n  }\n"
      "  Flag: T\n"
      "}\n");
  const FbxFile file = parse_fbx(bytes);
  EXPECT_EQ(file.version, 7300);
  const FbxNode* outer = file.root.child("Outer");
  ASSERT_TRUE(outer);
  EXPECT_EQ(outer->integer(0), -2);
  EXPECT_EQ(outer->number(1), 0.5);
  EXPECT_EQ(outer->text(2), "name: {x}");
  EXPECT_THAT(numbers_of(outer->child("List")), ElementsAre(1.5, -3.0, 200.0));
  EXPECT_THAT(floats_of(outer->child("Bits")), ElementsAre(1.0f, 0.0f));  // 0x3f800000
  EXPECT_THAT(floats_of(outer->child("List")), ElementsAre(1.5f, -3.0f, 200.0f));
  EXPECT_TRUE(numbers_of(outer->child("Empty")).empty());
  EXPECT_EQ(outer->child("Flag")->text(0), "T");
}

// zlib.compress(struct.pack("<3i", 7, -1, 9)) of Python.
TEST(FbxDocument, PackedArray) {
  const Bytes packed =
      bytes_of(std::string("\x78\x9c\x63\x67\x60\x60\xf8\x0f\x04\x9c\x40\x1a\x00\x1a\x6a\x04\x0d", 17));
  FbxArray array;
  array.type = 'i';
  array.count = 3;
  array.is_packed = true;
  array.data = packed;
  EXPECT_THAT(numbers(array), ElementsAre(7, -1, 9));
  array.count = 4;
  EXPECT_THROW(numbers(array), Error);
}

std::string refusal(const std::string& text) {
  try {
    parse_fbx(bytes_of(text));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::BadInput);
    return error.what();
  }
  return "nothing was refused";
}

TEST(FbxDocument, RefusesWhatIsCutOff) {
  const std::string whole = binary_file<std::uint32_t>(7400);
  for (std::size_t size = kHead.size(); size + 13 < whole.size(); ++size) {
    if (size == kHead.size() + 4) continue;  // a head alone is an empty tree
    EXPECT_THAT(refusal(whole.substr(0, size)), ::testing::StartsWith("FBX: ")) << size;
  }
}

TEST(FbxDocument, RefusesBrokenText) {
  EXPECT_EQ(refusal("A: 1\nB 2\n"), "FBX: line 2: a name and a colon are missing");
  EXPECT_EQ(refusal("A: {\n  B: 1\n"), "FBX: line 3: the file ends before a closing brace");
  EXPECT_EQ(refusal("A: \"open\n"), "FBX: line 1: the file ends within a text");
  EXPECT_EQ(refusal("A: *2 {\n a: 1,x\n}\n"), "FBX: line 2: a number is missing");
  std::string deep;
  for (int i = 0; i < 1000; ++i) deep += "A: {\n";
  EXPECT_THAT(refusal(deep), HasSubstr("too many levels"));
}

TEST(FbxDocument, RefusesArraysOfWrongLength) {
  FbxArray array;
  array.count = 2;
  const Bytes nine(9);
  array.data = nine;
  EXPECT_THROW(numbers(array), Error);
}

}  // namespace
}  // namespace skinforge
