#include "surface/junction_normals.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace skinforge {
namespace {

constexpr double kSame = 0.999;  // ours: cosine of 2.6 degrees; files round normals to a few bits

// One side of a face: the corner that it leaves, counted within the face.
struct Side {
  FaceId face;
  std::size_t corner = 0;
};

using SideMap = std::map<std::pair<VertexId, VertexId>, Side>;  // by the vertices it runs from and to

// The normals that a face shows at the ends of one of its sides.
struct EndNormals {
  Vec3 from, to;
};

EndNormals normals_of(const PolygonMesh& mesh, const Side& side) {
  const std::size_t next = (side.corner + 1) % mesh.face(side.face).size();
  return {normal_along(mesh, side.face, side.corner, side.corner),
          normal_along(mesh, side.face, next, side.corner)};
}

template <class IsWanted>
SideMap sides_between(const PolygonMesh& mesh, std::size_t f, const IsWanted& is_wanted, SideMap sides) {
  const auto face = mesh.face(FaceId(f));
  for (std::size_t k = 0; k < face.size(); ++k) {
    const VertexId a = face[k], b = face[(k + 1) % face.size()];
    if (is_wanted(a) && is_wanted(b)) sides[{a, b}] = {FaceId(f), k};
  }
  return sides;
}

// A border edge as a junction face meets it.
struct BorderSide {
  Side own;                   // of the junction face
  Side kept;                  // of the preserved face, the other way round
  bool is_hard_from = false;  // the input was hard there, at the vertex where `own` begins ...
  bool is_hard_to = false;    // ... and where it ends
};

std::vector<BorderSide> border_sides(const JoinedSurface& result, std::int32_t site) {
  const PolygonMesh& mesh = result.mesh;
  const auto is_border = [&](VertexId v) {
    const ResultVertex& origin = result.vertices[v.index()];
    return origin.site == site && origin.source.is_valid();
  };
  SideMap kept;
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    if (result.faces[f].source.is_valid()) kept = sides_between(mesh, f, is_border, std::move(kept));
  std::vector<BorderSide> border;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    if (result.faces[f].site != site) continue;
    for (const auto& [ends, side] : sides_between(mesh, f, is_border, {}))
      if (const auto other = kept.find({ends.second, ends.first}); other != kept.end())
        border.push_back({side, other->second, false, false});
  }
  return border;
}

// Asks the input whether its shading stepped across each border edge.
void mark_hard(std::vector<BorderSide>& border, const JoinedSurface& result,
               std::span<const PreservedSource> sources) {
  std::vector<std::vector<bool>> is_border;
  for (const PreservedSource& source : sources) is_border.emplace_back(source.mesh->vertex_count(), false);
  for (const BorderSide& side : border)
    for (const VertexId v : result.mesh.face(side.own.face))
      if (const ResultVertex& o = result.vertices[v.index()]; o.source.is_valid())
        is_border[o.source.index()][o.vertex.index()] = true;
  std::vector<SideMap> gone(sources.size());
  for (std::size_t s = 0; s < sources.size(); ++s)
    for (std::size_t f = 0; f < sources[s].mesh->face_count(); ++f)
      if (!sources[s].selection.kept[f])
        gone[s] = sides_between(
            *sources[s].mesh, f, [&](VertexId v) { return is_border[s][v.index()]; }, std::move(gone[s]));
  for (BorderSide& side : border) {
    const auto face = result.mesh.face(side.own.face);
    const ResultVertex& from = result.vertices[face[side.own.corner].index()];
    const ResultVertex& to = result.vertices[face[(side.own.corner + 1) % face.size()].index()];
    const auto& sides = gone[from.source.index()];
    const auto other = sides.find({from.vertex, to.vertex});
    if (other == sides.end()) continue;  // an open border of the input
    const EndNormals kept = normals_of(result.mesh, side.kept),
                     lost = normals_of(*sources[from.source.index()].mesh, other->second);
    side.is_hard_from = kept.to.dot(lost.from) < kSame;
    side.is_hard_to = kept.from.dot(lost.to) < kSame;
  }
}

// What the corners of the junction can be shaded by at one border vertex.
struct BorderVertex {
  std::vector<Vec3> normals;  // of preserved faces across border edges that are not hard
  int flat = 0, corners = 0;  // of the preserved faces: with the normal of their face; all
  Vec3 some = Vec3::Zero();   // normal of one of them ...
  bool is_even = true;        // ... and of all

  bool is_flat() const { return !is_even && 2 * flat > corners; }
};

