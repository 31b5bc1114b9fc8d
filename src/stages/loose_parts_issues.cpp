#include "stages/loose_parts_issues.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "surface/loose_parts.h"

namespace skinforge {
namespace {

// What is loose at one operation.
struct Found {
  std::size_t faces = 0;
  std::set<JointId> joints;
};

void add(Found& found, const LoosePart& part) {
  found.faces += part.faces;
  found.joints.insert(part.joints.begin(), part.joints.end());
}

std::string names_of(const Skeleton& skeleton, const std::set<JointId>& joints) {
  std::string text;
  for (const JointId joint : joints)
    text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", skeleton[joint].name);
  return text;
}

// The nearest joint above all of them and `top`.
JointId common_ancestor(const Skeleton& skeleton, JointId top, const std::set<JointId>& joints) {
  for (; skeleton[top].parent.is_valid(); top = skeleton[top].parent) {
    const std::vector<bool> below = skeleton.subtree(top);
    if (std::all_of(joints.begin(), joints.end(), [&](JointId j) { return below[j.index()]; })) break;
  }
  return top;
}

// Where each operation cuts this source as a host.
std::vector<JointId> tops_of_host(const Graft& graft, SourceId source) {
  std::vector<JointId> tops;
  for (const GraftSite& site : graft.sites)
    if (site.kind == GraftKind::Replace || site.kind == GraftKind::Remove)
      for (const auto& [owner, joint] : site.at)
        if (owner == source) tops.push_back(joint);
  return tops;
}

// Faces that the cut of one operation alone does not keep whole.
FaceSet outside(const PolygonMesh& mesh, const std::vector<double>& presence) {
  FaceSet faces;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(FaceId(f));
    faces.push_back(
        std::any_of(face.begin(), face.end(), [&](VertexId v) { return presence[v.index()] < 1; }));
  }
  return faces;
}

void tell_left_behind(const Graft& graft, SourceId source, const Character& character,
                      const SourceSelection& selection, const std::string& input, IssueSink& issues) {
  const std::vector<JointId> tops = tops_of_host(graft, source);
  if (tops.empty()) return;
  std::map<std::int32_t, Found> of_site;
  for (const LoosePart& part :
       loose_parts(character.mesh, character.weights, character.skeleton, selection.kept, tops))
    add(of_site[selection.face_site[part.beside.index()]], part);
  for (const auto& [site, found] : of_site)
    issues.warn(
        "part-left-behind", fmt::format("op {}", site + 1),
        fmt::format("{} faces of {} stay in the air: they hang on {}, outside of what goes; add {} to \"at\"",
                    found.faces, input, names_of(character.skeleton, found.joints),
                    found.joints.size() == 1 ? "it" : "them"));
}

void tell_left_out(const Graft& graft, SourceId source, const Character& character,
                   const SourceSelection& selection, const std::string& input, IssueSink& issues) {
  for (std::size_t c = 0; c < selection.cut_sites.size(); ++c) {
    const std::size_t k = selection.cut_sites[c];
    const GraftSite& site = graft.sites[k];
    const bool is_donor = site.donor == source;
    if (!is_donor && !(site.kind == GraftKind::Detach && site.host == source)) continue;
    if (!site.fused.is_valid()) continue;  // gone again by a later operation
    const JointId top = graft.origins[site.fused.index()].joint;
    Found found;
    for (const LoosePart& part :
         loose_parts(character.mesh, character.weights, character.skeleton,
                     outside(character.mesh, selection.site_presence[c]), std::vector<JointId>{top}))
      add(found, part);
    if (found.faces == 0) continue;
    const JointId above = common_ancestor(character.skeleton, top, found.joints);
    issues.warn(
        "part-left-out", fmt::format("op {}", k + 1),
        fmt::format(
            "{} faces of {} do not come along: they hang on {}, not below \"{}\"; \"{}\" is above both",
            found.faces, input, names_of(character.skeleton, found.joints), character.skeleton[top].name,
            character.skeleton[above].name));
  }
}

}  // namespace

void tell_loose_parts(const Graft& graft, SourceId source, const Character& character,
                      const SourceSelection& selection, const std::string& input, IssueSink& issues) {
  tell_left_behind(graft, source, character, selection, input, issues);
  tell_left_out(graft, source, character, selection, input, issues);
}

}  // namespace skinforge
