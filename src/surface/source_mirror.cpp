#include "surface/source_mirror.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/edges.h"

namespace skinforge {
namespace {

constexpr double kLeastShare = 0.8;    // ours: of the vertices; hair and clothes may differ
constexpr double kReach = 0.1;         // ours: of the mean edge; what was placed by hand is a little off
constexpr double kSamePresence = 0.1;  // ours: weights of left and right joints are painted apart
constexpr double kMostUnlike = 0.1;    // ours: of the vertices that a cut takes away

double mean_edge(const PolygonMesh& mesh, const EdgeList& edges) {
  double sum = 0, count = 0;
  for (const Edge& edge : edges.edges) {
    sum += (mesh.positions[edge.vertices[0].index()] - mesh.positions[edge.vertices[1].index()]).norm();
    count += 1;
  }
  return count > 0 ? sum / count : 0;
}

double matched_share(const std::vector<VertexId>& partners) {
  const auto without = std::count(partners.begin(), partners.end(), VertexId());
  return 1 - static_cast<double>(without) / static_cast<double>(std::max<std::size_t>(1, partners.size()));
}

// Finds for each source, in order, the one of equal size that it matches best, itself among them.
void match_sources(SourceMirror& mirror, std::span<const PreservedSource> sources) {
  mirror.image.resize(sources.size());
  mirror.vertex.resize(sources.size());
  for (std::size_t s = 0; s < sources.size(); ++s) {
    mirror.vertex[s].resize(sources[s].mesh->vertex_count(), VertexId());
    if (mirror.image[s].is_valid()) continue;
    const double reach = kReach * mean_edge(*sources[s].mesh, *sources[s].edges);
    double most = kLeastShare;
    for (std::size_t t = s; t < sources.size(); ++t) {
      if (mirror.image[t].is_valid() || sources[t].mesh->vertex_count() != sources[s].mesh->vertex_count())
        continue;
      auto found =
          mirror_partners(sources[s].mesh->positions, sources[t].mesh->positions, mirror.plane, reach);
      const double share = matched_share(found);
      if (share <= most) continue;
      most = share;
      mirror.image[s] = SourceId(t);
      mirror.vertex[s] = std::move(found);
    }
    if (!mirror.image[s].is_valid()) continue;
    const std::size_t t = mirror.image[s].index();
    mirror.image[t] = SourceId(s);
    const std::vector<VertexId> forth = mirror.vertex[s];
    mirror.vertex[t].assign(sources[t].mesh->vertex_count(), VertexId());
    for (std::size_t v = 0; v < forth.size(); ++v)
      if (forth[v].is_valid()) mirror.vertex[t][forth[v].index()] = VertexId(v);
  }
}

// Faces at each vertex, rising.
std::vector<std::vector<FaceId>> faces_of_vertices(const PolygonMesh& mesh) {
  std::vector<std::vector<FaceId>> faces(mesh.vertex_count());
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    for (const VertexId v : mesh.face(FaceId(f))) faces[v.index()].push_back(FaceId(f));
  return faces;
}

// The lowest face with these corners, which are sorted.
FaceId face_with(const PolygonMesh& mesh, const std::vector<std::vector<FaceId>>& faces,
                 const std::vector<VertexId>& corners) {
  const std::vector<FaceId>* fewest = nullptr;
  for (const VertexId v : corners) {
    if (!v.is_valid()) return {};
    if (!fewest || faces[v.index()].size() < fewest->size()) fewest = &faces[v.index()];
  }
  if (!fewest) return {};
  std::vector<VertexId> own;
  const auto found = std::find_if(fewest->begin(), fewest->end(), [&](FaceId f) {
    own.assign(mesh.face(f).begin(), mesh.face(f).end());
    std::sort(own.begin(), own.end());
    return own == corners;
  });
  return found == fewest->end() ? FaceId() : *found;
}

std::vector<FaceId> face_images(const PolygonMesh& from, const std::vector<VertexId>& vertex,
                                const PolygonMesh& to) {
  const std::vector<std::vector<FaceId>> faces = faces_of_vertices(to);
  std::vector<FaceId> images;
  std::vector<VertexId> corners;
  for (std::size_t f = 0; f < from.face_count(); ++f) {
    corners.clear();
    for (const VertexId v : from.face(FaceId(f))) corners.push_back(vertex[v.index()]);
    std::sort(corners.begin(), corners.end());
    images.push_back(face_with(to, faces, corners));
  }
  return images;
}

// Of the vertices that one of two participants does not have whole, those that differ.
bool is_like(const SourceMirror& mirror, const SiteParticipant& a, const SiteParticipant& b) {
  std::size_t cut = 0, unlike = 0;
  for (std::size_t v = 0; v < a.presence.size(); ++v) {
    const VertexId image = mirror.vertex[a.source.index()][v];
    const double other = image.is_valid() ? b.presence[image.index()] : a.presence[v];
    if (a.presence[v] >= 1 && other >= 1) continue;
    ++cut;
    unlike += std::abs(a.presence[v] - other) > kSamePresence;
  }
  return static_cast<double>(unlike) <= kMostUnlike * static_cast<double>(cut);
}

}  // namespace

std::optional<SourceMirror> find_source_mirror(std::span<const PreservedSource> sources) {
  if (sources.empty()) return std::nullopt;
  const auto base = find_mirror_symmetry(sources[0].mesh->positions, {.least_share = kLeastShare});
  if (!base) return std::nullopt;
  SourceMirror mirror{base->plane, base->matched, {}, {}, {}};
  match_sources(mirror, sources);
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const PolygonMesh& from = *sources[s].mesh;
    mirror.face.push_back(mirror.image[s].is_valid()
                              ? face_images(from, mirror.vertex[s], *sources[mirror.image[s].index()].mesh)
                              : std::vector<FaceId>(from.face_count()));
  }
  return mirror;
}

