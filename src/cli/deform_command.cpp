#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "animation/sampling.h"
#include "cli/commands.h"
#include "cli/rigged_input.h"
#include "io/export.h"
#include "io/number_table.h"

namespace skinforge {
namespace {

std::string obj_text(const Character& character, std::vector<Vec3> positions) {
  Character posed = character;
  posed.mesh.positions = std::move(positions);
  return write_obj(posed);
}

// Joint positions of all frames, as a table of #joints * #frames rows: what regression tests compare.
Eigen::MatrixXd joint_track(const Skeleton& skeleton, const Clip& clip, const std::vector<double>& times) {
  Eigen::MatrixXd table(static_cast<Eigen::Index>(skeleton.size() * times.size()), 3);
  Eigen::Index row = 0;
  for (const double time : times)
    for (const Affine3& joint : model_from_joint(skeleton, sample(skeleton, clip, time)))
      table.row(row++) = joint.translation();
  return table;
}

}  // namespace

DeformMethod deform_method(const std::string& name) {
  for (int m = 0; m < kDeformMethods; ++m)
    if (name_of(DeformMethod(m)) == name) return DeformMethod(m);
  throw Error(ExitCode::Usage, "no method \"" + name + "\"");
}

ExitCode deform_command(const CommandLine& line, Console& console) {
  const Rigged rigged = read_rigged(line, console);
  const Character& character = rigged.character;
  const Clip& clip = chosen_clip(line, character);
  IssueSink issues;
  const Deformer deformer(character.mesh, character.skeleton, character.weights,
                          deform_method(line.skinning.deform_method), deform_options(line, rigged),
                          model_name(line), issues);
  for (const Issue& issue : issues.issues()) console.issue(issue);
  const std::vector<double> times = frame_times(clip, line.skinning.frames);
  OutputFolder out(line.out.empty() ? "out/" + model_name(line) : line.out, input_files(line));
  for (std::size_t i = 0; i < times.size(); ++i) {
    std::vector<Vec3> posed =
        deformer(posed_bones(character.skeleton, sample(character.skeleton, clip, times[i])));
    const std::string name =
        fmt::format("{}_{}_{:04}.{}", model_name(line), line.skinning.deform_method, i, line.skinning.format);
    if (line.skinning.format == "ply")
      out.add(name, write_ply(character.mesh, posed));
    else
      out.add(name, obj_text(character, std::move(posed)));
  }
  out.add(model_name(line) + "_joints.dmat", write_dmat(joint_track(character.skeleton, clip, times)));
  const std::vector<std::string> files = out.write();
  nlohmann::ordered_json json = {
      {"clip", clip.name}, {"method", line.skinning.deform_method}, {"times", times}};
  json["files"] = files;
  if (line.json)
    print_data(json.dump(2));
  else
    print_data(fmt::format("{} frames of \"{}\" by {}, {} to {}", times.size(), clip.name,
                           line.skinning.deform_method, files.front(), files[times.size() - 1]));
  return ExitCode::Ok;
}

}  // namespace skinforge
