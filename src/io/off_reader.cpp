#include "io/off_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <string_view>

#include "base/error.h"
#include "base/text.h"
#include "io/line_reader.h"

namespace skinforge {
namespace {

constexpr std::size_t kMaxCorners = 4096;  // ours: of one face

class OffParser {
 public:
  explicit OffParser(std::string_view text) : lines_(text, '#') {}

  RawScene::Primitive parse() {
    read_head();
    RawScene::Primitive primitive;
    for (std::size_t v = 0; v < vertices_; ++v) primitive.positions.push_back(read_vertex());
    for (std::size_t f = 0; f < faces_; ++f) read_face(primitive);
    return primitive;
  }
  bool left_something_out() const { return left_out_; }

 private:
  /// The counts may stand behind the keyword or below it.
  void read_head() {
    lines_.next_line();
    const std::string_view keyword = lines_.next_word();
    if (keyword != "OFF" && keyword != "COFF")
      lines_.fail(fmt::format("\"{}\" instead of OFF", printable(keyword.substr(0, 40))));
    if (!lines_.has_more()) lines_.next_line();
    vertices_ = lines_.read<std::size_t>("the number of vertices");
    faces_ = lines_.read<std::size_t>("the number of faces");
  }

  Vec3 read_vertex() {
    lines_.next_line();
    Vec3 position;
    for (double& coordinate : position) coordinate = lines_.read<double>("a coordinate");
    if (!position.allFinite()) lines_.fail("a coordinate is not finite");
    note_rest();
    return position;
  }

  void read_face(RawScene::Primitive& primitive) {
    lines_.next_line();
    const auto size = lines_.read<std::size_t>("the number of corners");
    if (size < 3 || size > kMaxCorners) lines_.fail(fmt::format("a face of {} corners", size));
    for (std::size_t k = 0; k < size; ++k) {
      const auto vertex = lines_.read<std::size_t>("a corner");
      if (vertex >= vertices_) lines_.fail(fmt::format("vertex {} of {}", vertex, vertices_));
      primitive.corners.push_back(static_cast<std::int32_t>(vertex));
    }
    primitive.face_begin.push_back(static_cast<std::int32_t>(primitive.corners.size()));
    note_rest();
  }

  void note_rest() { left_out_ |= lines_.has_more(); }

  LineReader lines_;
  std::size_t vertices_ = 0, faces_ = 0;
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
