#include "surface/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/edges.h"

namespace skinforge {
namespace {

void smooth(const PolygonMesh& mesh, std::vector<double>& presence, int passes) {
  if (passes <= 0) return;
  const VertexGraph graph = build_vertex_graph(mesh);
  for (int pass = 0; pass < passes; ++pass) {
    const std::vector<double> before = presence;
    for (std::size_t v = 0; v < presence.size(); ++v) {
      const auto neighbours = graph.of(VertexId(v));
      if (before[v] == 0 || before[v] == 1 || neighbours.empty()) continue;
      double sum = 0;
      for (const VertexId n : neighbours) sum += before[n.index()];
      presence[v] = 0.5 * before[v] + 0.5 * sum / static_cast<double>(neighbours.size());
    }
  }
}

// By the exponent of the reference: h' = (h + 1) / 2, g = (1 - h') / h'.
void harden(std::vector<double>& presence, double hardness) {
  if (hardness == 0) return;
  const double exponent = (1 - hardness) / (1 + hardness);
  for (double& p : presence)
    if (p > 0 && p < 1) p = std::pow(p, exponent);
}

// Mean and variance of the presence over the vertices of each component, and whether it spans whole faces of
// 0 and of 1.
struct ComponentStatistics {
  double count = 0, sum = 0, squares = 0;
  bool has_full_face = false, has_empty_face = false;
  double area = 0;
  Vec3 area_vector = Vec3::Zero();  // zero for a closed surface

  double mean() const { return count > 0 ? sum / count : 0; }
  // Departure: the paper's own sheets (leaves, capes) are components that no operation cuts.
  bool is_sheet() const {
    constexpr double kFlat = 0.75;  // ours: half a cylinder has 0.64, a bust that is open below 0.1
    return area_vector.norm() > kFlat * area;
  }
  double variance() const { return count > 0 ? std::max(0.0, squares / count - mean() * mean()) : 0; }
};

template <class Predicate>
bool all_of_face(const PolygonMesh& mesh, std::size_t f, Predicate&& holds) {
  const auto face = mesh.face(FaceId(f));
  return std::all_of(face.begin(), face.end(), [&](VertexId v) { return holds(v.index()); });
}

std::vector<ComponentStatistics> measure_components(const PolygonMesh& mesh, const Components& components,
                                                    const std::vector<double>& presence) {
  std::vector<ComponentStatistics> all(static_cast<std::size_t>(components.count));
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    if (components.of_vertex[v] < 0) continue;
    ComponentStatistics& s = all[components.of_vertex[v]];
    s.count += 1;
    s.sum += presence[v];
    s.squares += presence[v] * presence[v];
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    ComponentStatistics& s = all[components.of_face[f]];
    s.has_full_face |= all_of_face(mesh, f, [&](std::size_t v) { return presence[v] == 1; });
    s.has_empty_face |= all_of_face(mesh, f, [&](std::size_t v) { return presence[v] == 0; });
    const Vec3 area = area_normal(mesh, FaceId(f));
    s.area += area.norm();
    s.area_vector += area;
  }
  return all;
}

// The rule of the cut that leaves least of each component.
std::vector<SelectionOptions> rules_of(const PolygonMesh& mesh, const Components& components,
                                       std::span<const Cut> cuts, const SourceSelection& selection) {
  std::vector<SelectionOptions> rules(static_cast<std::size_t>(components.count));
  std::vector<double> least(rules.size(), std::numeric_limits<double>::infinity());
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    const auto statistics = measure_components(mesh, components, selection.site_presence[c]);
    for (std::size_t k = 0; k < rules.size(); ++k)
      if (statistics[k].mean() < least[k]) least[k] = statistics[k].mean(), rules[k] = cuts[c].options;
  }
  return rules;
}