bool are_mirror_images(const SourceMirror& mirror, std::span<const SiteParticipant> a,
                       std::span<const SiteParticipant> b) {
  return a.size() == b.size() && std::all_of(a.begin(), a.end(), [&](const SiteParticipant& p) {
           return std::any_of(b.begin(), b.end(), [&](const SiteParticipant& q) {
             return mirror.image[p.source.index()] == q.source && p.is_host == q.is_host &&
                    p.is_added == q.is_added && is_like(mirror, p, q);
           });
         });
}

std::size_t discard_images(std::span<PreservedSource> sources, const SourceMirror& mirror,
                           std::span<const std::int32_t> site_image) {
  std::size_t discarded = 0;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    if (!mirror.image[s].is_valid()) continue;
    const SourceSelection& from = sources[s].selection;
    SourceSelection& to = sources[mirror.image[s].index()].selection;
    for (std::size_t f = 0; f < from.kept.size(); ++f) {
      const FaceId image = mirror.face[s][f];
      if (from.kept[f] || from.face_site[f] < 0 || !image.is_valid() || !to.kept[image.index()]) continue;
      const std::int32_t site = site_image[static_cast<std::size_t>(from.face_site[f])];
      if (site < 0) continue;
      to.kept[image.index()] = 0;
      to.face_site[image.index()] = site;
      ++discarded;
    }
  }
  return discarded;
}

std::optional<std::vector<std::int32_t>> border_images(const SourceMirror& mirror,
                                                       const std::vector<JunctionLoop>& from,
                                                       const std::vector<JunctionLoop>& to) {
  std::map<std::pair<SourceId, VertexId>, std::int32_t> names;
  std::vector<std::int32_t> next;  // per border vertex of `to`: the one after it
  for (const JunctionLoop& loop : to) {
    const auto first = static_cast<std::int32_t>(next.size()),
               n = static_cast<std::int32_t>(loop.vertices.size());
    for (std::int32_t k = 0; k < n; ++k) {
      names[{loop.source, loop.vertices[k]}] = first + k;
      next.push_back(first + (k + 1) % n);
    }
  }
  std::vector<std::int32_t> images;
  for (const JunctionLoop& loop : from) {
    const std::size_t first = images.size(), n = loop.vertices.size();
    for (const VertexId v : loop.vertices) {
      const auto found =
          names.find({mirror.image[loop.source.index()], mirror.vertex[loop.source.index()][v.index()]});
      if (found == names.end()) return std::nullopt;
      images.push_back(found->second);
    }
    for (std::size_t k = 0; k < n; ++k)  // mirrored loops run backwards
      if (next[images[first + (k + 1) % n]] != images[first + k]) return std::nullopt;
  }
  if (images.size() != next.size()) return std::nullopt;
  return images;
}

}  // namespace skinforge
