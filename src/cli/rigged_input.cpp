#include "cli/rigged_input.h"

#include <fmt/format.h>

#include "animation/sampling.h"
#include "base/text.h"

namespace skinforge {
namespace fs = std::filesystem;

namespace {

RecipeBind bind_of(const SkinningRequest& request) {
  RecipeBind bind;
  bind.method = request.bind_method == "heat" ? RecipeBindMethod::Heat : RecipeBindMethod::Harmonic;
  if (bind.method == RecipeBindMethod::Heat && request.handles != "rule")
    throw Error(ExitCode::Usage, "--method heat takes no handles; leave --handles out");
  bind.from_groups = request.handles == "groups";
  bind.rate_hz = request.rate_hz;
  return bind;
}

bool names_a_file(const std::string& handles) {
  return handles != "rule" && handles != "groups";
}

}  // namespace

Rigged read_rigged(const CommandLine& line, Console& console) {
  const SkinningRequest& request = line.skinning;
  IssueSink issues;
  Rigged rigged;
  if (request.skeleton.empty()) {
    rigged.character = import_character(line.file, issues);
    if (rigged.character.skeleton.size() < 2)
      throw Error(ExitCode::Usage, printable(line.file) + ": has no skeleton; name one with --skeleton");
    if (!request.poses.empty()) throw Error(ExitCode::Usage, "--poses needs --skeleton");
  } else {
    RigFiles files{.model = read_input_files(line.file), .skeleton = read_input_files(request.skeleton)};
    if (names_a_file(request.handles)) files.handles = read_input_file(request.handles);
    for (const std::string& poses : request.poses) files.poses.push_back(read_input_file(poses));
    rigged = read_rigged(files, bind_of(request), issues);
  }
  rigged.character.name = model_name(line);
  for (const Issue& issue : issues.issues()) console.issue(issue);
  return rigged;
}

std::vector<fs::path> input_files(const CommandLine& line) {
  std::vector<fs::path> files{line.file};
  if (!line.skinning.skeleton.empty()) files.emplace_back(line.skinning.skeleton);
  if (names_a_file(line.skinning.handles)) files.emplace_back(line.skinning.handles);
  files.insert(files.end(), line.skinning.poses.begin(), line.skinning.poses.end());
  files.insert(files.end(), line.skinning.examples.begin(), line.skinning.examples.end());
  return files;
}

std::string model_name(const CommandLine& line) {
  return fs::path(line.file).stem().string();
}

DeformOptions deform_options(const CommandLine& line, const Rigged& rigged) {
  DeformOptions options;
  const auto& files = line.skinning.examples;
  for (std::size_t i = 0; i + 1 < files.size(); i += 2)
    options.examples.push_back(
        {read_shape(read_input_file(files[i]), rigged),
         posed_bones(rigged.character.skeleton, read_pose(read_input_file(files[i + 1]), rigged))});
  return options;
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
