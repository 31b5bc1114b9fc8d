#include <fmt/format.h>

#include <map>
#include <set>

#include "geometry/edges.h"
#include "skinning/weight_transfer.h"
#include "stages/inputs.h"
#include "stages/material_merge.h"
#include "stages/placed_surfaces.h"
#include "stages/stages.h"

namespace skinforge {
namespace {

std::vector<SourceSurface> source_surfaces(const PlacedSurfaces& sources,
                                           const std::vector<const Character*>& characters,
                                           const Graft& graft, const std::vector<SourceSelection>& selections,
                                           const std::vector<JointMap>& maps) {
  std::vector<SourceSurface> surfaces;
  for (std::size_t s = 0; s < graft.sources.size(); ++s)
    surfaces.push_back({sources.mesh(s).positions, &sources.triangles(s), &sources.bvh(s),
                        selections[s].presence, &characters[graft.sources[s].input]->weights, &maps[s],
                        false});
  for (const GraftSite& site : graft.sites)
    if (site.kind == GraftKind::Attach) surfaces[site.donor.index()].attached = true;
  return surfaces;
}

// Morph targets of every source on the vertices that stayed.
std::vector<MorphTarget> carried_morphs(const std::vector<const Character*>& characters, const Graft& graft,
                                        const JoinedSurface& joined) {
  std::vector<std::map<VertexId, VertexId>> result_of(graft.sources.size());
  for (std::size_t v = 0; v < joined.vertices.size(); ++v) {
    const ResultVertex& origin = joined.vertices[v];
    if (origin.source.is_valid()) result_of[origin.source.index()][origin.vertex] = VertexId(v);
  }
  std::vector<MorphTarget> morphs;
  for (std::size_t s = 0; s < graft.sources.size(); ++s) {
    const GraftSource& source = graft.sources[s];
    const Mat3 linear = source.model_from_input.matrix().linear();
    for (const MorphTarget& target : characters[source.input]->morphs) {
      MorphTarget carried{
          target.name, PartId(joined.first_part[s].value + target.part.value), target.default_weight, {}, {}};
      std::map<VertexId, Vec3> offsets;
      for (std::size_t i = 0; i < target.vertices.size(); ++i)
        if (const auto found = result_of[s].find(target.vertices[i]); found != result_of[s].end())
          offsets[found->second] = linear * target.offsets[i];
      for (const auto& [vertex, offset] : offsets)
        carried.vertices.push_back(vertex), carried.offsets.push_back(offset);
      morphs.push_back(std::move(carried));
    }
  }
  return morphs;
}

/// W_R and the other attributes (Sec. 7): the result but for its clips and the colour of its junctions.
class Bind final : public Stage {
 public:
  Bind(ArtifactNames names, const Recipe& recipe)
      : names_(std::move(names)), inputs_(input_names(recipe)), name_(recipe.name) {
    options_.influences = static_cast<std::size_t>(recipe.output.influences);
  }

  StageInfo info() const override {
    return {.name = "bind",
            .version = 1,
            .reads = joined(
                character_names(names_, inputs_),
                {names_.graft(), names_.joint_maps(), names_.placed(), names_.selection(), names_.surface()}),
            .writes = {names_.bound(), names_.shares(), names_.weight_record()}};
  }
  void add_to_key(Hasher& key) const override {
    key.add("name", name_);
    key.add_value("influences", options_.influences);
  }

  void run(const StageInput& in, StageOutput& out, IssueSink& issues) const override {
    const auto characters = get_characters(in, names_, inputs_);
    const auto& graft = in.get<Graft>(names_.graft());
    const auto& joined_surface = in.get<SurfaceResult>(names_.surface()).joined;
    Character bound;
    bound.name = name_;
    bound.skeleton = graft.skeleton;
    bound.mesh = joined_surface.mesh;
    const PlacedSurfaces sources(in.get<std::vector<PolygonMesh>>(names_.placed()));
    std::vector<VertexOrigin> origins;
    for (const ResultVertex& v : joined_surface.vertices) origins.push_back({v.source, v.vertex});
    const VertexGraph graph = build_vertex_graph(joined_surface.mesh);
    const ResultSurface result{joined_surface.mesh.positions, origins, &graph};
    const std::vector<SourceSurface> surfaces =
        source_surfaces(sources, characters, graft, in.get<std::vector<SourceSelection>>(names_.selection()),
                        in.get<std::vector<JointMap>>(names_.joint_maps()));
    JunctionShares shares = junction_shares(result, surfaces);
    TransferredWeights transferred = transfer_weights(result, surfaces, shares, options_);
    if (transferred.filled_rows > 0)
      issues.warn("weights-filled", "result",
                  fmt::format("{} vertices had no joint left and took the weights of a neighbour",
                              transferred.filled_rows));
    bound.weights = std::move(transferred.weights);
    out.put(names_.shares(), std::move(shares.factor));
    out.put(names_.weight_record(),
            WeightRecord{transferred.blended, transferred.steps, transferred.filled_rows});
    bound.morphs = carried_morphs(characters, graft, joined_surface);
    merge_materials(bound, characters, inputs_, input_of_faces(graft, joined_surface));
    out.put(names_.bound(), std::move(bound));
  }

 private:
  static std::vector<std::int32_t> input_of_faces(const Graft& graft, const JoinedSurface& surface) {
    std::vector<std::int32_t> inputs;
    for (const ResultFace& face : surface.faces)
      inputs.push_back(
          face.source.is_valid() ? static_cast<std::int32_t>(graft.sources[face.source.index()].input) : -1);
    return inputs;
  }

  ArtifactNames names_;
  std::vector<std::string> inputs_;
  std::string name_;
  WeightTransferOptions options_;
};

}  // namespace

StagePointer make_bind_stage(const ArtifactNames& names, const Recipe& recipe) {
  return std::make_unique<Bind>(names, recipe);
}

}  // namespace skinforge
