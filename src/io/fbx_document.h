#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/archive.h"

namespace skinforge {

/// An array in an FBX file, unpacked on demand.
struct FbxArray {
  char type = 'd';        ///< f d l i b as in the binary form; 't' = text, already in `text`
  std::size_t count = 0;  ///< as the binary form says
  bool is_packed = false;
  std::span<const std::byte> data;  ///< into the bytes of the file
  std::vector<double> text;
  bool is_integer_text = false;  ///< the text has no point or exponent anywhere
};

/// One value behind a node's name. Text of the binary form keeps its "\0\1" between name and class.
using FbxValue = std::variant<std::int64_t, double, std::string, FbxArray>;

/// A node of an FBX file: a name, values, children.
struct FbxNode {
  std::string name;
  std::vector<FbxValue> values;
  std::vector<FbxNode> children;

  /// The first child of that name; null when there is none.
  const FbxNode* child(std::string_view wanted) const;
  std::int64_t integer(std::size_t i) const;  ///< 0 when value `i` is no number
  double number(std::size_t i) const;         ///< 0 when value `i` is no number
  std::string text(std::size_t i) const;      ///< empty when value `i` is no text
};

/// The tree of an FBX file and its version, 7400 for 7.4; 0 when it does not say.
struct FbxFile {
  int version = 0;
  FbxNode root;
};

/// Reads an FBX file, binary (7.0 and later) or ASCII. Arrays refer to `bytes`, which must outlive the
/// result. At most 64 levels. Throws Error (BadInput) where the file is not what it should be. Source: the
/// layout as described in "FBX binary file format specification" (Blender developers' blog, 2013).
FbxFile parse_fbx(const Bytes& bytes);

/// The numbers of an array. Throws Error (BadInput) when the data is damaged or not as long as it says, or
/// holds more than 100 million items.
std::vector<double> numbers(const FbxArray& array);

/// The numbers of the array that is the first value of a node; empty when there is no node or array.
std::vector<double> numbers_of(const FbxNode* node);

/// Like `numbers_of` for key attributes, which the ASCII form may write as integers of the floats' bits.
std::vector<float> floats_of(const FbxNode* node);

}  // namespace skinforge
