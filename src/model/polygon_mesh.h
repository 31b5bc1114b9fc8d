#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "base/id.h"
#include "base/math.h"

namespace skinforge {

/// A mesh object of the source file. Corner attributes that its file did not have are zero in the mesh; these
/// say so.
struct MeshPart {
  std::string name;
  int uv_sets = 0;
  bool has_normals = false;
  bool has_colors = false;

  template <class Archive>
  friend void fields(Archive& a, MeshPart& p) {
    a(p.name, p.uv_sets, p.has_normals, p.has_colors);
  }
};

/// A quad that was two triangles of a file, whose normals differed at the ends of its diagonal (flat
/// shading). Its corners hold their mean; this is what the file had, and what is written.
struct SplitNormals {
  FaceId face;
  std::array<Vec3, 2> first;   ///< of corners 0 and 2 in triangle (0, 1, 2)
  std::array<Vec3, 2> second;  ///< of corners 0 and 2 in triangle (0, 2, 3)

  template <class Archive>
  friend void fields(Archive& a, SplitNormals& s) {
    a(s.face, s.first, s.second);
  }
};

/// Polygons over shared positions. A corner is one vertex of one face; what may differ across a seam (normal,
/// UV, colour) sits on corners, so positions are welded. Faces have 3 or more corners, counter-clockwise from
/// outside.
struct PolygonMesh {
  std::vector<Vec3> positions;            ///< #V, metres, bind pose, model space
  std::vector<VertexId> corners;          ///< #C, the vertex of each corner, face after face
  std::vector<std::int32_t> face_begin;   ///< #F + 1 offsets into `corners`; {0} when there are no faces
  std::vector<MaterialId> face_material;  ///< #F, invalid = no material
  std::vector<PartId> face_part;          ///< #F
  std::vector<Vec3> normals;              ///< #C, unit length or zero
  std::vector<SplitNormals> split;        ///< of some quads, by rising face
  std::vector<std::vector<Vec2>> uvs;     ///< per UV set #C, glTF convention (v down)
  std::vector<Vec4> colors;               ///< #C or empty; linear RGBA
  std::vector<MeshPart> parts;

  std::size_t vertex_count() const { return positions.size(); }
  std::size_t face_count() const { return face_begin.empty() ? 0 : face_begin.size() - 1; }
  std::size_t corner_count() const { return corners.size(); }
  std::size_t first_corner(FaceId f) const { return static_cast<std::size_t>(face_begin[f.index()]); }
  std::span<const VertexId> face(FaceId f) const {
    const auto begin = first_corner(f);
    return {corners.data() + begin, static_cast<std::size_t>(face_begin[f.index() + 1]) - begin};
  }
  /// The split normals of a face; null for most.
  const SplitNormals* split_of(FaceId f) const;
  /// Diagonal of the bounding box of all positions; 0 for an empty mesh.
  double diagonal() const;

  template <class Archive>
  friend void fields(Archive& a, PolygonMesh& m) {
    a(m.positions, m.corners, m.face_begin, m.face_material, m.face_part, m.normals, m.split, m.uvs, m.colors,
      m.parts);
  }
};

/// Twice-area normal of a polygon by Newell's method (not normalised; zero for a degenerate face).
Vec3 area_normal(const PolygonMesh& mesh, FaceId face);

/// Corner offsets (0-based within the face) of the triangles of a polygon with `positions` as its corners. A
/// quad is split from its first corner, so that whoever makes a quad says how (the other diagonal is taken
/// only where that one folds and it does not); larger polygons by ear clipping in their mean plane.
std::vector<std::array<int, 3>> triangulate(std::span<const Vec3> positions);

/// Triangles of a mesh that remember their faces.
struct Triangulation {
  std::vector<std::array<VertexId, 3>> triangles;
  std::vector<std::array<std::int32_t, 3>>
      corners;               ///< index into PolygonMesh::corners of each triangle corner
  std::vector<FaceId> face;  ///< the polygon each triangle came from
};
Triangulation triangulate(const PolygonMesh& mesh);

}  // namespace skinforge
