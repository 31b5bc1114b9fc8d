#pragma once

#include <span>
#include <vector>

#include "base/archive.h"
#include "model/character.h"
#include "surface/junction.h"
#include "surface/preserved.h"

namespace skinforge {

/// What the faces of a junction may be.
enum class JunctionElements : std::uint8_t {
  Auto,      ///< quads, and triangles where no good quad can be made of them
  Quads,     ///< the same, but any two triangles that make a convex quad are one
  Triangles  ///< halves of quads as the junction was judged
};

/// Where a result vertex comes from. Preserved: the vertex of its source. New: the junction, by site.
struct ResultVertex {
  SourceId source;         ///< invalid for a new vertex
  VertexId vertex;         ///< in the source's mesh
  std::int32_t site = -1;  ///< the junction that uses this vertex; -1 away from junctions

  template <class Archive>
  friend void fields(Archive& a, ResultVertex& o) {
    a(o.source, o.vertex, o.site);
  }
};

/// Where a result face comes from.
struct ResultFace {
  SourceId source;         ///< invalid for a junction face
  FaceId face;             ///< in the source's mesh
  std::int32_t site = -1;  ///< the junction it belongs to, else -1

  template <class Archive>
  friend void fields(Archive& a, ResultFace& o) {
    a(o.source, o.face, o.site);
  }
};

/// M_R = M'_0 + M'_1 + M_J with its history.
struct JoinedSurface {
  PolygonMesh mesh;  ///< preserved faces with all their attributes; junction faces with normals only
  std::vector<ResultVertex> vertices;  ///< #V
  std::vector<ResultFace> faces;       ///< #F
  std::vector<PartId> first_part;      ///< per source: where its parts begin in `mesh.parts`
  std::vector<PartId> junction_part;   ///< per site; invalid where there is no junction

  template <class Archive>
  friend void fields(Archive& a, JoinedSurface& r) {
    a(r.mesh, r.vertices, r.faces, r.first_part, r.junction_part);
  }
};

/// Puts preserved faces and junctions together. Border vertices are shared by index, never merged by
/// position. Preserved corners keep their attributes; face materials are offset by `first_material` per
/// source. Junction triangles are paired to quads where a quad is well shaped; `shade_junction` gives their
/// normals. `elements`: per junction; empty for Auto.
JoinedSurface assemble_surface(std::span<const PreservedSource> sources, std::span<const Junction> junctions,
                               std::span<const JunctionElements> elements = {});

}  // namespace skinforge
