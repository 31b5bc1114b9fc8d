#include "surface/assemble.h"

#include <algorithm>
#include <map>

#include "geometry/quad_pairing.h"
#include "surface/junction_normals.h"

namespace skinforge {
namespace {

constexpr double kJunctionQuadScore =
    0.35;  // ours: lower than for recovery, because nobody modelled these triangles

constexpr double kAnyQuadScore = 0.01;  // ours: a quad that folds scores 0

class Assembler {
 public:
  explicit Assembler(std::span<const PreservedSource> sources) : sources_(sources) {
    result_.mesh.face_begin = {0};
    std::size_t uv_sets = 0;
    bool has_colors = false;
    for (const PreservedSource& source : sources) {
      uv_sets = std::max(uv_sets, source.mesh->uvs.size());
      has_colors |= !source.mesh->colors.empty();
      vertex_names_.emplace_back(source.mesh->vertex_count());
    }
    result_.mesh.uvs.resize(uv_sets);
    has_colors_ = has_colors;
  }

  void add_source(SourceId id) {
    const PolygonMesh& mesh = *sources_[id.index()].mesh;
    const auto first_part = static_cast<std::int32_t>(result_.mesh.parts.size());
    result_.first_part.push_back(PartId(first_part));
    result_.mesh.parts.insert(result_.mesh.parts.end(), mesh.parts.begin(), mesh.parts.end());
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      if (!sources_[id.index()].selection.kept[f]) continue;
      const std::size_t first = mesh.first_corner(FaceId(f));
      if (const SplitNormals* split = mesh.split_of(FaceId(f)))
        result_.mesh.split.push_back({FaceId(result_.mesh.face_count()), split->first, split->second});
      for (std::size_t c = first; c < first + mesh.face(FaceId(f)).size(); ++c)
        add_corner(mesh, c, preserved_vertex(id, mesh.corners[c]));
      close_face(mesh.face_material[f], PartId(mesh.face_part[f].value + first_part), {id, FaceId(f), -1});
    }
  }

  void add_junction(const Junction& junction, std::int32_t site, JunctionElements elements) {
    if (junction.is_empty()) {
      result_.junction_part.emplace_back();
      return;
    }
    const PartId part(static_cast<std::int32_t>(result_.mesh.parts.size()));
    result_.junction_part.push_back(part);
    result_.mesh.parts.push_back({"junction" + std::to_string(site + 1), 0, true, false});
    add_patch({junction.loops, junction.patch, junction.quads}, part, site, elements);
    for (const ArcStrip& strip : junction.strips)
      add_patch({strip.arcs, strip.patch, strip.quads}, part, site, elements);
  }

  JoinedSurface take() { return std::move(result_); }

 private:
  // New faces between borders: triangles 2 k and 2 k + 1 are halves of a quad, for k below `quads`.
  struct NewFaces {
    const std::vector<JunctionLoop>& borders;
    const TrianglePatch& patch;
    std::size_t quads;
  };

  void add_patch(const NewFaces& made, PartId part, std::int32_t site, JunctionElements elements) {
    const std::vector<VertexId> names = new_vertices(made, site);
    const bool has_quads = elements != JunctionElements::Triangles;
    if (has_quads) add_halved_quads(made, names, part, site);
    const PolygonMesh polygons =
        has_quads ? paired_patch(made.patch, 2 * made.quads, elements) : patch_mesh(made.patch, 0);
    for (std::size_t f = 0; f < polygons.face_count(); ++f) {
      for (const VertexId v : polygons.face(FaceId(f))) add_plain_corner(names[v.index()]);
      close_face(MaterialId(), part, {SourceId(), FaceId(), site});
    }
  }

  VertexId preserved_vertex(SourceId id, VertexId v) {
    VertexId& name = vertex_names_[id.index()][v.index()];
    if (!name.is_valid()) name = new_vertex(sources_[id.index()].mesh->positions[v.index()], {id, v, -1});
    return name;
  }

  VertexId new_vertex(const Vec3& position, const ResultVertex& origin) {
    result_.mesh.positions.push_back(position);
    result_.vertices.push_back(origin);
    return VertexId(result_.vertices.size() - 1);
  }

