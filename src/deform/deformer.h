#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/issue.h"
#include "deform/example_weights.h"
#include "deform/face_context.h"
#include "deform/posed_bones.h"
#include "model/polygon_mesh.h"
#include "skinning/welded_surface.h"

namespace skinforge {

/// The ways to carry a skin along with its bones.
enum class DeformMethod : std::uint8_t {
  Linear,          ///< linear blend skinning, ETH Eq. 3: what engines play
  DualQuaternion,  ///< ETH Eq. 4
  Poisson,         ///< averaged rotations per face, stitched: ETH Eq. 5, 6
  Context,         ///< from examples, per vertex: ETH Eq. 7
  ContextFace,     ///< from examples, per face: ETH Eq. 9
  ContextPolar,    ///< from examples, per face, polar parts apart: ETH Eq. 10
};
inline constexpr int kDeformMethods = 6;

/// "lbs", "dqs", "poisson", "context", "context-face", "context-polar".
std::string_view name_of(DeformMethod method);
bool needs_examples(DeformMethod method);

/// A shape for a pose.
struct DeformExample {
  std::vector<Vec3> shape;  ///< #V
  PosedBones bones;
};

struct DeformOptions {
  std::vector<DeformExample> examples;
  /// The rest pose as one more example without change (ours): then the rest pose gives the rest shape, which
  /// the sheet's Eq. 8 does not, since its weights sum to 1.
  bool with_rest = true;
  RadialKernel kernel = RadialKernel::Linear;
  /// Joints that the distance of poses reads; empty: all but joints without parent (ours: where a character
  /// stands does not change its shape).
  std::vector<std::size_t> joints;
  /// Vertices that Poisson stitching holds, moved as linear blending moves them; empty: those of the first
  /// joint, in skeleton order, that holds at least three vertices alone.
  std::vector<VertexId> held;
};

/// One skin with one method, ready for any number of poses. Refers to nothing outside.
class Deformer {
 public:
  /// `mesh`: rest pose. `weights`: one row a vertex. `options.examples`: at least one for the context
  /// methods; Error (BadInput) where one has another number of vertices. Oddities (parts held on their own,
  /// triangles without area, singular examples) become issues at `place`.
  Deformer(const PolygonMesh& mesh, const Skeleton& skeleton, SkinWeights weights, DeformMethod method,
           DeformOptions options, const std::string& place, IssueSink& issues);

  /// #V, model space.
  std::vector<Vec3> operator()(const PosedBones& bones) const;
  /// a_j of a pose, the rest example last; empty without examples.
  std::vector<double> example_weights(const PosedBones& bones) const;
  /// delta_j of ETH Eq. 7, one list an example, in the order of `example_weights`, the rest example (all
  /// zero) left out. Context methods only.
  const std::vector<std::vector<Vec3>>& example_offsets() const { return offsets_; }
  const ExampleWeights& driver() const { return driver_; }
  const std::vector<std::size_t>& driver_joints() const { return options_.joints; }
  DeformMethod method() const { return method_; }

 private:
  void prepare_examples(const Skeleton& skeleton, const std::string& place, IssueSink& issues);
  void prepare_faces(const PolygonMesh& mesh, const std::string& place, IssueSink& issues);
  std::vector<Vec3> by_vertex(const PosedBones& bones) const;
  std::vector<Vec3> by_face(const PosedBones& bones) const;

  std::vector<Vec3> rest_;
  SkinWeights weights_;
  DeformMethod method_;
  DeformOptions options_;
  ExampleWeights driver_;
  std::vector<std::vector<Vec3>> offsets_;
  WeldedSurface surface_;  ///< of the methods per face: parts that touch are stitched together
  std::unique_ptr<FaceBlend> blend_;
  std::unique_ptr<PoissonStitcher> stitcher_;
  std::unique_ptr<FaceContext> context_;
};

}  // namespace skinforge
