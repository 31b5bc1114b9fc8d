#include "animation/morphing.h"

#include <algorithm>

#include "animation/sampling.h"

namespace skinforge {
namespace {

// The first part that a face of each vertex is in; invalid for vertices without faces.
std::vector<PartId> first_parts(const PolygonMesh& mesh) {
  std::vector<PartId> part(mesh.vertex_count());
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    for (const VertexId v : mesh.face(FaceId(f))) {
      PartId& first = part[v.index()];
      if (!first.is_valid() || mesh.face_part[f] < first) first = mesh.face_part[f];
    }
  return part;
}

// The weights of a part's targets; empty where the clip does not drive them.
std::vector<double> driven_weights(const Clip& clip, PartId part, double time) {
  const auto tracks = std::find_if(clip.morphs.begin(), clip.morphs.end(),
                                   [&](const MorphTracks& m) { return m.part == part; });
  if (tracks == clip.morphs.end() || tracks->weights.is_empty()) return {};
  return sample(tracks->weights, time);
}

}  // namespace

std::vector<Vec3> morphed_positions(const Character& character, const Clip& clip, double time) {
  std::vector<Vec3> positions = character.mesh.positions;
  if (character.morphs.empty()) return positions;
  const std::vector<PartId> part_of = first_parts(character.mesh);
  std::vector<double> driven;
  std::size_t in_part = 0;
  for (std::size_t i = 0; i < character.morphs.size(); ++i) {
    const MorphTarget& target = character.morphs[i];
    const bool is_first = i == 0 || character.morphs[i - 1].part != target.part;
    if (is_first) driven = driven_weights(clip, target.part, time);
    in_part = is_first ? 0 : in_part + 1;
    const double weight = in_part < driven.size() ? driven[in_part] : target.default_weight;
    for (std::size_t k = 0; k < target.vertices.size() && weight != 0; ++k)
      if (part_of[target.vertices[k].index()] == target.part)
        positions[target.vertices[k].index()] += weight * target.offsets[k];
  }
  return positions;
}

}  // namespace skinforge
