#include "io/fbx_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/error.h"
#include "base/limits.h"
#include "io/inflate.h"

namespace skinforge {
namespace {

constexpr int kMaxDepth = 64;
constexpr std::string_view kMagic{"Kaydara FBX Binary  \0\x1a\0", 23};
constexpr int kWideVersion = 7500;  // from here on offsets have 64 bits

[[noreturn]] void fail(const std::string& sentence) {
  throw Error(ExitCode::BadInput, "FBX: " + sentence);
}

template <class T>
std::vector<double> widened(std::span<const std::byte> bytes) {
  std::vector<double> result(bytes.size() / sizeof(T));
  for (std::size_t i = 0; i < result.size(); ++i) {
    T value;
    std::memcpy(&value, bytes.data() + i * sizeof(T), sizeof(T));
    result[i] = static_cast<double>(value);
  }
  return result;
}

std::size_t item_size(char type) {
  switch (type) {
    case 'd':
    case 'l':
      return 8;
    case 'f':
    case 'i':
      return 4;
    default:
      return 1;
  }
}

/// The binary form.
class BinaryParser {
 public:
  BinaryParser(std::span<const std::byte> bytes, int version) : bytes_(bytes), version_(version) {}

  FbxNode parse() {
    FbxNode root;
    at_ = kMagic.size() + 4;
    FbxNode node;
    while (at_ < bytes_.size() && read_node(node, 0)) root.children.push_back(std::move(node));
    return root;
  }

 private:
  std::span<const std::byte> take(std::size_t size) {
    if (size > bytes_.size() - at_) fail(fmt::format("the file ends within the item at byte {}", at_));
    at_ += size;
    return bytes_.subspan(at_ - size, size);
  }
  template <class T>
  T read() {
    T value;
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
    return value;
  }
  std::uint64_t read_offset() {
    return version_ >= kWideVersion ? read<std::uint64_t>() : read<std::uint32_t>();
  }
  std::string read_text(std::size_t size) {
    const auto text = take(size);
    return {reinterpret_cast<const char*>(text.data()), text.size()};
  }

  /// False at the empty record that ends a list.
  bool read_node(FbxNode& node, int depth) {
    if (depth > kMaxDepth) fail(fmt::format("more than {} levels", kMaxDepth));
    node = {};
    const std::size_t begin = at_;
    const std::uint64_t end = read_offset(), count = read_offset();
    read_offset();  // bytes of the values, which say so themselves
    node.name = read_text(read<std::uint8_t>());
    if (end == 0) return false;
    if (end <= begin || end > bytes_.size()) fail(fmt::format("the node at byte {} ends outside", begin));
    node.values.reserve(std::min<std::uint64_t>(count, end - begin));  // a value takes a byte or more
    for (std::uint64_t i = 0; i < count; ++i) node.values.push_back(read_value());
    FbxNode child;
    while (at_ < end && read_node(child, depth + 1)) node.children.push_back(std::move(child));
    if (at_ != end) fail(fmt::format("the node at byte {} is not as long as it says", begin));
    return true;
  }

  FbxValue read_value() {
    const char type = read<char>();
    switch (type) {
      case 'C':
      case 'B':
        return std::int64_t{read<std::uint8_t>()};
      case 'Y':
        return std::int64_t{read<std::int16_t>()};
      case 'I':
        return std::int64_t{read<std::int32_t>()};
      case 'L':
        return read<std::int64_t>();
      case 'F':
        return static_cast<double>(read<float>());
      case 'D':
        return read<double>();
      case 'S':
      case 'R':
        return read_text(read<std::uint32_t>());
      default:
        return read_array(type);
    }
  }

  FbxArray read_array(char type) {
    if (std::string_view("fdlib").find(type) == std::string_view::npos)
      fail(fmt::format("unknown value type at byte {}", at_ - 1));
    FbxArray array;
    array.type = type;
    array.count = read<std::uint32_t>();
    array.is_packed = read<std::uint32_t>() != 0;
    array.data = take(read<std::uint32_t>());
    return array;
  }

