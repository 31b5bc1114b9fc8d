#include "surface/preserved.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace skinforge {
namespace {

// Gives discarded faces without a site the site of a discarded neighbour, spreading from face to face.
void spread_sites(const EdgeList& edges, SourceSelection& selection) {
  for (bool changed = true; changed;) {
    changed = false;
    for (const Edge& edge : edges.edges) {
      std::int32_t site = -1;
      for (const std::int32_t corner : edge.half_edges)
        site = std::max(site, selection.face_site[edges.face_of_corner[corner].index()]);
      if (site < 0) continue;
      for (const std::int32_t corner : edge.half_edges) {
        const std::size_t f = edges.face_of_corner[corner].index();
        if (!selection.kept[f] && selection.face_site[f] < 0) selection.face_site[f] = site, changed = true;
      }
    }
  }
}

int border_edge_count(const PolygonMesh& mesh, const EdgeList& edges, const FaceSet& kept) {
  int count = 0;
  for (const BorderChain& chain : border_chains(mesh, edges, kept))
    count += static_cast<int>(chain.vertices.size());
  return count;
}

const Edge& edge_between(const EdgeList& edges, VertexId a, VertexId b) {
  const std::array<VertexId, 2> ends = {std::min(a, b), std::max(a, b)};
  return *std::lower_bound(
      edges.edges.begin(), edges.edges.end(), ends,
      [](const Edge& e, const std::array<VertexId, 2>& wanted) { return e.vertices < wanted; });
}

// The site that most of the discarded faces along a chain belong to.
std::int32_t site_of_chain(const EdgeList& edges, const SourceSelection& selection,
                           const BorderChain& chain) {
  std::map<std::int32_t, int> votes;
  const std::size_t n = chain.vertices.size(), count = chain.is_closed ? n : n - 1;
  for (std::size_t i = 0; i < count; ++i) {
    for (const std::int32_t corner :
         edge_between(edges, chain.vertices[i], chain.vertices[(i + 1) % n]).half_edges) {
      const std::size_t f = edges.face_of_corner[corner].index();
      if (!selection.kept[f]) ++votes[selection.face_site[f]];
    }
  }
  std::int32_t best = -1;
  int most = 0;
  for (const auto& [site, number] : votes)
    if (number > most) most = number, best = site;
  return best;
}

// Adds to each border vertex its neighbours on kept faces that are not on the border themselves.
void add_inward_neighbours(const PolygonMesh& mesh, const EdgeList& edges, const FaceSet& kept,
                           JunctionLoop& loop) {
  std::map<VertexId, std::size_t> place;
  for (std::size_t i = 0; i < loop.vertices.size(); ++i) place[loop.vertices[i]] = i;
  loop.inward.resize(loop.vertices.size());
  for (const Edge& edge : edges.edges) {
    const auto first = place.find(edge.vertices[0]), second = place.find(edge.vertices[1]);
    if ((first == place.end()) == (second == place.end())) continue;
    const bool is_kept =
        std::any_of(edge.half_edges.begin(), edge.half_edges.end(),
                    [&](std::int32_t corner) { return kept[edges.face_of_corner[corner].index()] != 0; });
    if (!is_kept) continue;
    const VertexId inner = edge.vertices[first == place.end() ? 0 : 1];
    loop.inward[(first == place.end() ? second : first)->second].push_back(mesh.positions[inner.index()]);
  }
}

void tidy(const PolygonMesh& mesh, const EdgeList& edges, const PreserveOptions& options, FaceSet& kept) {
  const FaceSet before = kept;
  open_face_set(mesh, edges, kept);
  drop_crumbs(mesh, edges, kept, options.least_faces);
  restore_broken_groups(mesh, edges, before, kept);
  const int border = border_edge_count(mesh, edges, kept);
  const int allowed =
      std::max(options.straighten_least, static_cast<int>(std::lround(options.straighten_share * border)));
  straighten_border(mesh, edges, kept, allowed);
  drop_pinches(mesh, edges, kept);
  drop_crumbs(mesh, edges, kept, options.least_faces);
  drop_pinches(mesh, edges, kept);
}

void give_up(SourceSelection& selection, std::size_t face, std::size_t site) {
  selection.kept[face] = 0;
  selection.face_site[face] = static_cast<std::int32_t>(site);
}

// Kept faces that touch those that were given up for a site.
void give_up_ring(const PolygonMesh& mesh, const SiteParticipant& participant, SourceSelection& selection,
                  std::size_t site) {
  std::vector<char> is_near(mesh.vertex_count(), 0);
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    if (!selection.kept[f] && selection.face_site[f] == static_cast<std::int32_t>(site))
      for (const VertexId v : mesh.face(FaceId(f))) is_near[v.index()] = 1;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(FaceId(f));
    if (selection.kept[f] && participant.fusing[f] &&
        std::any_of(face.begin(), face.end(), [&](VertexId v) { return is_near[v.index()] != 0; }))
      give_up(selection, f, site);
  }
}

}  // namespace