ComponentRole role_of(const ComponentStatistics& s, const SelectionOptions& options) {
  const bool spans = s.has_full_face && s.has_empty_face;
  if (spans || s.variance() >= options.keep_variance)
    return s.is_sheet() ? ComponentRole::Sheet : ComponentRole::Blended;
  return s.mean() > options.keep_mean ? ComponentRole::KeptWhole : ComponentRole::DroppedWhole;
}

// The site whose cut leaves least of the face.
std::int32_t discarding_site(const PolygonMesh& mesh, std::size_t f, const SourceSelection& selection) {
  double least = 2;
  std::int32_t site = -1;
  for (std::size_t c = 0; c < selection.cut_sites.size(); ++c) {
    double sum = 0;
    for (const VertexId v : mesh.face(FaceId(f))) sum += selection.site_presence[c][v.index()];
    sum /= static_cast<double>(mesh.face(FaceId(f)).size());
    if (sum < least) least = sum, site = static_cast<std::int32_t>(selection.cut_sites[c]);
  }
  return site;
}

bool is_kept(const PolygonMesh& mesh, std::size_t f, ComponentRole role, std::span<const Cut> cuts,
             const SourceSelection& selection) {
  if (role == ComponentRole::KeptWhole) return true;
  if (role == ComponentRole::DroppedWhole) return false;
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    const std::vector<double>& presence = selection.site_presence[c];
    const bool fades = role == ComponentRole::Sheet && cuts[c].is_of_added;
    if (!all_of_face(mesh, f, [&](std::size_t v) { return fades ? presence[v] > 0 : presence[v] == 1; }))
      return false;
  }
  return true;
}

}  // namespace

std::vector<double> presence_of_cut(const PolygonMesh& mesh, const SkinWeights& weights,
                                    const std::vector<bool>& removed, const SelectionOptions& options) {
  std::vector<double> presence(mesh.vertex_count(), 0);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    for (const Influence& i : weights.of(VertexId(v)))
      if (!removed[i.joint.index()]) presence[v] += i.weight;
    if (presence[v] <= options.clamp) presence[v] = 0;
    if (presence[v] >= 1 - options.clamp) presence[v] = 1;
  }
  smooth(mesh, presence, options.smoothing_passes);
  harden(presence, options.hardness);
  return presence;
}

SourceSelection select_faces(const PolygonMesh& mesh, const SkinWeights& weights, std::span<const Cut> cuts,
                             const std::string& place, IssueSink& issues) {
  SourceSelection selection;
  selection.presence.assign(mesh.vertex_count(), 1);
  for (const Cut& cut : cuts) {
    selection.cut_sites.push_back(cut.site);
    selection.site_presence.push_back(presence_of_cut(mesh, weights, cut.removed, cut.options));
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
      selection.presence[v] = std::min(selection.presence[v], selection.site_presence.back()[v]);
  }
  const Components components = connected_components(mesh);
  const std::vector<SelectionOptions> rules = rules_of(mesh, components, cuts, selection);
  std::vector<ComponentRole> roles;
  std::size_t kept_whole = 0, dropped_whole = 0;
  for (const ComponentStatistics& s : measure_components(mesh, components, selection.presence)) {
    roles.push_back(role_of(s, rules[roles.size()]));
    kept_whole += roles.back() == ComponentRole::KeptWhole && s.mean() < 1;
    dropped_whole += roles.back() == ComponentRole::DroppedWhole && s.mean() > 0;
  }
  if (kept_whole + dropped_whole > 0)
    issues.note(
        "secondary-components", place,
        fmt::format("{} partly present components kept whole, {} dropped whole", kept_whole, dropped_whole));
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const ComponentRole role = roles[components.of_face[f]];
    const bool keep = is_kept(mesh, f, role, cuts, selection);
    selection.face_role.push_back(role);
    selection.kept.push_back(keep ? 1 : 0);
    selection.face_site.push_back(keep ? -1 : discarding_site(mesh, f, selection));
  }
  return selection;
}

}  // namespace skinforge