  void add_corner(const PolygonMesh& mesh, std::size_t c, VertexId name) {
    PolygonMesh& out = result_.mesh;
    out.corners.push_back(name);
    out.normals.push_back(mesh.normals[c]);
    for (std::size_t s = 0; s < out.uvs.size(); ++s)
      out.uvs[s].push_back(s < mesh.uvs.size() ? mesh.uvs[s][c] : Vec2(0, 0));
    if (has_colors_) out.colors.push_back(mesh.colors.empty() ? Vec4(Vec4::Ones()) : mesh.colors[c]);
  }

  void add_plain_corner(VertexId name) {
    PolygonMesh& out = result_.mesh;
    out.corners.push_back(name);
    out.normals.push_back(Vec3::Zero());
    for (auto& set : out.uvs) set.push_back(Vec2::Zero());
    if (has_colors_) out.colors.push_back(Vec4::Ones());
  }

  void close_face(MaterialId material, PartId part, const ResultFace& origin) {
    result_.mesh.face_begin.push_back(static_cast<std::int32_t>(result_.mesh.corner_count()));
    result_.mesh.face_material.push_back(material);
    result_.mesh.face_part.push_back(part);
    result_.faces.push_back(origin);
  }

  std::vector<VertexId> new_vertices(const NewFaces& made, std::int32_t site) {
    std::vector<VertexId> names;
    for (const JunctionLoop& border : made.borders)
      for (const VertexId v : border.vertices) {
        names.push_back(preserved_vertex(border.source, v));
        result_.vertices[names.back().index()].site = site;
      }
    for (std::size_t v = made.patch.fixed; v < made.patch.positions.size(); ++v)
      names.push_back(new_vertex(made.patch.positions[v], {SourceId(), VertexId(), site}));
    return names;
  }

  // Quads that the junction was made of; each begins where its halves do.
  void add_halved_quads(const NewFaces& made, const std::vector<VertexId>& names, PartId part,
                        std::int32_t site) {
    for (std::size_t k = 0; k < made.quads; ++k) {
      const Triangle& first = made.patch.triangles[2 * k];
      for (const std::int32_t v : {first[0], first[1], first[2], made.patch.triangles[2 * k + 1][2]})
        add_plain_corner(names[v]);
      close_face(MaterialId(), part, {SourceId(), FaceId(), site});
    }
  }

  // The triangles from `begin` on.
  static PolygonMesh patch_mesh(const TrianglePatch& patch, std::size_t begin) {
    PolygonMesh mesh;
    mesh.positions = patch.positions;
    mesh.parts = {{"junction", 0, false, false}};
    mesh.face_begin = {0};
    for (const Triangle& t : std::span(patch.triangles).subspan(begin)) {
      for (const std::int32_t v : t) mesh.corners.emplace_back(v);
      mesh.face_begin.push_back(static_cast<std::int32_t>(mesh.corners.size()));
      mesh.face_material.emplace_back();
      mesh.face_part.emplace_back(0);
    }
    mesh.normals.assign(mesh.corner_count(), Vec3::Zero());
    return mesh;
  }

  // The same, paired to quads where that makes good ones.
  static PolygonMesh paired_patch(const TrianglePatch& patch, std::size_t begin, JunctionElements elements) {
    const double score = elements == JunctionElements::Quads ? kAnyQuadScore : kJunctionQuadScore;
    return recover_quads(patch_mesh(patch, begin), {.min_score = score, .follower_bonus = 0});
  }

  std::span<const PreservedSource> sources_;
  JoinedSurface result_;
  std::vector<std::vector<VertexId>> vertex_names_;
  bool has_colors_ = false;
};

}  // namespace

JoinedSurface assemble_surface(std::span<const PreservedSource> sources, std::span<const Junction> junctions,
                               std::span<const JunctionElements> elements) {
  Assembler assembler(sources);
  for (std::size_t s = 0; s < sources.size(); ++s) assembler.add_source(SourceId(s));
  for (std::size_t j = 0; j < junctions.size(); ++j)
    assembler.add_junction(junctions[j], static_cast<std::int32_t>(j),
                           elements.empty() ? JunctionElements::Auto : elements[j]);
  JoinedSurface result = assembler.take();
  for (std::size_t j = 0; j < junctions.size(); ++j)
    if (!junctions[j].is_empty()) shade_junction(result, sources, static_cast<std::int32_t>(j));
  return result;
}

}  // namespace skinforge