  std::span<const std::byte> bytes_;
  int version_;
  std::size_t at_ = 0;
};

/// The ASCII form: `Name: value, value { children }`, arrays as `*count { a: 1,2,3 }`, comments behind `;`.
class TextParser {
 public:
  explicit TextParser(std::string_view text) : text_(text) {}

  FbxNode parse() {
    FbxNode root;
    skip_blank();
    while (at_ < text_.size()) {
      root.children.push_back(read_node(0));
      skip_blank();
    }
    return root;
  }

 private:
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  void skip_blank(bool over_lines = true) {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == ';')
        at_ = std::min(text_.find('\n', at_), text_.size());
      else if (c == ' ' || c == '\t' || c == '\r' || (over_lines && c == '\n'))
        ++at_;
      else
        break;
    }
  }

  [[noreturn]] void fail_here(const char* what) const {
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
    fail(fmt::format("line {}: {}", line, what));
  }

  std::string read_name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(peek())) || peek() == '_' ||
                                  peek() == '-' || peek() == '|'))
      ++at_;
    std::string name(text_.substr(begin, at_ - begin));
    skip_blank(false);
    if (name.empty() || peek() != ':') fail_here("a name and a colon are missing");
    ++at_;
    return name;
  }

  FbxNode read_node(int depth) {
    if (depth > kMaxDepth) fail_here("too many levels");
    FbxNode node;
    node.name = read_name();
    skip_blank(false);
    while (at_ < text_.size() && peek() != '\n' && peek() != '{' && peek() != '}') {
      node.values.push_back(read_value());
      skip_blank(false);
      if (peek() != ',') break;
      ++at_;
      skip_blank();  // a list may go on in the next line
    }
    if (peek() == '{') read_children(node, depth);
    return node;
  }

  void read_children(FbxNode& node, int depth) {
    ++at_;
    skip_blank();
    while (peek() != '}') {
      if (at_ >= text_.size()) fail_here("the file ends before a closing brace");
      node.children.push_back(read_node(depth + 1));
      skip_blank();
    }
    ++at_;
  }

  FbxValue read_value() {
    if (peek() == '"') return read_string();
    if (peek() == '*') return read_array();
    const std::string_view word = read_word();
    if (word.empty()) fail_here("a value is missing");
    std::int64_t integer = 0;
    const auto whole = std::from_chars(word.data(), word.data() + word.size(), integer);
    if (whole.ec == std::errc() && whole.ptr == word.data() + word.size()) return integer;
    double number = 0;
    const auto part = std::from_chars(word.data(), word.data() + word.size(), number);
    if (part.ec == std::errc() && part.ptr == word.data() + word.size()) return number;
    return std::string(word);
  }

  std::string read_string() {
    const auto end = text_.find('"', at_ + 1);
    if (end == std::string_view::npos) fail_here("the file ends within a text");
    std::string text(text_.substr(at_ + 1, end - at_ - 1));
    at_ = end + 1;
    return text;
  }

  std::string_view read_word() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && std::string_view(" \t\r\n,;{}").find(peek()) == std::string_view::npos)
      ++at_;
    return text_.substr(begin, at_ - begin);
  }

  FbxArray read_array() {
    FbxArray array;
    array.type = 't';
    ++at_;
    read_word();  // the count, which the list itself shows
    skip_blank();
    if (peek() != '{') fail_here("an array without its braces");
    ++at_;
    skip_blank();
    array.is_integer_text = true;
    if (peek() != '}') {
      read_name();  // a:
      read_numbers(array);
    }
    if (peek() != '}') fail_here("an array without its closing brace");
    ++at_;
    return array;
  }

  void read_numbers(FbxArray& array) {
    for (;;) {
      skip_blank();
      if (peek() == '}') return;
      const std::string_view word = read_word();
      double number = 0;
      const auto read = std::from_chars(word.data(), word.data() + word.size(), number);
      if (read.ec != std::errc() && read.ec != std::errc::result_out_of_range)
        fail_here("a number is missing");
      if (word.find_first_of(".eEn") != std::string_view::npos) array.is_integer_text = false;
      array.text.push_back(number);
      skip_blank();
      if (peek() == ',') ++at_;
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

float float_of_bits(double integer) {
  constexpr double kLeast = std::numeric_limits<std::int32_t>::min();
  constexpr double kMost = std::numeric_limits<std::int32_t>::max();
  return std::bit_cast<float>(static_cast<std::int32_t>(std::clamp(integer, kLeast, kMost)));
}

int text_version(const FbxNode& root) {
  const FbxNode* header = root.child("FBXHeaderExtension");
  const FbxNode* version = header ? header->child("FBXVersion") : nullptr;
  return version ? static_cast<int>(version->integer(0)) : 0;
}

}  // namespace

const FbxNode* FbxNode::child(std::string_view wanted) const {
  const auto found =
      std::find_if(children.begin(), children.end(), [&](const FbxNode& c) { return c.name == wanted; });
  return found == children.end() ? nullptr : &*found;
}

std::int64_t FbxNode::integer(std::size_t i) const {
  if (i >= values.size()) return 0;
  if (const auto* value = std::get_if<std::int64_t>(&values[i])) return *value;
  const auto* value = std::get_if<double>(&values[i]);
  return value && std::abs(*value) < 9e18 ? static_cast<std::int64_t>(*value) : 0;
}

double FbxNode::number(std::size_t i) const {
  if (i >= values.size()) return 0;
  if (const auto* value = std::get_if<double>(&values[i])) return *value;
  return static_cast<double>(integer(i));
}

std::string FbxNode::text(std::size_t i) const {
  const auto* value = i < values.size() ? std::get_if<std::string>(&values[i]) : nullptr;
  return value ? *value : std::string();
}

FbxFile parse_fbx(const Bytes& bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (!text.starts_with(kMagic)) {
    FbxNode root = TextParser(text).parse();
    return {text_version(root), std::move(root)};
  }
  std::uint32_t number = 0;
  if (bytes.size() < kMagic.size() + sizeof number) fail("the file ends within its header");
  std::memcpy(&number, bytes.data() + kMagic.size(), sizeof number);
  const int version = static_cast<int>(std::min<std::uint32_t>(number, 1'000'000));
  return {version, BinaryParser(bytes, version).parse()};
}

std::vector<double> numbers(const FbxArray& array) {
  if (array.type == 't') return array.text;
  const std::size_t size = array.count * item_size(array.type);  // 32 bits times 8
  if (size > limits().inflate) fail(fmt::format("an array of {} bytes, {}", size, limit_hint("inflate")));
  std::vector<std::byte> unpacked;
  std::span<const std::byte> data = array.data;
  if (array.is_packed) {
    unpacked.resize(size);
    if (!inflate_exactly(array.data, unpacked)) fail("a packed array is damaged or not as long as it says");
    data = unpacked;
  }
  if (data.size() != size) fail("an array is not as long as it says");
  switch (array.type) {
    case 'd':
      return widened<double>(data);
    case 'l':
      return widened<std::int64_t>(data);
    case 'f':
      return widened<float>(data);
    case 'i':
      return widened<std::int32_t>(data);
    default:
      return widened<std::uint8_t>(data);
  }
}

std::vector<double> numbers_of(const FbxNode* node) {
  const auto* array = node && !node->values.empty() ? std::get_if<FbxArray>(&node->values[0]) : nullptr;
  return array ? numbers(*array) : std::vector<double>();
}

std::vector<float> floats_of(const FbxNode* node) {
  const std::vector<double> values = numbers_of(node);
  const bool are_bits = !values.empty() && std::get<FbxArray>(node->values[0]).is_integer_text;
  std::vector<float> floats;
  for (const double value : values)
    floats.push_back(are_bits ? float_of_bits(value) : static_cast<float>(value));
  return floats;
}

}  // namespace skinforge
