#include "report/measures.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

#include "model/character.h"

namespace skinforge {
namespace {

std::int64_t faces_of_size(const PolygonMesh& mesh, std::size_t corners) {
  std::int64_t count = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) count += mesh.face(FaceId(f)).size() == corners ? 1 : 0;
  return count;
}

std::array<double, 3> size_of(const PolygonMesh& mesh) {
  if (mesh.positions.empty()) return {0, 0, 0};
  Eigen::AlignedBox3d box;
  for (const Vec3& p : mesh.positions) box.extend(p);
  const Vec3 size = box.sizes();
  return {size.x(), size.y(), size.z()};
}

template <class Items>
std::int64_t count(const Items& items) {
  return static_cast<std::int64_t>(items.size());
}

}  // namespace

InputReport measure_input(const Character& character) {
  InputReport report;
  report.vertices = count(character.mesh.positions);
  report.faces = static_cast<std::int64_t>(character.mesh.face_count());
  report.quads = faces_of_size(character.mesh, 4);
  report.joints = count(character.skeleton.joints);
  report.clips = count(character.clips);
  report.materials = count(character.materials);
  report.images = count(character.images);
  report.morph_targets = count(character.morphs);
  report.bind_size = size_of(character.mesh);
  return report;
}

MeshReport measure_mesh(const PolygonMesh& mesh, std::int64_t kept_faces) {
  MeshReport report;
  report.vertices = count(mesh.positions);
  report.faces = static_cast<std::int64_t>(mesh.face_count());
  report.quads = faces_of_size(mesh, 4);
  report.triangles = faces_of_size(mesh, 3);
  report.kept_faces = kept_faces;
  report.kept_share =
      report.faces > 0 ? static_cast<double>(kept_faces) / static_cast<double>(report.faces) : 0;
  report.bind_size = size_of(mesh);
  return report;
}

namespace {

void add_cut(std::span<const Influence> row, std::size_t limit, WeightsReport& report) {
  std::vector<double> weights;
  for (const Influence& influence : row) weights.push_back(influence.weight);
  std::sort(weights.begin(), weights.end());  // the least go
  const double gone =
      std::accumulate(weights.begin(), weights.end() - static_cast<std::ptrdiff_t>(limit), 0.0);
  ++report.cut_vertices;
  report.cut_weight_max = std::max(report.cut_weight_max, gone);
}

}  // namespace

WeightsReport measure_weights(const SkinWeights& weights, const Skeleton& skeleton, std::size_t limit) {
  WeightsReport report;
  std::vector<bool> is_used(skeleton.size());
  for (std::size_t v = 0; v < weights.vertex_count(); ++v) {
    const auto full = weights.of(VertexId(v));
    if (full.size() > limit) add_cut(full, limit, report);
    const auto row = full.size() > limit ? normalised_row({full.begin(), full.end()}, limit)
                                         : std::vector(full.begin(), full.end());
    double sum = 0;
    for (const Influence& influence : row) {
      sum += influence.weight;
      is_used[influence.joint.index()] = true;
    }
    report.row_sum_min = v == 0 ? sum : std::min(report.row_sum_min, sum);
    report.row_sum_max = v == 0 ? sum : std::max(report.row_sum_max, sum);
    report.max_influences = std::max(report.max_influences, static_cast<std::int64_t>(row.size()));
    report.unweighted_vertices += row.empty() ? 1 : 0;
  }
  for (std::size_t j = 0; j < skeleton.size(); ++j)
    if (!is_used[j]) report.joints_without_weight.push_back(skeleton.joints[j].name);
  return report;
}

std::int64_t count_keys(const Clip& clip) {
  std::int64_t keys = 0;
  for (const JointTracks& tracks : clip.joints)
    keys += count(tracks.translation.times) + count(tracks.rotation.times) + count(tracks.scale.times);
  for (const MorphTracks& tracks : clip.morphs) keys += count(tracks.weights.times);
  return keys;
}

void set_placement(OperationReport& operation, const Similarity& model_from_input) {
  const Quat& q = model_from_input.rotation;
  const Vec3& t = model_from_input.translation;
  operation.scale = model_from_input.scale;
  operation.rotation_xyzw = {q.x(), q.y(), q.z(), q.w()};
  operation.translation = {t.x(), t.y(), t.z()};
}

}  // namespace skinforge
