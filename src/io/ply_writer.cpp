#include <fmt/format.h>

#include <cstring>

#include "io/export.h"

namespace skinforge {
namespace {

template <class Number>
void append(Bytes& bytes, Number number) {
  const auto* begin = reinterpret_cast<const std::byte*>(&number);
  bytes.insert(bytes.end(), begin, begin + sizeof number);
}

}  // namespace

Bytes write_ply(const PolygonMesh& mesh, std::span<const Vec3> positions) {
  const std::string head = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment SkinForge\nelement vertex {}\nproperty float "
      "x\nproperty float "
      "y\nproperty float z\nelement face {}\nproperty list uint int vertex_indices\nend_header\n",
      positions.size(), mesh.face_count());
  Bytes bytes(head.size());
  std::memcpy(bytes.data(), head.data(), head.size());
  for (const Vec3& p : positions)
    for (const double x : p) append(bytes, static_cast<float>(x));
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(FaceId(f));
    append(bytes, static_cast<std::uint32_t>(face.size()));
    for (const VertexId v : face) append(bytes, v.value);
  }
  return bytes;
}

}  // namespace skinforge
