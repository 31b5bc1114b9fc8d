#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <map>

#include "io/export.h"

namespace skinforge {
namespace {

/// A name as one word: OBJ ends a name at a blank and a line at a control character.
std::string word(const std::string& name) {
  std::string text = name.empty() ? "unnamed" : name;
  for (char& c : text)
    if (static_cast<unsigned char>(c) <= ' ' || c == 0x7F || c == '#') c = '_';
  return text;
}

/// Rows of numbers of which equal ones are written once, by the text they have in the file.
class Table {
 public:
  explicit Table(const char* keyword) : keyword_(keyword) {}

  /// 1-based index of a row, which is appended to `out` when it is new.
  template <class Vec>
  std::size_t index(const Vec& row, std::string& out) {
    std::string text;
    for (const double x : row) fmt::format_to(std::back_inserter(text), " {:.9g}", x);
    const auto [known, is_new] = index_.try_emplace(text, index_.size() + 1);
    if (is_new) out += keyword_ + text + '\n';
    return known->second;
  }

 private:
  std::string keyword_;
  std::map<std::string, std::size_t> index_;
};

class ObjWriter {
 public:
  explicit ObjWriter(const Character& character) : character_(character), mesh_(character.mesh) {}

  std::string write() {
    out_ = "# SkinForge\no " + word(character_.name) + '\n';
    write_vertices();
    std::string faces;
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) write_face(FaceId(f), faces);
    return out_ + faces;
  }

 private:
  /// Colour of each vertex: that of its first corner; white where its part has none.
  std::vector<Vec4> vertex_colors() const {
    std::vector<Vec4> colors(mesh_.colors.empty() ? 0 : mesh_.vertex_count(), Vec4::Ones());
    std::vector<bool> is_set(colors.size(), false);
    for (std::size_t f = 0; f < mesh_.face_count() && !colors.empty(); ++f) {
      if (!mesh_.parts[mesh_.face_part[f].index()].has_colors) continue;
      const std::size_t begin = mesh_.first_corner(FaceId(f));
      for (std::size_t c = begin; c < begin + mesh_.face(FaceId(f)).size(); ++c) {
        const std::size_t v = mesh_.corners[c].index();
        if (!is_set[v]) colors[v] = mesh_.colors[c];
        is_set[v] = true;
      }
    }
    return colors;
  }

  void write_vertices() {
    const std::vector<Vec4> colors = vertex_colors();
    for (std::size_t v = 0; v < mesh_.vertex_count(); ++v) {
      const Vec3& p = mesh_.positions[v];
      fmt::format_to(std::back_inserter(out_), "v {:.9g} {:.9g} {:.9g}", p.x(), p.y(), p.z());
      if (!colors.empty())
        fmt::format_to(std::back_inserter(out_), " {:.6g} {:.6g} {:.6g}", colors[v].x(), colors[v].y(),
                       colors[v].z());
      out_ += '\n';
    }
  }

  /// The tables grow in `out_`; the faces, which refer to them, are gathered apart.
  void write_face(FaceId face, std::string& faces) {
    write_group(face, faces);
    const MeshPart& part = mesh_.parts[mesh_.face_part[face.index()].index()];
    const auto vertices = mesh_.face(face);
    faces += 'f';
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const std::size_t corner = mesh_.first_corner(face) + i;
      fmt::format_to(std::back_inserter(faces), " {}", vertices[i].index() + 1);
      const bool has_normal = !mesh_.normals[corner].isZero(0);
      if (part.uv_sets > 0)
        fmt::format_to(std::back_inserter(faces), "/{}", uvs_.index(flipped(corner), out_));
      if (has_normal)
        fmt::format_to(std::back_inserter(faces), "{}{}", part.uv_sets > 0 ? "/" : "//",
                       normals_.index(mesh_.normals[corner], out_));
    }
    faces += '\n';
  }

  void write_group(FaceId face, std::string& faces) {
    const PartId part = mesh_.face_part[face.index()];
    if (part != part_) faces += "g " + word(mesh_.parts[part.index()].name) + '\n';
    part_ = part;
    const MaterialId material = mesh_.face_material[face.index()];
    if (material != material_)
      faces += "usemtl " +
               (material.is_valid() ? word(character_.materials[material.index()].name) : "none") + '\n';
    material_ = material;
  }

  /// OBJ counts v upwards.
  Vec2 flipped(std::size_t corner) const {
    const Vec2& uv = mesh_.uvs[0][corner];
    return {uv.x(), 1 - uv.y()};
  }

  const Character& character_;
  const PolygonMesh& mesh_;
  std::string out_;
  Table uvs_{"vt"};
  Table normals_{"vn"};
  PartId part_;
  MaterialId material_;
};

}  // namespace

std::string write_obj(const Character& character) {
  return ObjWriter(character).write();
}

}  // namespace skinforge
