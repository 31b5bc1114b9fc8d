#pragma once

#include <algorithm>
#include <functional>

#include "surface/assemble.h"
#include "surface/junction.h"
#include "surface/shapes.h"

namespace skinforge::testing {

/// Weight `first` on joint 0 and the rest on joint 1.
inline std::vector<Influence> two_joint_row(double first) {
  return normalised_row({{JointId(0), first}, {JointId(1), 1 - first}});
}

/// One input of a scene: its mesh and, per x, the weight on its joint 0, which stays; joint 1 goes.
struct SceneInput {
  PolygonMesh mesh;
  std::function<double(double)> weight = [](double) { return 1.0; };
  bool is_cut = true;
  bool is_host = false;
  bool is_added = false;
  std::vector<double> weights = {};  ///< #V; where given, instead of `weight`
};

/// The steps from placed meshes to the loops of one junction, for site 0, as the build takes them.
struct JunctionScene {
  std::vector<PolygonMesh> meshes;
  std::vector<PreservedSource> sources;
  std::vector<SiteParticipant> participants;
  std::vector<FusionSolid> solids;
  SiteField field;
  KeptSurface kept;
  std::vector<JunctionLoop> loops;
  std::vector<JunctionLoop> arcs;

  Junction junction() const { return build_junction(loops, field, kept); }
};

inline SourceSelection select_input(const SceneInput& input) {
  SkinWeights weights;
  for (std::size_t v = 0; v < input.mesh.vertex_count(); ++v)
    weights.push_row(
        two_joint_row(input.weights.empty() ? input.weight(input.mesh.positions[v].x()) : input.weights[v]));
  std::vector<Cut> cuts;
  if (input.is_cut) cuts.push_back({0, {false, true}, {}, input.is_added});
  IssueSink issues;
  return select_faces(input.mesh, weights, cuts, "scene", issues);
}

/// `contact`: where an added part meets its host.
inline JunctionScene junction_scene(const std::vector<SceneInput>& inputs,
                                    const Vec3& contact = Vec3::Zero()) {
  JunctionScene scene;
  const std::vector<std::size_t> sites = {0};
  for (const SceneInput& input : inputs) scene.meshes.push_back(input.mesh);
  const bool is_addition =
      std::any_of(inputs.begin(), inputs.end(), [](const SceneInput& i) { return i.is_added; });
  for (std::size_t s = 0; s < inputs.size(); ++s) {
    scene.sources.push_back({&scene.meshes[s], select_input(inputs[s])});
    const SourceSelection& selection = scene.sources.back().selection;
    SiteParticipant participant = cut_participant(SourceId(s), selection, sites);
    participant.is_host = inputs[s].is_host;
    participant.is_added = inputs[s].is_added;
    if (is_addition && participant.is_host)
      fuse_component_near(participant, scene.meshes[s], selection, contact);
    scene.solids.push_back(fusion_solid(scene.meshes[s], participant));
    scene.participants.push_back(std::move(participant));
  }
  if (inputs.size() > 1) scene.field = build_site_field(scene.solids, {});
  discard_moved_faces(scene.sources, scene.participants, scene.solids, scene.field, 0, {});
  for (PreservedSource& source : scene.sources) clean_borders(source, {});
  scene.kept = kept_surface(scene.sources);
  for (std::size_t s = 0; s < inputs.size(); ++s)
    for (JunctionLoop& loop :
         loops_of_sites(scene.sources[s], SourceId(s), sites, inputs[s].is_host, scene.arcs))
      scene.loops.push_back(std::move(loop));
  return scene;
}

inline double falling(double x) {
  return std::clamp(0.5 - x / 2, 0.0, 1.0);  // 1 at x = -1, 0 at x = 1
}

/// A host tube that loses its end beyond x = 0 and a thinner donor tube that replaces it. Both reach over the
/// cut; the joined surface is a closed tube from -6 to 6.
inline JunctionScene tubes_end_to_end(double scale = 1) {
  SceneInput host{closed_tube(19, 14, -6, 0.5, 1), falling, true, true};
  SceneInput donor{closed_tube(19, 12, -3, 0.5, 0.8), [](double x) { return falling(-x); }};
  for (SceneInput* input : {&host, &donor}) {
    for (Vec3& p : input->mesh.positions) p *= scale;
    input->weight = [scale, weight = input->weight](double x) { return weight(x / scale); };
  }
  return junction_scene({host, donor});
}

/// A box [-2, 2]^3 and a tube along x that is added to its side: its root lies inside, it stays from x = 2.6
/// on.
inline JunctionScene tube_on_a_box(double scale = 1) {
  SceneInput host{quad_box(8, 2), [](double) { return 1.0; }, false, true};
  SceneInput donor{closed_tube(15, 12, 0.6, 0.4, 0.7), [](double x) { return falling(2 * (2.1 - x)); }, true,
                   false, true};
  for (Vec3& p : donor.mesh.positions) p += Vec3(0, 0.11, -0.07);
  for (SceneInput* input : {&host, &donor}) {
    for (Vec3& p : input->mesh.positions) p *= scale;
    input->weight = [scale, weight = input->weight](double x) { return weight(x / scale); };
  }
  return junction_scene({host, donor}, scale * Vec3(2, 0, 0));
}

}  // namespace skinforge::testing
