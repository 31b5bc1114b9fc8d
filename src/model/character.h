#pragma once

#include <string>
#include <vector>

#include "model/clip.h"
#include "model/material.h"
#include "model/polygon_mesh.h"
#include "model/skeleton.h"
#include "model/skin_weights.h"

namespace skinforge {

/// A shape that a part can be pushed towards. Sparse: only vertices that move.
struct MorphTarget {
  std::string name;
  PartId part;
  double default_weight = 0;
  std::vector<VertexId> vertices;  ///< rising
  std::vector<Vec3> offsets;       ///< metres, model space, bind pose; one per vertex in `vertices`

  template <class Archive>
  friend void fields(Archive& a, MorphTarget& t) {
    a(t.name, t.part, t.default_weight, t.vertices, t.offsets);
  }
};

/// The tuple (M, W, S, A) of SkinMixer Sec. 1.1 with its materials: plain data, metres, Y up, right-handed,
/// seconds, radians. The rest geometry is the bind pose.
struct Character {
  std::string name;
  PolygonMesh mesh;
  SkinWeights weights;  ///< one row per vertex
  Skeleton skeleton;
  std::vector<Clip> clips;
  std::vector<Material> materials;
  std::vector<Image> images;
  std::vector<MorphTarget> morphs;  ///< sorted by part

  template <class Archive>
  friend void fields(Archive& a, Character& c) {
    a(c.name, c.mesh, c.weights, c.skeleton, c.clips, c.materials, c.images, c.morphs);
  }
};

/// Checks every promise that the types of the tuple make: indices in range, finite numbers, parents before
/// children, one root, unique names, rows of weights normal, key times rising, matching counts. Throws
/// `Error` (BadInput) that names the first broken one. Nobody behind this door checks again. Linear.
void validate(const Character& character);

}  // namespace skinforge
