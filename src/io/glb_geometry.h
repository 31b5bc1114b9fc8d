#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/export.h"
#include "model/character.h"

namespace skinforge {

/// One glTF primitive before it is written: what one material covers of one mesh, vertices split where
/// corners differ.
struct GlbPrimitive {
  MaterialId material;
  std::vector<VertexId> vertex;         ///< per written vertex, the vertex of the character it shows
  std::vector<float> positions;         ///< 3 a vertex
  std::vector<float> normals;           ///< 3 a vertex, unit length
  std::vector<float> tangents;          ///< 4 a vertex, or empty
  std::vector<std::vector<float>> uvs;  ///< per set, 2 a vertex
  std::vector<float> colors;            ///< 4 a vertex, or empty
  std::vector<std::uint32_t> indices;   ///< triangles
  std::vector<FaceId> faces;            ///< per triangle, the face of the character it is part of

  std::size_t vertex_count() const { return vertex.size(); }
};

/// One glTF mesh, shown by one node.
struct GlbMesh {
  std::string name;
  PartId morph_part;  ///< the part whose morph targets it has; invalid = none
  std::vector<GlbPrimitive> primitives;
};

/// Splits the mesh of a character into glTF meshes: first all parts without morph targets as one mesh, then
/// one mesh for each part with morph targets (the targets of a glTF mesh belong to all its primitives). In
/// each, one primitive for each material, and within it for each set of attributes that its parts have (UV
/// sets, colours). Corners of a primitive become one vertex where vertex, normal, UVs and colour agree as
/// floats. A normal of length zero is replaced by that of the face. UV sets that a texture of the material
/// reads are always there (zero where the part has none). Tangents are there where the material has a normal
/// texture: per vertex, mean over its faces weighted by corner angle, orthogonal to the normal, mirrored UVs
/// split (glTF 2.0, section 3.7.2.1). Loose vertices are not written.
std::vector<GlbMesh> glb_meshes(const Character& character);

}  // namespace skinforge
