#include <fmt/format.h>

#include "base/parallel.h"
#include "stages/inputs.h"
#include "stages/site_solids.h"
#include "stages/stages.h"
#include "surface/selection.h"

namespace skinforge {
namespace {

// The input's mesh where its source goes; a shift moves each vertex with its joints (Sec. 4.1).
PolygonMesh place_mesh(const Character& character, const Similarity& model_from_input,
                       const std::vector<Vec3>& joint_shift) {
  PolygonMesh mesh = character.mesh;
  if (!model_from_input.is_identity()) {
    for (Vec3& p : mesh.positions) p = model_from_input * p;
    for (Vec3& n : mesh.normals) n = model_from_input.rotation * n;
    for (SplitNormals& split : mesh.split)
      for (auto* normals : {&split.first, &split.second})
        for (Vec3& n : *normals) n = model_from_input.rotation * n;
  }
  if (joint_shift.empty()) return mesh;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    for (const Influence& i : character.weights.of(VertexId(v)))
      mesh.positions[v] += i.weight * joint_shift[i.joint.index()];
  return mesh;
}

// The joints that each operation takes from a source; a donor has lost everything outside its sub-tree from
// the start.
std::vector<Cut> cuts_of_source(const Graft& graft, const Skeleton& skeleton, SourceId source) {
  std::vector<Cut> cuts;
  for (std::size_t k = 0; k < graft.sites.size(); ++k) {
    const GraftSite& site = graft.sites[k];
    std::vector<bool> removed(skeleton.size(), false);
    bool any = false;
    if (site.donor == source) {
      removed = skeleton.subtree(graft.origins[site.fused.index()].joint);
      removed.flip();
      any = true;
    }
    for (const auto& [owner, joint] : site.removed)
      if (owner == source) removed[joint.index()] = any = true;
    if (any) cuts.push_back({k, removed});
  }
  return cuts;
}

/// Presence, preserved faces and secondary components of every source (Sec. 6).
class Select final : public Stage {
 public:
  Select(ArtifactNames names, const Recipe& recipe) : names_(std::move(names)), inputs_(input_names(recipe)) {
    options_.smoothing_passes = recipe.surface.presence_smoothing;
    options_.keep_variance = recipe.surface.keep_or_drop.variance;
    options_.keep_mean = recipe.surface.keep_or_drop.mean;
    field_options_.voxel_factor = recipe.surface.voxel_factor;
  }

  StageInfo info() const override {
    return {.name = "select",
            .version = 1,
            .reads = joined(character_names(names_, inputs_), {names_.placement(), names_.graft()}),
            .writes = {names_.placed(), names_.selection(), names_.groups()}};
  }
  void add_to_key(Hasher& key) const override {
    key.add_value("options", options_);
    key.add_value("field", field_options_);
  }

  void run(const StageInput& in, StageOutput& out, IssueSink& issues) const override {
    const auto characters = get_characters(in, names_, inputs_);
    const auto& placement = in.get<PlacedOperations>(names_.placement());
    const auto& graft = in.get<Graft>(names_.graft());
    std::vector<PolygonMesh> placed;
    std::vector<SourceSelection> selections;
    for (std::size_t s = 0; s < graft.sources.size(); ++s) {
      const GraftSource& source = graft.sources[s];
      const Character& character = *characters[source.input];
      placed.push_back(
          place_mesh(character, source.model_from_input, shift_of(placement, graft, SourceId(s))));
      const std::vector<Cut> cuts = cuts_of_source(graft, character.skeleton, SourceId(s));
      selections.push_back(select_faces(placed.back(), character.weights, cuts, options_,
                                        fmt::format("input {}", inputs_[source.input]), issues));
    }
    out.put(names_.groups(), group_sites(graft, placed, selections, field_options_));
    out.put(names_.placed(), std::move(placed));
    out.put(names_.selection(), std::move(selections));
  }

 private:
  static std::vector<Vec3> shift_of(const PlacedOperations& placement, const Graft& graft, SourceId source) {
    for (std::size_t k = 0; k < graft.sites.size(); ++k)
      if (graft.sites[k].donor == source) return placement.joint_shifts[k];
    return {};
  }

  ArtifactNames names_;
  std::vector<std::string> inputs_;
  SelectionOptions options_;
  FieldOptions field_options_;
};

}  // namespace

StagePointer make_select_stage(const ArtifactNames& names, const Recipe& recipe) {
  return std::make_unique<Select>(names, recipe);
}

}  // namespace skinforge
