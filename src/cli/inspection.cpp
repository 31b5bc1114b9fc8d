#include "cli/inspection.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "cli/commands.h"
#include "diff/structure_diff.h"
#include "diff/surface_diff.h"
#include "geometry/edges.h"

namespace skinforge {
using nlohmann::json;

namespace {
void count_faces(const PolygonMesh& mesh, Inspection& result) {
  result.faces = mesh.face_count();
  result.vertices = mesh.vertex_count();
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const std::size_t corners = mesh.face(FaceId(f)).size();
    ++(corners == 3 ? result.triangles : corners == 4 ? result.quads : result.larger_faces);
  }
}

void count_edges(const PolygonMesh& mesh, Inspection& result) {
  result.components = static_cast<std::size_t>(connected_components(mesh).count);
  for (const Edge& edge : build_edges(mesh).edges) {
    if (edge.half_edges.size() == 1) ++result.open_edges;
    if (edge.half_edges.size() > 2) ++result.edges_of_many_faces;
  }
}

void count_weights(const Character& character, Inspection& result) {
  std::vector<bool> is_used(character.skeleton.size(), false);
  for (const Influence& influence : character.weights.influences) is_used[influence.joint.index()] = true;
  result.influences = count_by_influences(character.weights);
  result.joints_without_weights = static_cast<std::size_t>(std::count(is_used.begin(), is_used.end(), false));
}

// Where a node stands in the file's default pose, metres.
Vec3 default_position(const RawScene& scene, const RawScene::Node& node) {
  Vec3 position = Vec3::Zero();
  for (const RawScene::Node* at = &node;;) {
    position = (at->matrix ? *at->matrix : at->local.matrix()) * position;
    if (at->parent < 0) return scene.metres_from_file * position;
    at = &scene.nodes[static_cast<std::size_t>(at->parent)];
  }
}

void compare_poses(const Character& character, const RawScene& scene, Inspection& result) {
  const std::vector<Affine3> model_from_joint = character.skeleton.model_from_joint();
  for (const RawScene::Node& node : scene.nodes) {
    const auto joint = character.skeleton.find(node.name);
    if (!joint) continue;
    const double distance =
        (default_position(scene, node) - model_from_joint[joint->index()].translation()).norm();
    if (distance <= result.default_pose_distance) continue;
    result.default_pose_distance = distance;
    result.default_pose_joint = node.name;
  }
}

json to_json(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

std::string mesh_text(const Inspection& i, const Character& character) {
  std::string text = fmt::format("mesh       {} vertices, {} faces: {} triangles, {} quads, {} larger\n",
                                 i.vertices, i.faces, i.triangles, i.quads, i.larger_faces);
  text += fmt::format("topology   {} components, {} open edges, {} edges of more than two faces\n",
                      i.components, i.open_edges, i.edges_of_many_faces);
  for (const MeshPart& part : character.mesh.parts)
    text += fmt::format("  part     {}: {} UV sets{}{}\n", printable(part.name), part.uv_sets,
                        part.has_normals ? ", normals" : "", part.has_colors ? ", colours" : "");
  for (const Material& material : character.materials)
    text += fmt::format("  material {}{}\n", printable(material.name),
                        material.base_color_texture ? ", textured" : "");
  for (const Image& image : character.images)
    text += fmt::format("  image    {} ({}, {})\n", printable(image.name), image.mime,
                        readable_size(image.bytes.size()));
  for (const MorphTarget& morph : character.morphs)
    text += fmt::format("  morph    {} ({} vertices)\n", printable(morph.name), morph.vertices.size());
  return text;
}

std::string weights_text(const Inspection& i) {
  std::string text = "weights   ";
  for (std::size_t n = 0; n < i.influences.size(); ++n)
    if (i.influences[n] > 0) text += fmt::format(" {} with {}", i.influences[n], n);
  return text + fmt::format("; {} joints without weights\n", i.joints_without_weights);
}

std::string joints_text(const Skeleton& skeleton) {
  std::string text = fmt::format("joints     {}\n", skeleton.size());
  std::vector<std::size_t> depth(skeleton.size(), 1);
  const auto children = skeleton.children();
  std::vector<JointId> open = {JointId(std::size_t{0})};
  while (!open.empty() && skeleton.size() > 0) {
    const JointId joint = open.back();
    open.pop_back();
    text += std::string(2 * depth[joint.index()], ' ') + printable(skeleton[joint].name) + "\n";
    const auto& below = children[joint.index()];
    for (auto child = below.rbegin(); child != below.rend(); ++child) {
      depth[child->index()] = depth[joint.index()] + 1;
      open.push_back(*child);
    }
  }
  return text;
}

std::string clips_text(const std::vector<Clip>& clips) {
  std::string text = fmt::format("clips      {}\n", clips.size());
  for (const Clip& clip : clips)
    text += fmt::format("  {:<24} {:8.3f} s  {:3} joints  {:6} keys\n", printable(clip.name), clip.duration,
                        clip.joints.size(), key_count(clip));
  return text;
}

json joints_json(const Skeleton& skeleton) {
  json list = json::array();
  for (const Joint& joint : skeleton.joints) {
    const Vec3 at = Vec3(joint.joint_from_model.inverse(Eigen::Affine).translation());
    list.push_back({{"name", joint.name},
                    {"parent", joint.parent.is_valid() ? json(skeleton[joint.parent].name) : json(nullptr)},
                    {"bind_position", to_json(at)}});
  }
  return list;
}

json clips_json(const std::vector<Clip>& clips) {
  json list = json::array();
  for (const Clip& clip : clips)
    list.push_back({{"name", clip.name},
                    {"duration", clip.duration},
                    {"joints", clip.joints.size()},
                    {"keys", key_count(clip)}});
  return list;
}

template <class Items>
json names_json(const Items& items) {
  json list = json::array();
  for (const auto& item : items) list.push_back(item.name);
  return list;
}
}  // namespace

Inspection inspect(const Character& character, const RawScene& scene) {
  Inspection result;
  result.metres_per_unit = scene.metres_from_file.scale;
  compare_poses(character, scene, result);
  count_faces(character.mesh, result);
  count_edges(character.mesh, result);
  count_weights(character, result);
  if (!character.mesh.positions.empty()) result.low = result.high = character.mesh.positions.front();
  for (const Vec3& p : character.mesh.positions) {
    result.low = result.low.cwiseMin(p);
    result.high = result.high.cwiseMax(p);
  }
  return result;
}

std::string inspection_text(const Inspection& i, const Character& character) {
  const Vec3 size = i.high - i.low;
  std::string text =
      fmt::format("{} ({}, sha256 {})\n", printable(i.file), readable_size(i.bytes), i.digest.substr(0, 12));
  text += fmt::format(
      "size       {:.4g} x {:.4g} x {:.4g} m, diagonal {:.4g} m; 1 unit of the file is {:.6g} m\n", size.x(),
      size.y(), size.z(), size.norm(), i.metres_per_unit);
  if (!i.default_pose_joint.empty())
    text +=
        fmt::format("pose       the file's default pose is up to {:.3g} m from the bind pose (joint {})\n",
                    i.default_pose_distance, printable(i.default_pose_joint));
  text += mesh_text(i, character) + weights_text(i) + joints_text(character.skeleton) +
          clips_text(character.clips);
  text += fmt::format("issues     {}\n", i.issues.size());
  for (const Issue& issue : i.issues)
    text += fmt::format("  {} {}: {} [{}]\n", issue.severity == Severity::Warning ? "warning" : "note   ",
                        printable(issue.place), printable(issue.message), issue.code);
  return text;
}

json inspection_json(const Inspection& i, const Character& character) {
  return {
      {"file", i.file},
      {"sha256", i.digest},
      {"bytes", i.bytes},
      {"metres_per_unit", i.metres_per_unit},
      {"box", {{"low", to_json(i.low)}, {"high", to_json(i.high)}, {"diagonal", (i.high - i.low).norm()}}},
      {"mesh",
       {{"vertices", i.vertices},
        {"faces", i.faces},
        {"triangles", i.triangles},
        {"quads", i.quads},
        {"larger_faces", i.larger_faces},
        {"components", i.components},
        {"open_edges", i.open_edges},
        {"edges_of_many_faces", i.edges_of_many_faces},
        {"parts", names_json(character.mesh.parts)},
        {"uv_sets", character.mesh.uvs.size()}}},
      {"weights",
       {{"vertices_by_influences", i.influences}, {"joints_without_weights", i.joints_without_weights}}},
      {"joints", joints_json(character.skeleton)},
      {"clips", clips_json(character.clips)},
      {"materials", names_json(character.materials)},
      {"images", names_json(character.images)},
      {"morphs", names_json(character.morphs)}};
}

}  // namespace skinforge