void discard_moved_faces(std::span<PreservedSource> sources, std::span<const SiteParticipant> participants,
                         const std::vector<FusionSolid>& solids, const SiteField& field, std::size_t site,
                         const PreserveOptions& options) {
  if (field.is_empty()) return;
  const Eigen::AlignedBox3d box = field.distance.lattice.box();
  const double tolerance = options.moved_voxels * field.voxel();
  const bool is_addition = std::any_of(participants.begin(), participants.end(),
                                       [](const SiteParticipant& p) { return p.is_added; });
  for (const SiteParticipant& participant : participants) {
    PreservedSource& source = sources[participant.source.index()];
    const PolygonMesh& mesh = *source.mesh;
    std::vector<signed char> moved(mesh.vertex_count(), -1);  // not asked yet
    const auto is_moved = [&](VertexId v) {
      signed char& answer = moved[v.index()];
      const Vec3& p = mesh.positions[v.index()];
      if (answer < 0) answer = box.contains(p) && std::abs(blended_distance(solids, field, p)) > tolerance;
      return answer != 0;
    };
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      if (!source.selection.kept[f] || !participant.fusing[f]) continue;
      const auto face = mesh.face(FaceId(f));
      if (std::any_of(face.begin(), face.end(), is_moved)) give_up(source.selection, f, site);
    }
    if (is_addition && participant.is_host)
      for (int ring = 0; ring < options.added_rings; ++ring)
        give_up_ring(mesh, participant, source.selection, site);
  }
}

std::size_t discard_faces(std::span<PreservedSource> sources, std::span<const SiteParticipant> participants,
                          std::span<const std::pair<SourceId, FaceId>> faces, std::size_t site) {
  std::size_t discarded = 0;
  for (const SiteParticipant& participant : participants) {
    SourceSelection& selection = sources[participant.source.index()].selection;
    for (const auto& [source, face] : faces) {
      if (source != participant.source || !participant.fusing[face.index()]) continue;
      if (!selection.kept[face.index()]) continue;
      give_up(selection, face.index(), site);
      ++discarded;
    }
  }
  return discarded;
}

void clean_borders(PreservedSource& source, const PreserveOptions& options) {
  const PolygonMesh& mesh = *source.mesh;
  FaceSet& kept = source.selection.kept;
  const EdgeList& edges = *source.edges;
  const FaceSet before = kept;
  tidy(mesh, edges, options, kept);
  const auto has_any = [](const FaceSet& set) { return std::find(set.begin(), set.end(), 1) != set.end(); };
  if (!has_any(kept) && has_any(before)) {  // a few faces may be all there is, like the tip of a hand
    kept = before;
    drop_pinches(mesh, edges, kept);
  }
  spread_sites(edges, source.selection);
}

std::vector<JunctionLoop> loops_of_sites(const PreservedSource& source, SourceId id,
                                         std::span<const std::size_t> sites, bool is_host,
                                         std::vector<JunctionLoop>& arcs) {
  const PolygonMesh& mesh = *source.mesh;
  const EdgeList& edges = *source.edges;
  std::vector<JunctionLoop> loops;
  for (const BorderChain& chain : border_chains(mesh, edges, source.selection.kept)) {
    const std::int32_t owner = site_of_chain(edges, source.selection, chain);
    if (owner < 0 || std::find(sites.begin(), sites.end(), static_cast<std::size_t>(owner)) == sites.end())
      continue;
    JunctionLoop loop{id, is_host, chain.vertices, {}, {}};
    for (const VertexId v : chain.vertices) loop.positions.push_back(mesh.positions[v.index()]);
    add_inward_neighbours(mesh, edges, source.selection.kept, loop);
    const bool is_arc = !chain.is_closed || chain.vertices.size() < 3;
    (is_arc ? arcs : loops).push_back(std::move(loop));
  }
  return loops;
}

}  // namespace skinforge
