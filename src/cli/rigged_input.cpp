#include "cli/rigged_input.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/color_text.h"
#include "base/text.h"
#include "io/file_kind.h"
#include "stages/rig_tables.h"

namespace skinforge {
namespace fs = std::filesystem;

namespace {

const std::map<std::string, RecipeHandles> kHandleWords{
    {"rule", RecipeHandles::Rule}, {"groups", RecipeHandles::Groups}, {"skin", RecipeHandles::Skin}};

bool names_a_file(const std::string& handles) {
  return !kHandleWords.contains(handles);
}

RecipeHandles handles_of(const std::string& text) {
  if (!names_a_file(text)) return kHandleWords.at(text);
  const std::string extension = lower_extension(text);
  if (extension == ".dmat" || extension == ".json") return RecipeHandles::Labels;
  if (extension == ".png" || extension == ".jpg" || extension == ".jpeg") return RecipeHandles::Image;
  throw Error(ExitCode::Usage,
              fmt::format("--handles {}: expected rule, groups, skin, or a .dmat, .json, .png or .jpg file",
                          printable(text)));
}

std::map<std::string, Color8> read_colors(const std::string& path) {
  const InputFile file = read_input_file(path);
  const auto json = nlohmann::json::parse(file.bytes.begin(), file.bytes.end(), nullptr, false, true);
  const auto refuse = [&](const std::string& sentence) -> Error {
    return {ExitCode::BadInput, printable(path) + ": " + sentence};
  };
  if (!json.is_object() || json.empty()) throw refuse("expected an object {\"joint\": \"#rrggbb\"}");
  std::map<std::string, Color8> colors;
  for (const auto& [joint, text] : json.items()) {
    const auto color = text.is_string() ? parse_color(text.get<std::string>()) : std::nullopt;
    if (!color) throw refuse(fmt::format("\"{}\": expected a colour such as \"#ff8000\"", printable(joint)));
    colors[joint] = *color;
  }
  return colors;
}

RecipeBind bind_of(const SkinningRequest& request) {
  RecipeBind bind;
  bind.method = request.bind_method == "heat" ? RecipeBindMethod::Heat : RecipeBindMethod::Harmonic;
  bind.handles = handles_of(request.handles);
  bind.rate_hz = request.rate_hz;
  const bool is_painted = bind.handles == RecipeHandles::Image;
  if (bind.method == RecipeBindMethod::Heat && bind.handles != RecipeHandles::Rule)
    throw Error(ExitCode::Usage, "--method heat takes no handles; leave --handles out");
  if (is_painted != !request.label_colors.empty())
    throw Error(ExitCode::Usage, is_painted ? "painted handles need --label-colors FILE"
                                            : "--label-colors goes with --handles IMAGE.png");
  if (is_painted) bind.colors = read_colors(request.label_colors);
  return bind;
}

Rigged read_with_own_skin(const CommandLine& line, IssueSink& issues) {
  Character character = import_character(line.file, issues);
  if (character.skeleton.size() < 2)
    throw Error(ExitCode::Usage, printable(line.file) + ": has no skeleton; name one with --skeleton");
  Rigged rigged = as_rigged(std::move(character));
  for (const std::string& poses : line.skinning.poses)
    add_clips(read_input_files(poses), line.skinning.rate_hz, rigged, issues);
  return rigged;
}

Rigged read_and_bind(const CommandLine& line, IssueSink& issues) {
  const SkinningRequest& request = line.skinning;
  const RecipeBind bind = bind_of(request);
  RigFiles files{.model = read_input_files(line.file)};
  if (!request.skeleton.empty()) files.skeleton = read_input_files(request.skeleton);
  if (names_a_file(request.handles)) files.handles = {read_input_file(request.handles)};
  for (const std::string& poses : request.poses) files.clips.push_back(read_input_files(poses));
  return read_rigged(files, bind, issues);
}

}  // namespace

Rigged read_rigged(const CommandLine& line, Console& console) {
  const SkinningRequest defaults, &request = line.skinning;
  const bool binds = line.verb == Verb::Bind || !request.skeleton.empty() ||
                     request.handles != defaults.handles || request.bind_method != defaults.bind_method;
  IssueSink issues;
  Rigged rigged = binds ? read_and_bind(line, issues) : read_with_own_skin(line, issues);
  rigged.character.name = model_name(line);
  for (const Issue& issue : issues.issues()) console.issue(issue);
  return rigged;
}

std::vector<fs::path> input_files(const CommandLine& line) {
  std::vector<fs::path> files{line.file};
  if (!line.skinning.skeleton.empty()) files.emplace_back(line.skinning.skeleton);
  if (names_a_file(line.skinning.handles)) files.emplace_back(line.skinning.handles);
  if (!line.skinning.label_colors.empty()) files.emplace_back(line.skinning.label_colors);
  files.insert(files.end(), line.skinning.poses.begin(), line.skinning.poses.end());
  files.insert(files.end(), line.skinning.examples.begin(), line.skinning.examples.end());
  return files;
}

std::string model_name(const CommandLine& line) {
  return fs::path(line.file).stem().string();
}

DeformOptions deform_options(const CommandLine& line, const Rigged& rigged) {
  const SkinningRequest& request = line.skinning;
  const Skeleton& skeleton = rigged.character.skeleton;
  DeformOptions options;
  options.with_rest = request.with_rest;
  options.kernel = request.kernel == "gaussian" ? RadialKernel::Gaussian : RadialKernel::Linear;
  for (const std::string& joint : request.driver_joints)
    options.joints.push_back(joint_named(joint, skeleton).index());
  for (std::size_t i = 0; i + 1 < request.examples.size(); i += 2)
    options.examples.push_back(
        {read_shape(read_input_file(request.examples[i]), rigged),
         posed_bones(skeleton, read_pose(read_input_file(request.examples[i + 1]), rigged))});
  return options;
}

JointId joint_named(const std::string& name, const Skeleton& skeleton) {
  const auto joint = skeleton.find(name);
  if (!joint)
    throw Error(ExitCode::Usage,
                fmt::format("no joint \"{}\"{}", printable(name), nearest_hint(name, skeleton.names())));
  return *joint;
}

const Clip& chosen_clip(const CommandLine& line, const Character& character) {
  if (character.clips.empty())
    throw Error(ExitCode::Usage, printable(line.file) + ": has no clip; bring frames with --poses");
  if (line.skinning.clip.empty()) return character.clips.front();
  std::vector<std::string> names;
  for (const Clip& clip : character.clips) {
    if (clip.name == line.skinning.clip) return clip;
    names.push_back(clip.name);
  }
  throw Error(ExitCode::Usage, fmt::format("no clip \"{}\"{}", printable(line.skinning.clip),
                                           nearest_hint(line.skinning.clip, names)));
}

std::vector<double> frame_times(const Clip& clip, std::size_t count) {
  std::vector<double> times;
  for (std::size_t i = 0; i < count; ++i)
    times.push_back(count == 1 ? clip.duration
                               : clip.duration * static_cast<double>(i) / static_cast<double>(count - 1));
  return times;
}

}  // namespace skinforge
