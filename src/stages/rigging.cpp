#include "stages/rigging.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.h"
#include "base/text.h"
#include "geometry/triangle_bvh.h"
#include "io/file_kind.h"
#include "io/number_table.h"
#include "io/plain_mesh.h"
#include "io/tgf_reader.h"
#include "skeleton/bone_rig.h"
#include "skeleton/pose.h"

namespace skinforge {
namespace {

constexpr double kSamePlace = 1e-5;   // ours: of the diagonal; importers keep float positions
constexpr double kTargetSeconds = 1;  // ours: a pose to go to is reached after this

bool is_plain(const std::string& path) {
  const std::string extension = lower_extension(path);
  return extension == ".obj" || extension == ".off";
}

// Vertex of the character nearest to each vertex of the file; importers weld and reorder.
std::vector<VertexId> match_vertices(const std::vector<Vec3>& file, const PolygonMesh& mesh) {
  std::vector<std::array<std::int32_t, 3>> points;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    points.push_back(
        {static_cast<std::int32_t>(v), static_cast<std::int32_t>(v), static_cast<std::int32_t>(v)});
  const TriangleBvh bvh(mesh.positions, points);
  std::vector<VertexId> matched;
  for (std::size_t i = 0; i < file.size(); ++i) {
    const ClosestPoint found = bvh.closest(file[i]);
    if (found.triangle < 0 || found.distance > kSamePlace * mesh.diagonal())
      throw Error(ExitCode::BadInput,
                  fmt::format("vertex {} of the file is no vertex of the imported model", i));
    matched.emplace_back(found.triangle);
  }
  return matched;
}

// The skeleton of a .tgf, or that of a model with its clips.
void take_skeleton(const std::vector<InputFile>& files, Rigged& rigged, IssueSink& issues) {
  const std::string& path = files.front().path;
  Character& character = rigged.character;
  character.clips.clear();
  if (lower_extension(path) == ".tgf") {
    const BoneGraph graph = read_tgf(files.front());
    const BoneForest forest = with_context(printable(path), [&] { return make_bone_forest(graph); });
    BoneRig rig = make_bone_rig(forest);
    character.skeleton = std::move(rig.skeleton);
    rigged.joint_of_bone = std::move(rig.joint_of_bone);
    return;
  }
  Character model = build_character(read_scene(files), path, issues);
  character.skeleton = std::move(model.skeleton);
  character.clips = std::move(model.clips);
  for (Clip& clip : character.clips) clip.morphs.clear();
  rigged.joint_of_bone.clear();
  for (std::size_t j = 0; j < character.skeleton.size(); ++j) rigged.joint_of_bone.emplace_back(j);
}

std::string free_clip_name(const Character& character, const std::string& wanted) {
  std::set<std::string> taken;
  for (const Clip& clip : character.clips) taken.insert(clip.name);
  std::string name = wanted;
  for (int n = 2; taken.contains(name); ++n) name = fmt::format("{}_{}", wanted, n);
  return name;
}

RotationFrames read_frames(const InputFile& file, const Rigged& rigged) {
  const Eigen::MatrixXd table = read_dmat(file);
  return with_context(printable(file.path),
                      [&] { return rotation_frames(table, rigged.joint_of_bone.size()); });
}

void add_clip(const InputFile& file, double rate_hz, Rigged& rigged, IssueSink& issues) {
  const std::string stem = std::filesystem::path(file.path).stem().string();
  const RotationFrames frames = read_frames(file, rigged);
  const BoneRig rig{rigged.character.skeleton, rigged.joint_of_bone};
  const std::string name = free_clip_name(rigged.character, stem);
  const bool is_target = stem.ends_with("_target") && frames.frames.size() == 1;
  rigged.character.clips.push_back(is_target ? clip_to_target(rig, frames, name, kTargetSeconds)
                                             : clip_of_frames(rig, frames, name, rate_hz));
  if (frames.flips > 0)
    issues.note(
        "rotation-signs-flipped", printable(file.path),
        fmt::format("{} quaternions lay on the other side of the frame before (q and -q are one rotation): "
                    "negated",
                    frames.flips));
  if (frames.normalised > 0)
    issues.warn(
        "rotations-normalised", printable(file.path),
        fmt::format("{} rotations were off by more than 1e-5; brought to the nearest", frames.normalised));
}

BindOptions bind_options(const RecipeBind& bind, const Rigged& rigged) {
  BindOptions options;
  options.method = bind.method == RecipeBindMethod::Heat ? BindMethod::Heat : BindMethod::Harmonic;
  options.rule = {bind.handle_factor, static_cast<std::size_t>(bind.handle_least)};
  options.heat.resolution = bind.resolution;
  options.handles = rigged.handles;
  return options;
}

Handles handles_of_json(const InputFile& file, const Rigged& rigged) {
  const auto json = nlohmann::json::parse(file.bytes.begin(), file.bytes.end(), nullptr, false, true);
  if (!json.is_object()) throw Error(ExitCode::BadInput, "expected an object {\"joint\": [vertices]}");
  const Skeleton& skeleton = rigged.character.skeleton;
  Handles handles(rigged.character.mesh.vertex_count());
  for (const auto& [name, vertices] : json.items()) {
    const auto joint = skeleton.find(name);
    if (!joint)
      throw Error(ExitCode::BadInput,
                  fmt::format("no joint \"{}\"{}", printable(name), nearest_hint(name, skeleton.names())));
    if (!vertices.is_array())
      throw Error(ExitCode::BadInput, fmt::format("\"{}\": expected a list", printable(name)));
    for (const auto& v : vertices) {
      if (!v.is_number_unsigned() || v.get<std::size_t>() >= rigged.vertex_of_file.size())
        throw Error(ExitCode::BadInput, fmt::format("\"{}\": vertices are numbers from 0 to {}",
                                                    printable(name), rigged.vertex_of_file.size() - 1));
      JointId& held = handles[rigged.vertex_of_file[v.get<std::size_t>()].index()];
      if (held.is_valid() && held != *joint)
        throw Error(ExitCode::BadInput, fmt::format("vertex {} is held by \"{}\" and by \"{}\"",
                                                    v.get<std::size_t>(), skeleton[held].name, name));
      held = *joint;
    }
  }
  return handles;
}

void expect_file_order(const Rigged& rigged) {
  if (rigged.vertex_of_file.empty())
    throw Error(ExitCode::BadInput, "goes by the vertices of an .obj or .off; the model is neither");
}

}  // namespace

Handles read_handles(const InputFile& file, const Rigged& rigged) {
  const bool is_json = lower_extension(file.path) == ".json";
  const Eigen::MatrixXd table = is_json ? Eigen::MatrixXd() : read_dmat(file);
  return with_context(printable(file.path), [&] {
    expect_file_order(rigged);
    if (is_json) return handles_of_json(file, rigged);
    const Handles of_file = handles_of_labels(table, rigged.vertex_of_file.size(), rigged.joint_of_bone);
    Handles handles(rigged.character.mesh.vertex_count());
    for (std::size_t i = 0; i < of_file.size(); ++i)
      if (of_file[i].is_valid()) handles[rigged.vertex_of_file[i].index()] = of_file[i];
    return handles;
  });
}

Rigged read_rigged(const RigFiles& files, const RecipeBind& bind, IssueSink& issues) {
  Rigged rigged;
  const std::string& path = files.model.front().path;
  rigged.character = build_character(read_scene(files.model), path, issues);
  if (is_plain(path)) {
    const std::vector<Vec3> positions = read_plain_mesh(files.model.front()).positions;
    rigged.vertex_of_file =
        with_context(printable(path), [&] { return match_vertices(positions, rigged.character.mesh); });
  }
  if (rigged.character.skeleton.size() > 1)
    issues.warn("bind-replaces-skin", printable(path),
                fmt::format("{} joints of the model, its weights and its clips give way to the new ones",
                            rigged.character.skeleton.size()));
  take_skeleton(files.skeleton, rigged, issues);
  for (const InputFile& poses : files.poses) add_clip(poses, bind.rate_hz, rigged, issues);
  if (files.handles) rigged.handles = read_handles(*files.handles, rigged);
  if (bind.from_groups)
    rigged.handles = with_context(
        printable(path), [&] { return handles_of_groups(rigged.character.mesh, rigged.character.skeleton); });
  BoundSkin skin = bind_skin(rigged.character.mesh, rigged.character.skeleton, bind_options(bind, rigged),
                             printable(path), issues);
  rigged.character.weights = std::move(skin.weights);
  rigged.handles = std::move(skin.handles);
  validate(rigged.character);
  return rigged;
}

Pose read_pose(const InputFile& file, const Rigged& rigged) {
  const RotationFrames frames = read_frames(file, rigged);
  if (frames.frames.size() != 1)
    throw Error(ExitCode::BadInput,
                fmt::format("{}: {} frames; a pose has one", printable(file.path), frames.frames.size()));
  Pose pose = bind_pose(rigged.character.skeleton);
  for (std::size_t k = 0; k < rigged.joint_of_bone.size(); ++k)
    pose[rigged.joint_of_bone[k].index()].rotation = frames.frames[0][k];
  return pose;
}

std::vector<Vec3> read_shape(const InputFile& file, const Rigged& rigged) {
  const std::vector<Vec3> positions = read_plain_mesh(file).positions;
  return with_context(printable(file.path), [&] {
    expect_file_order(rigged);
    if (positions.size() != rigged.vertex_of_file.size())
      throw Error(ExitCode::BadInput, fmt::format("{} vertices, the model has {}", positions.size(),
                                                  rigged.vertex_of_file.size()));
    std::vector<Vec3> shape = rigged.character.mesh.positions;
    for (std::size_t i = 0; i < positions.size(); ++i) shape[rigged.vertex_of_file[i].index()] = positions[i];
    return shape;
  });
}

Eigen::MatrixXd weight_table(const Rigged& rigged) {
  std::vector<Eigen::Index> column(rigged.character.skeleton.size(), -1);
  for (std::size_t k = 0; k < rigged.joint_of_bone.size(); ++k)
    column[rigged.joint_of_bone[k].index()] = static_cast<Eigen::Index>(k);
  std::vector<VertexId> rows = rigged.vertex_of_file;
  for (std::size_t v = 0; rows.size() < rigged.character.mesh.vertex_count() && rigged.vertex_of_file.empty();
       ++v)
    rows.emplace_back(v);
  Eigen::MatrixXd table = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows.size()),
                                                static_cast<Eigen::Index>(rigged.joint_of_bone.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const Influence& w : rigged.character.weights.of(rows[i]))
      if (column[w.joint.index()] >= 0)
        table(static_cast<Eigen::Index>(i), column[w.joint.index()]) = w.weight;
  return table;
}

Eigen::MatrixXd handle_table(const Rigged& rigged) {
  std::vector<std::int32_t> bone(rigged.character.skeleton.size(), -1);
  for (std::size_t k = 0; k < rigged.joint_of_bone.size(); ++k)
    bone[rigged.joint_of_bone[k].index()] = static_cast<std::int32_t>(k);
  const bool by_file = !rigged.vertex_of_file.empty();
  const std::size_t n = by_file ? rigged.vertex_of_file.size() : rigged.handles.size();
  Eigen::MatrixXd table(static_cast<Eigen::Index>(n), 1);
  for (std::size_t i = 0; i < n; ++i) {
    const JointId joint = rigged.handles[by_file ? rigged.vertex_of_file[i].index() : i];
    table(static_cast<Eigen::Index>(i), 0) = joint.is_valid() ? bone[joint.index()] : -1;
  }
  return table;
}

}  // namespace skinforge
