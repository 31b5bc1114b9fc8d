#include "io/plain_mesh.h"

#include "io/file_kind.h"
#include "io/line_reader.h"
#include "io/off_reader.h"

namespace skinforge {
namespace {

/// Vertices and faces of an OBJ; all other statements are of no interest here.
class ObjParser {
 public:
  explicit ObjParser(std::string_view text) : lines_(text, '#') {}

  RawScene::Primitive parse() {
    while (lines_.find_line()) {
      const std::string_view keyword = lines_.next_word();
      if (keyword == "v") read_vertex();
      if (keyword == "f") read_face();
    }
    return std::move(primitive_);
  }

 private:
  void read_vertex() {
    Vec3 position;
    for (double& coordinate : position) coordinate = lines_.read<double>("a coordinate");
    if (!position.allFinite()) lines_.fail("a coordinate is not finite");
    primitive_.positions.push_back(position);
  }

  /// Corners are v, v/vt, v//vn or v/vt/vn; negative numbers count back from the last vertex.
  void read_face() {
    const std::size_t before = primitive_.corners.size();
    while (lines_.has_more()) {
      const std::string_view word = lines_.next_word();
      const auto number = lines_.number<std::int64_t>(word.substr(0, word.find('/')), "a corner");
      const auto count = static_cast<std::int64_t>(primitive_.positions.size());
      const std::int64_t vertex = number < 0 ? count + number : number - 1;
      if (vertex < 0 || vertex >= count) lines_.fail(fmt::format("vertex {} of {}", number, count));
      primitive_.corners.push_back(static_cast<std::int32_t>(vertex));
    }
    if (primitive_.corners.size() - before < 3)
      lines_.fail(fmt::format("a face of {} corners", primitive_.corners.size() - before));
    primitive_.face_begin.push_back(static_cast<std::int32_t>(primitive_.corners.size()));
  }

  LineReader lines_;
  RawScene::Primitive primitive_;
};

PolygonMesh as_mesh(RawScene::Primitive primitive) {
  PolygonMesh mesh;
  mesh.positions = std::move(primitive.positions);
  for (const std::int32_t v : primitive.corners) mesh.corners.emplace_back(v);
  mesh.face_begin = std::move(primitive.face_begin);
  mesh.face_material.resize(mesh.face_count());
  mesh.face_part.assign(mesh.face_count(), PartId(0));
  mesh.normals.assign(mesh.corner_count(), Vec3::Zero());
  mesh.parts.resize(1);
  return mesh;
}

}  // namespace

PolygonMesh read_plain_mesh(const InputFile& file) {
  if (lower_extension(file.path) == ".off") return as_mesh(read_off(file).meshes.front().primitives.front());
  return with_context(printable(file.path), [&] {
    ObjParser parser({reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size()});
    return as_mesh(parser.parse());
  });
}

}  // namespace skinforge