std::map<VertexId, BorderVertex> border_vertices(const JoinedSurface& result, std::int32_t site,
                                                 const std::vector<BorderSide>& border) {
  const PolygonMesh& mesh = result.mesh;
  std::map<VertexId, BorderVertex> vertices;
  for (const BorderSide& side : border) {
    const auto face = mesh.face(side.own.face);
    const EndNormals kept = normals_of(mesh, side.kept);
    BorderVertex& from = vertices[face[side.own.corner]];
    BorderVertex& to = vertices[face[(side.own.corner + 1) % face.size()]];
    if (!side.is_hard_from) from.normals.push_back(kept.to);
    if (!side.is_hard_to) to.normals.push_back(kept.from);
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    if (!result.faces[f].source.is_valid()) continue;
    const auto face = mesh.face(FaceId(f));
    for (std::size_t k = 0; k < face.size(); ++k) {
      if (result.vertices[face[k].index()].site != site) continue;
      const auto found = vertices.find(face[k]);
      if (found == vertices.end()) continue;
      BorderVertex& v = found->second;
      const Vec3& normal = mesh.normals[mesh.first_corner(FaceId(f)) + k];
      if (v.corners++ == 0) v.some = normal;
      v.is_even = v.is_even && normal.dot(v.some) > kSame;
      v.flat += normal.dot(area_normal(mesh, FaceId(f)).normalized()) > kSame;
    }
  }
  return vertices;
}

// The one of several normals that a face turns to.
const Vec3& nearest_normal(const std::vector<Vec3>& normals, const Vec3& own) {
  return *std::max_element(normals.begin(), normals.end(),
                           [&](const Vec3& a, const Vec3& b) { return a.dot(own) < b.dot(own); });
}

std::map<VertexId, Vec3> smooth_normals(const JoinedSurface& result, std::int32_t site) {
  std::map<VertexId, Vec3> normals;
  for (std::size_t f = 0; f < result.mesh.face_count(); ++f)
    if (result.faces[f].site == site)
      for (const VertexId v : result.mesh.face(FaceId(f)))
        normals.try_emplace(v, Vec3::Zero()).first->second += area_normal(result.mesh, FaceId(f));
  for (auto& [vertex, normal] : normals)
    if (normal.norm() > 0) normal.normalize();
  return normals;
}

}  // namespace

Vec3 normal_along(const PolygonMesh& mesh, FaceId f, std::size_t corner, std::size_t side) {
  const SplitNormals* split = mesh.split_of(f);
  if (!split || corner % 2 == 1) return mesh.normals[mesh.first_corner(f) + corner];
  return (side < 2 ? split->first : split->second)[corner / 2];
}

void shade_junction(JoinedSurface& result, std::span<const PreservedSource> sources, std::int32_t site) {
  PolygonMesh& mesh = result.mesh;
  std::vector<BorderSide> border = border_sides(result, site);
  mark_hard(border, result, sources);
  const std::map<VertexId, BorderVertex> vertices = border_vertices(result, site, border);
  const std::map<VertexId, Vec3> smooth = smooth_normals(result, site);
  const auto flat_count =
      std::count_if(vertices.begin(), vertices.end(), [](const auto& v) { return v.second.is_flat(); });
  const bool is_flat = 2 * static_cast<std::size_t>(flat_count) > vertices.size();
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    if (result.faces[f].site != site) continue;
    const Vec3 own = area_normal(mesh, FaceId(f)).normalized();
    const auto face = mesh.face(FaceId(f));
    for (std::size_t k = 0; k < face.size(); ++k) {
      Vec3& normal = mesh.normals[mesh.first_corner(FaceId(f)) + k];
      const Vec3& mean = smooth.at(face[k]);
      const auto at = vertices.find(face[k]);
      const bool at_flat = at == vertices.end() ? is_flat : at->second.is_flat();
      normal = at_flat || !(mean.norm() > 0) ? own : mean;
      if (at != vertices.end() && !at_flat && !at->second.normals.empty())
        normal = nearest_normal(at->second.normals, own);
    }
  }
  // Along the border itself the preserved face across the edge decides, not the nearest.
  for (const BorderSide& side : border) {
    const std::size_t first = mesh.first_corner(side.own.face), n = mesh.face(side.own.face).size();
    const std::size_t from = first + side.own.corner, to = first + (side.own.corner + 1) % n;
    const EndNormals kept = normals_of(mesh, side.kept);
    const auto shade = [&](std::size_t corner, bool is_hard, const Vec3& normal) {
      const VertexId v = mesh.corners[corner];
      if (vertices.at(v).is_flat()) return;
      mesh.normals[corner] = is_hard ? smooth.at(v) : normal;
    };
    shade(from, side.is_hard_from, kept.to);
    shade(to, side.is_hard_to, kept.from);
  }
}

std::vector<double> border_normal_steps(const JoinedSurface& result, std::int32_t site) {
  std::vector<double> steps;
  for (const BorderSide& side : border_sides(result, site)) {
    const EndNormals own = normals_of(result.mesh, side.own), kept = normals_of(result.mesh, side.kept);
    for (const auto& [a, b] : {std::pair(own.from, kept.to), std::pair(own.to, kept.from)})
      steps.push_back(std::atan2(a.cross(b).norm(), a.dot(b)));
  }
  return steps;
}

}  // namespace skinforge
