#include "deform/deformer.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/expect.h"
#include "deform/dual_quaternion_blend.h"
#include "deform/unposing.h"
#include "skinning/linear_blend.h"

namespace skinforge {
namespace {

constexpr double kAlone = 0.999;        // ours: float weights of a joint that has a vertex for itself
constexpr std::size_t kEnoughHeld = 3;  // ours: fewer cannot hold a surface without turning

bool is_per_face(DeformMethod method) {
  return method == DeformMethod::Poisson || method == DeformMethod::ContextFace ||
         method == DeformMethod::ContextPolar;
}

// Vertices that follow the first joint with at least three such vertices; else those of the joint with most.
std::vector<VertexId> held_by_first_joint(const SkinWeights& weights, std::size_t joints) {
  std::vector<std::vector<VertexId>> alone(joints);
  for (std::size_t v = 0; v < weights.vertex_count(); ++v) {
    const auto row = weights.of(VertexId(v));
    if (row.empty()) continue;
    const Influence& most = largest_influence(row);
    if (most.weight > kAlone) alone[most.joint.index()].emplace_back(v);
  }
  for (const auto& vertices : alone)
    if (vertices.size() >= kEnoughHeld) return vertices;
  return *std::max_element(alone.begin(), alone.end(),
                           [](const auto& a, const auto& b) { return a.size() < b.size(); });
}

std::vector<Quat> rotations_of(std::span<const RigidMotion> motions) {
  std::vector<Quat> rotations;
  for (const RigidMotion& motion : motions) rotations.push_back(motion.rotation);
  return rotations;
}

}  // namespace

std::string_view name_of(DeformMethod method) {
  constexpr std::array<std::string_view, kDeformMethods> kNames{"lbs",     "dqs",          "poisson",
                                                                "context", "context-face", "context-polar"};
  return kNames[static_cast<std::size_t>(method)];
}

bool needs_examples(DeformMethod method) {
  return method >= DeformMethod::Context;
}

Deformer::Deformer(const PolygonMesh& mesh, const Skeleton& skeleton, SkinWeights weights,
                   DeformMethod method, DeformOptions options, const std::string& place, IssueSink& issues)
    : rest_(mesh.positions), weights_(std::move(weights)), method_(method), options_(std::move(options)) {
  SF_EXPECT(weights_.vertex_count() == rest_.size());
  if (options_.held.empty()) options_.held = held_by_first_joint(weights_, skeleton.size());
  if (needs_examples(method_)) prepare_examples(skeleton, place, issues);
  if (is_per_face(method_)) prepare_faces(mesh, place, issues);
}

void Deformer::prepare_examples(const Skeleton& skeleton, const std::string& place, IssueSink& issues) {
  if (options_.examples.empty())
    throw Error(ExitCode::Usage, fmt::format("{}: method \"{}\" needs examples", place, name_of(method_)));
  if (options_.joints.empty())
    for (std::size_t j = 0; j < skeleton.size(); ++j)
      if (skeleton.joints[j].parent.is_valid() || skeleton.size() == 1) options_.joints.push_back(j);
  std::vector<Eigen::VectorXd> points;
  std::size_t damped = 0;
  for (std::size_t j = 0; j < options_.examples.size(); ++j) {
    const DeformExample& example = options_.examples[j];
    if (example.shape.size() != rest_.size())
      throw Error(ExitCode::BadInput, fmt::format("{}: example {} has {} vertices, the mesh {}", place, j + 1,
                                                  example.shape.size(), rest_.size()));
    points.push_back(pose_point(example.bones.local, options_.joints));
    Unposed unposed = unpose(rest_, example.shape, weights_, example.bones.palette);
    damped += unposed.damped.size();
    offsets_.push_back(std::move(unposed.offsets));
  }
  if (options_.with_rest)
    points.push_back(pose_point(std::vector<Quat>(skeleton.size(), Quat::Identity()), options_.joints));
  driver_ = ExampleWeights(points, options_.kernel);
  if (driver_.distinct() < points.size())
    issues.warn("examples-merged", place,
                fmt::format("{} examples stand in a pose that another one has, too: they share its weight",
                            points.size() - driver_.distinct()));
  if (damped > 0)
    issues.warn(
        "examples-singular", place,
        fmt::format("{} vertices of examples have a nearly singular blended matrix (half turns against each "
                    "other): they come back only as near as a damped inverse allows",
                    damped));
}

void Deformer::prepare_faces(const PolygonMesh& mesh, const std::string& place, IssueSink& issues) {
  surface_ = weld_surface(rest_, triangulate(mesh).triangles, &weights_);
  std::vector<VertexId> held;
  for (const VertexId v : options_.held) held.push_back(surface_.welded[v.index()]);
  blend_ = std::make_unique<FaceBlend>(surface_.triangles, surface_.gather(weights_));
  stitcher_ = std::make_unique<PoissonStitcher>(surface_.positions, surface_.triangles, held);
  if (stitcher_->added() > 0)
    issues.note(
        "stitch-parts-held", place,
        fmt::format("{} parts of the surface have no held vertex: one vertex of each follows linear blending",
                    stitcher_->added()));
  if (stitcher_->degenerate() > 0)
    issues.warn("triangles-without-area", place,
                fmt::format("{} triangles have no area and count as equilateral", stitcher_->degenerate()));
  if (method_ == DeformMethod::Poisson) return;
  std::vector<std::vector<Vec3>> shapes;
  std::vector<std::vector<Quat>> rotations;
  for (const DeformExample& example : options_.examples) {
    shapes.push_back(surface_.gather(example.shape));
    rotations.push_back(rotations_of(example.bones.motions));
  }
  if (options_.with_rest) {
    shapes.push_back(surface_.positions);
    rotations.emplace_back(rotations.front().size(), Quat::Identity());
  }
  context_ = std::make_unique<FaceContext>(*stitcher_, *blend_, surface_.positions, surface_.triangles,
                                           shapes, rotations);
}

std::vector<double> Deformer::example_weights(const PosedBones& bones) const {
  if (!needs_examples(method_)) return {};
  return driver_(pose_point(bones.local, options_.joints));
}

std::vector<Vec3> Deformer::by_vertex(const PosedBones& bones) const {
  const std::vector<double> a = example_weights(bones);
  std::vector<Vec3> offset = rest_;
  for (std::size_t j = 0; j < offsets_.size(); ++j)
    for (std::size_t v = 0; v < offset.size(); ++v) offset[v] += a[j] * offsets_[j][v];
  return linear_blend(offset, weights_, bones.palette);
}

std::vector<Vec3> Deformer::by_face(const PosedBones& bones) const {
  const std::vector<Quat> rotations = blend_->rotations(rotations_of(bones.motions));
  if (context_) {
    const auto kind = method_ == DeformMethod::ContextFace ? FaceContextKind::Linear : FaceContextKind::Polar;
    return surface_.spread(stitcher_->stitch(context_->maps(rotations, example_weights(bones), kind),
                                             surface_.gather(by_vertex(bones))));
  }
  std::vector<Mat3> maps;
  maps.reserve(rotations.size());
  for (const Quat& rotation : rotations) maps.push_back(rotation.toRotationMatrix());
  const std::vector<Vec3> places = linear_blend(rest_, weights_, bones.palette);
  return surface_.spread(stitcher_->stitch(maps, surface_.gather(places)));
}

std::vector<Vec3> Deformer::operator()(const PosedBones& bones) const {
  switch (method_) {
    case DeformMethod::Linear:
      return linear_blend(rest_, weights_, bones.palette);
    case DeformMethod::DualQuaternion:
      return dual_quaternion_blend(rest_, weights_, bones.motions);
    case DeformMethod::Context:
      return by_vertex(bones);
    default:
      return by_face(bones);
  }
}

}  // namespace skinforge
