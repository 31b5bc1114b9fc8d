#include "io/off_reader.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <string_view>

#include "base/error.h"
#include "base/text.h"

namespace skinforge {
namespace {

constexpr std::size_t kMaxCorners = 4096;  // ours: of one face

class OffParser {
 public:
  explicit OffParser(std::string_view text) : text_(text) {}

  RawScene::Primitive parse() {
    read_head();
    RawScene::Primitive primitive;
    for (std::size_t v = 0; v < vertices_; ++v) primitive.positions.push_back(read_vertex());
    for (std::size_t f = 0; f < faces_; ++f) read_face(primitive);
    return primitive;
  }
  bool left_something_out() const { return left_out_; }

 private:
  [[noreturn]] void fail(const std::string& sentence) const {
    throw Error(ExitCode::BadInput, fmt::format("line {}: {}", line_number_, sentence));
  }

  /// The next line that holds something, without its comment.
  void next_line() {
    do {
      if (at_ >= text_.size()) fail("the file ends too early");
      const auto end = std::min(text_.find('\n', at_), text_.size());
      line_ = text_.substr(at_, end - at_);
      line_ = line_.substr(0, line_.find('#'));
      at_ = end + 1;
      ++line_number_;
    } while (line_.find_first_not_of(kBlank) == std::string_view::npos);
  }

  std::string_view next_word() {
    const auto begin = std::min(line_.find_first_not_of(kBlank), line_.size());
    const auto end = std::min(line_.find_first_of(kBlank, begin), line_.size());
    const std::string_view word = line_.substr(begin, end - begin);
    line_.remove_prefix(end);
    return word;
  }

  template <class Number>
  Number read(const char* what) {
    const std::string_view word = next_word();
    Number number{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (word.empty() || error != std::errc() || end != word.data() + word.size())
      fail(fmt::format("{} is missing, found \"{}\"", what, printable(word.substr(0, 40))));
    return number;
  }

  /// The counts may stand behind the keyword or below it.
  void read_head() {
    next_line();
    const std::string_view keyword = next_word();
    if (keyword != "OFF" && keyword != "COFF")
      fail(fmt::format("\"{}\" instead of OFF", printable(keyword.substr(0, 40))));
    if (line_.find_first_not_of(kBlank) == std::string_view::npos) next_line();
    vertices_ = read<std::size_t>("the number of vertices");
    faces_ = read<std::size_t>("the number of faces");
  }

  Vec3 read_vertex() {
    next_line();
    Vec3 position;
    for (double& coordinate : position) coordinate = read<double>("a coordinate");
    if (!position.allFinite()) fail("a coordinate is not finite");
    note_rest();
    return position;
  }

  void read_face(RawScene::Primitive& primitive) {
    next_line();
    const auto size = read<std::size_t>("the number of corners");
    if (size < 3 || size > kMaxCorners) fail(fmt::format("a face of {} corners", size));
    for (std::size_t k = 0; k < size; ++k) {
      const auto vertex = read<std::size_t>("a corner");
      if (vertex >= vertices_) fail(fmt::format("vertex {} of {}", vertex, vertices_));
      primitive.corners.push_back(static_cast<std::int32_t>(vertex));
    }
    primitive.face_begin.push_back(static_cast<std::int32_t>(primitive.corners.size()));
    note_rest();
  }

  void note_rest() { left_out_ |= line_.find_first_not_of(kBlank) != std::string_view::npos; }

  static constexpr std::string_view kBlank = " \t\r\f\v";
  std::string_view text_, line_;
  std::size_t at_ = 0, line_number_ = 0, vertices_ = 0, faces_ = 0;
  bool left_out_ = false;
};

}  // namespace

RawScene read_off(const InputFile& file) {
  return with_context(printable(file.path), [&] {
    OffParser parser({reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size()});
    RawScene scene;
    scene.triangles_only = false;
    RawScene::Mesh mesh;
    mesh.primitives.push_back(parser.parse());
    scene.meshes.push_back(std::move(mesh));
    RawScene::Node node;
    node.name = std::filesystem::path(file.path).stem().string();
    node.mesh = 0;
    scene.nodes.push_back(std::move(node));
    if (parser.left_something_out())
      scene.issues.push_back({"off-colours-left-out", Severity::Warning, "scene",
                              "what stands behind coordinates and corners is left out"});
    return scene;
  });
}

}  // namespace skinforge
