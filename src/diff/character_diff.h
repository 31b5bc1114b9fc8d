#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "diff/correspondence.h"
#include "geometry/uv_measures.h"
#include "model/character.h"
#include "render/picture_difference.h"

/// What differs between two characters, A (the reference) and B. Lengths are shares of the diagonal of A's
/// bounding box in the bind pose; diff.md says how each number is found.
namespace skinforge {

/// How many of everything one side has.
struct CharacterCounts {
  std::size_t joints = 0, vertices = 0, faces = 0, triangles = 0, quads = 0, parts = 0, materials = 0,
              images = 0, morphs = 0, clips = 0, keys = 0, uv_sets = 0, influences = 0;  ///< most of a vertex
  std::size_t components = 0, open_edges = 0, non_manifold_edges = 0;
  std::size_t genus = 0, boundary_loops = 0;  ///< of components that are surfaces (geometry/genus.h)
  std::uint64_t bytes = 0;                    ///< of the file
};

struct StructureDiff {
  CharacterCounts a, b;
  /// One sentence each: joints, parents, clips, materials, images, morph targets that one side lacks or has
  /// otherwise.
  std::vector<std::string> edits;
};

/// How far an attribute of corresponding corners differs.
struct CornerDiff {
  double max = 0, mean = 0;
  std::string joint;         ///< heaviest of A at the corner with the largest
  std::size_t compared = 0;  ///< corners
};

struct GeometryDiff {
  /// Distances from the vertices of each side to the surface of the other, in both directions.
  double max = 0, p99 = 0, mean = 0;
  std::size_t unmatched_a = 0, unmatched_b = 0;  ///< vertices without a counterpart near them
  double unchanged = 1;                          ///< share of A's vertices that B has at the same place
  double area_a = 0, area_b = 0;                 ///< square metres
  double volume_a = 0, volume_b = 0;  ///< cubic metres; an open surface is closed to the middle of A's box
  CornerDiff normals_deg;             ///< angle between normals, in [0, 180]
  CornerDiff uvs;                     ///< distance of UVs, all sets; 1 is the edge of the texture
  UvMeasures uv_a, uv_b;              ///< stretch and overlap of the first set
};

struct SkinDiff {
  /// L1 distance of the weights of corresponding vertices, in [0, 2].
  double max = 0, mean = 0;
  std::string joint;                                    ///< heaviest of A at the vertex with the largest
  std::size_t changed = 0;                              ///< vertices beyond 1/255, the step of 8-bit weights
  std::vector<std::size_t> influences_a, influences_b;  ///< vertices that follow 0, 1, 2 ... joints
};

/// One clip that both sides have.
struct ClipDiff {
  std::string clip;
  double duration_a = 0, duration_b = 0;  ///< seconds
  std::size_t keys_a = 0, keys_b = 0;
  bool is_compared = true;     ///< false: A has vertices, and none of them has a counterpart in B
  double max = 0;              ///< largest distance of a skinned vertex
  double rms = 0;              ///< over all vertices and times
  double time = 0;             ///< seconds, of the largest
  std::string joint;           ///< heaviest of A at that vertex
  double joint_max = 0;        ///< largest distance of a joint
  double joint_angle_deg = 0;  ///< largest turn between corresponding joints, model space
  /// Per vertex of A, its largest distance; 0 without counterpart. Empty where nobody asked for it.
  std::vector<float> vertex_max;
};

/// One picture of both, by one camera.
struct PictureDiff {
  std::string camera;  ///< "front", "side", "three-quarter", "back"
  std::string clip;    ///< empty: the bind pose
  double time = 0;     ///< seconds
  PictureDifference difference;
  Raster a, b;  ///< empty unless they were asked for
};

/// "Gallop at 0.583 s, side", "the bind pose, front".
std::string title_of(const PictureDiff& picture);

/// A rule of glTF that a file breaks, by its code (io/gltf_rules.h).
struct BrokenRule {
  std::string code;
  bool is_error = true;  ///< else a warning
  std::size_t count = 0;
};

/// How often both files break one rule.
struct RuleDelta {
  std::string code;
  bool is_error = true;
  std::size_t in_a = 0, in_b = 0;
};

/// What a file says beside its character.
struct FileFacts {
  std::uint64_t bytes = 0;
  std::string provenance = {};  ///< JSON text of what it was made of; empty: it does not say
  std::optional<std::vector<BrokenRule>> broken = {};  ///< none: there are no rules for its format
};

struct CharacterDiff {
  double diagonal = 0;  ///< metres, of A
  Correspondence same;
  StructureDiff structure;
  std::vector<std::string> provenance;  ///< one sentence for each thing that they were made of otherwise
  std::vector<RuleDelta> rules;         ///< broken a different number of times
  GeometryDiff geometry;
  SkinDiff skin;
  std::vector<ClipDiff> clips;        ///< in A's order
  std::vector<PictureDiff> pictures;  ///< by `compare_pictures`; none where nobody asked for them
  bool is_drawn_alike = false;        ///< there are none because no picture could differ (`draw_alike`)

  /// The clip with the largest error; null when there is none.
  const ClipDiff* worst_clip() const;
  /// The picture of which most changed, of those alike the least similar; null when there is none.
  const PictureDiff* worst_picture() const;
};

struct DiffOptions {
  FileFacts a = {}, b = {};     ///< of both files
  bool wants_vertices = false;  ///< fill in ClipDiff::vertex_max, for which every vertex is posed
};

/// Compares two sound characters. Both may be anything; without a mesh the distances are 0. Parallel over
/// clips and vertices, same result for any number of threads.
CharacterDiff compare_characters(const Character& a, const Character& b, const DiffOptions& options = {});

/// What is still the same: shares of the diagonal, weights in [0, 2], seconds. Above it is a difference.
struct DiffThresholds {
  double geometry = 1e-5;   ///< ours: ten times what 32-bit floats leave of a character of metres
  double normals = 1;       ///< degrees; ours: twice what 8-bit normals leave
  double uv = 1e-3;         ///< ours: a texel of a texture of 1024
  double weights = 0.01;    ///< ours: two steps of 8-bit weights
  double animation = 5e-4;  ///< ours: a millimetre on a man; the eye begins to see twice that
  double duration = 1e-3;   ///< ours: a sixteenth of a frame at 60 Hz
  double picture = 1e-3;    ///< PictureDifference::changed; ours: a dozen pixels of a body
  bool structure = true;    ///< whether an edit of the structure is one
};

/// One verdict: what was measured against which threshold.
struct DiffFinding {
  std::string group;  ///< "structure", "geometry", "skin", "animation", "picture"
  std::string name;   ///< "surface distance", "clip Gallop"
  std::string text;   ///< one sentence with values
  bool is_over = false;
};

/// All verdicts in the order of the groups; those that are over first decide about exit 5.
std::vector<DiffFinding> judge(const CharacterDiff& diff, const DiffThresholds& thresholds);
bool is_over(const std::vector<DiffFinding>& findings);

}  // namespace skinforge
