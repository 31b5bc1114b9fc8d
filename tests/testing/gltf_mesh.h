#pragma once

#include <array>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/polygon_mesh.h"

namespace skinforge::testing {

/// The triangles of a GLB file as the layers below `io` need them in tests: mesh-space positions welded where
/// they are bit-equal within one node's mesh, normals, first UV set, colours if any, material and part of
/// each face. Node transforms are left out. Trusts its input.
class GlbMesh {
 public:
  static PolygonMesh read(const std::string& path) { return GlbMesh(path).mesh_; }

 private:
  using Json = nlohmann::json;

  explicit GlbMesh(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(file), {});
    std::uint32_t length = 0;
    std::memcpy(&length, bytes_.data() + 12, 4);
    json_ = Json::parse(bytes_.substr(20, length));
    binary_ = 20 + length + 8;
    mesh_.face_begin = {0};
    mesh_.uvs.resize(1);
    for (const Json& mesh : json_["meshes"]) add_part(mesh);
  }

  // Elements of a float accessor, or of an index accessor.
  std::vector<double> numbers(const Json& primitive, const std::string& name) const {
    const bool is_index = name == "indices";
    const Json& where = is_index ? primitive : primitive["attributes"];
    if (!where.contains(name)) return {};
    const Json& a = json_["accessors"][where[name].get<std::size_t>()];
    const Json& view = json_["bufferViews"][a["bufferView"].get<std::size_t>()];
    const int type = a["componentType"];
    const std::string shape = a["type"];
    const std::size_t width = shape == "SCALAR" ? 1 : static_cast<std::size_t>(shape.back() - '0');
    const std::size_t size = type == 5126 || type == 5125 ? 4 : type == 5123 ? 2 : 1;
    const std::size_t stride = view.value("byteStride", size * width);
    const char* base = bytes_.data() + binary_ + view.value("byteOffset", std::size_t{0}) +
                       a.value("byteOffset", std::size_t{0});
    std::vector<double> values;
    for (std::size_t i = 0; i < a["count"].get<std::size_t>(); ++i)
      for (std::size_t k = 0; k < width; ++k) values.push_back(number(base + i * stride + k * size, type));
    return values;
  }

  static double number(const char* at, int type) {
    float f = 0;
    std::uint32_t u = 0;
    if (type == 5126) return std::memcpy(&f, at, 4), f;
    std::memcpy(&u, at, type == 5125 ? 4 : type == 5123 ? 2 : 1);  // little endian
    return u;
  }

  void add_part(const Json& mesh) {
    const PartId part(mesh_.parts.size());
    mesh_.parts.push_back({mesh.value("name", ""), 1, true, false});
    std::map<std::array<double, 3>, VertexId> known;
    for (const Json& primitive : mesh["primitives"]) add_primitive(primitive, part, known);
  }

  void add_primitive(const Json& primitive, PartId part, std::map<std::array<double, 3>, VertexId>& known) {
    const auto positions = numbers(primitive, "POSITION"), normals = numbers(primitive, "NORMAL");
    const auto uvs = numbers(primitive, "TEXCOORD_0"), given = numbers(primitive, "indices");
    std::vector<double> indices = given;
    for (std::size_t i = 0; given.empty() && i < positions.size() / 3; ++i)
      indices.push_back(static_cast<double>(i));
    for (std::size_t i = 0; i < indices.size(); ++i) {
      const auto v = static_cast<std::size_t>(indices[i]);
      const std::array<double, 3> at = {positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]};
      const auto [place, is_new] = known.try_emplace(at, VertexId(mesh_.positions.size()));
      if (is_new) mesh_.positions.emplace_back(at[0], at[1], at[2]);
      mesh_.corners.push_back(place->second);
      mesh_.normals.push_back(normals.empty() ? Vec3(0, 0, 0)
                                              : Vec3(normals[3 * v], normals[3 * v + 1], normals[3 * v + 2]));
      mesh_.uvs[0].push_back(uvs.empty() ? Vec2(0, 0) : Vec2(uvs[2 * v], uvs[2 * v + 1]));
      if (i % 3 != 2) continue;
      mesh_.face_begin.push_back(static_cast<std::int32_t>(mesh_.corners.size()));
      mesh_.face_material.push_back(MaterialId(primitive.value("material", -1)));
      mesh_.face_part.push_back(part);
    }
  }

  std::string bytes_;
  std::size_t binary_ = 0;
  Json json_;
  PolygonMesh mesh_;
};

}  // namespace skinforge::testing
