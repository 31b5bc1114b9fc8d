#include "stages/rigging.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "base/error.h"
#include "base/text.h"
#include "geometry/triangle_bvh.h"
#include "io/file_kind.h"
#include "io/number_table.h"
#include "io/plain_mesh.h"
#include "io/tgf_reader.h"
#include "stages/clip_merge.h"
#include "stages/rig_handles.h"

namespace skinforge {
namespace {

constexpr double kSamePlace = 1e-5;   // ours: of the diagonal; importers keep float positions
constexpr double kTargetSeconds = 1;  // ours: a pose to go to is reached after this

bool has_extension(const InputFile& file, std::initializer_list<std::string_view> extensions) {
  const std::string own = lower_extension(file.path);
  return std::find(extensions.begin(), extensions.end(), own) != extensions.end();
}

Character read_model(const std::vector<InputFile>& files, IssueSink& issues) {
  return build_character(read_scene(files), files.front().path, issues);
}

template <class Id>
std::vector<Id> all_of(std::size_t count) {
  std::vector<Id> ids;
  for (std::size_t i = 0; i < count; ++i) ids.emplace_back(i);
  return ids;
}

// Vertex of the character nearest to each vertex of the file; importers weld and reorder.
std::vector<VertexId> match_vertices(const InputFile& file, const PolygonMesh& mesh) {
  const std::vector<Vec3> in_file = read_plain_mesh(file).positions;
  std::vector<std::array<std::int32_t, 3>> points;
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh.vertex_count()); ++v)
    points.push_back({v, v, v});
  const TriangleBvh bvh(mesh.positions, points);
  std::vector<VertexId> matched;
  for (std::size_t i = 0; i < in_file.size(); ++i) {
    const ClosestPoint found = bvh.closest(in_file[i]);
    if (found.triangle < 0 || found.distance > kSamePlace * mesh.diagonal())
      throw Error(ExitCode::BadInput,
                  fmt::format("{}: vertex {} of the file is no vertex of the imported model",
                              printable(file.path), i));
    matched.emplace_back(found.triangle);
  }
  return matched;
}

// The skeleton of a .tgf, or that of a model with its clips.
void take_skeleton(const InputFile& file, std::optional<Character>& model, Rigged& rigged) {
  Character& character = rigged.character;
  character.clips.clear();
  if (!model) {
    const BoneGraph graph = read_tgf(file);
    BoneRig rig = make_bone_rig(with_context(printable(file.path), [&] { return make_bone_forest(graph); }));
    character.skeleton = std::move(rig.skeleton);
    rigged.joint_of_bone = std::move(rig.joint_of_bone);
    return;
  }
  character.skeleton = model->skeleton;
  character.clips = std::move(model->clips);
  for (Clip& clip : character.clips) clip.morphs.clear();
  rigged.joint_of_bone = all_of<JointId>(character.skeleton.size());
}

void add_frames(const InputFile& file, double rate_hz, Rigged& rigged, IssueSink& issues) {
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

/// The character whose weights say what joints hold: the model where it has a skin, else the skeleton's
/// model.
const Character& skin_donor(const Character& model, const std::optional<Character>& skeleton_model) {
  if (model.skeleton.size() > 1) return model;
  if (skeleton_model && skeleton_model->mesh.face_count() > 0) return *skeleton_model;
  throw Error(ExitCode::BadInput, "handles from a skin: neither the model nor the skeleton's file has one");
}

Handles find_handles(const RigFiles& files, const RecipeBind& bind, const Character& model,
                     const std::optional<Character>& skeleton_model, const Rigged& rigged) {
  const Character& character = rigged.character;
  const auto in_model = [&](auto&& find) { return with_context(printable(files.model.front().path), find); };
  switch (bind.handles) {
    case RecipeHandles::Labels:
      return read_handles(files.handles.front(), rigged);
    case RecipeHandles::Image:
      return read_painted_handles(files.handles.front(), bind.colors, rigged);
    case RecipeHandles::Skin:
      return in_model(
          [&] { return handles_of_skin(skin_donor(model, skeleton_model), bind.handle_weight, character); });
    case RecipeHandles::Groups:
      return in_model([&] { return handles_of_groups(character.mesh, character.skeleton); });
    case RecipeHandles::Rule:
      break;
  }
  return {};
}

BindOptions bind_options(const RecipeBind& bind, Handles handles) {
  BindOptions options;
  options.method = bind.method == RecipeBindMethod::Heat ? BindMethod::Heat : BindMethod::Harmonic;
  options.rule = {bind.handle_factor, static_cast<std::size_t>(bind.handle_least)};
  options.heat.resolution = bind.resolution;
  options.handles = std::move(handles);
  return options;
}

// Tells that joints and weights of the model are not used.
void warn_of_replaced_skin(const Character& model, const std::string& place, IssueSink& issues) {
  if (model.skeleton.size() > 1)
    issues.warn("bind-replaces-skin", place,
                fmt::format("{} joints of the model, its weights and its clips give way to the new ones",
                            model.skeleton.size()));
}

}  // namespace

RotationFrames read_frames(const InputFile& file, const Rigged& rigged) {
  const Eigen::MatrixXd table = read_dmat(file);
  return with_context(printable(file.path),
                      [&] { return rotation_frames(table, rigged.joint_of_bone.size()); });
}

void add_clips(const std::vector<InputFile>& files, double rate_hz, Rigged& rigged, IssueSink& issues) {
  if (has_extension(files.front(), {".dmat"})) return add_frames(files.front(), rate_hz, rigged, issues);
  merge_clips(rigged.character, read_model(files, issues), files.front().path, issues);
}

Rigged as_rigged(Character character) {
  Rigged rigged;
  rigged.joint_of_bone = all_of<JointId>(character.skeleton.size());
  rigged.vertex_of_file = all_of<VertexId>(character.mesh.vertex_count());
  rigged.handles.resize(character.mesh.vertex_count());
  rigged.character = std::move(character);
  return rigged;
}

Rigged read_rigged(const RigFiles& files, const RecipeBind& bind, IssueSink& issues) {
  const InputFile& file = files.model.front();
  const std::string place = printable(file.path);
  const Character model = read_model(files.model, issues);
  Rigged rigged = as_rigged(model);
  if (has_extension(file, {".obj", ".off"})) rigged.vertex_of_file = match_vertices(file, model.mesh);
  std::optional<Character> skeleton_model;
  if (!files.skeleton.empty()) {
    warn_of_replaced_skin(model, place, issues);
    if (!has_extension(files.skeleton.front(), {".tgf"})) skeleton_model = read_model(files.skeleton, issues);
    take_skeleton(files.skeleton.front(), skeleton_model, rigged);
  } else if (model.skeleton.size() < 2) {
    throw Error(ExitCode::BadInput, place + ": has no skeleton of its own; name one");
  }
  for (const auto& clips : files.clips) add_clips(clips, bind.rate_hz, rigged, issues);
  Handles handles = find_handles(files, bind, model, skeleton_model, rigged);
  BoundSkin skin = bind_skin(rigged.character.mesh, rigged.character.skeleton,
                             bind_options(bind, std::move(handles)), place, issues);
  rigged.character.weights = std::move(skin.weights);
  rigged.handles = std::move(skin.handles);
  validate(rigged.character);
  return rigged;
}

}  // namespace skinforge
