#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/rigged_input.h"
#include "io/export.h"
#include "io/number_table.h"
#include "render/skinning_pictures.h"
#include "report/text_table.h"
#include "stages/rig_handles.h"
#include "stages/rig_tables.h"

namespace skinforge {
namespace {

/// What one joint got.
struct Coverage {
  std::string joint;
  std::size_t held = 0;        ///< vertices of its handle
  std::size_t influenced = 0;  ///< vertices with a weight
  double largest = 0;          ///< largest weight
};

std::vector<Coverage> coverage_of(const Rigged& rigged) {
  std::vector<Coverage> all;
  for (const std::string& name : rigged.character.skeleton.names()) all.push_back({name});
  for (const HandleCount& count : count_handles(rigged.handles, all.size()))
    all[count.joint.index()].held = count.vertices;
  for (const Influence& influence : rigged.character.weights.influences) {
    Coverage& joint = all[influence.joint.index()];
    ++joint.influenced;
    joint.largest = std::max(joint.largest, influence.weight);
  }
  return all;
}

std::size_t free_vertices(const Rigged& rigged) {
  return static_cast<std::size_t>(
      std::count_if(rigged.handles.begin(), rigged.handles.end(), [](JointId j) { return !j.is_valid(); }));
}

std::string as_text(const Rigged& rigged) {
  TextTable table;
  table.add({"joint", "held", "influenced", "largest weight"});
  for (const Coverage& c : coverage_of(rigged))
    table.add(
        {c.joint, std::to_string(c.held), std::to_string(c.influenced), fmt::format("{:.3f}", c.largest)});
  return fmt::format("{} vertices, {} free\n{}", rigged.handles.size(), free_vertices(rigged), table.str());
}

std::string as_json(const Rigged& rigged, const std::vector<std::string>& files) {
  nlohmann::ordered_json json = {{"vertices", rigged.handles.size()}, {"free", free_vertices(rigged)}};
  for (const Coverage& c : coverage_of(rigged))
    json["joints"].push_back(
        {{"joint", c.joint}, {"held", c.held}, {"influenced", c.influenced}, {"largest_weight", c.largest}});
  json["files"] = files;
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

// The joint with most vertices: the one that says most in a picture.
JointId pictured_joint(const CommandLine& line, const Rigged& rigged) {
  if (!line.skinning.joint.empty()) return joint_named(line.skinning.joint, rigged.character.skeleton);
  const auto all = coverage_of(rigged);
  const auto most = std::max_element(all.begin(), all.end(), [](const Coverage& a, const Coverage& b) {
    return a.influenced < b.influenced;
  });
  return JointId(static_cast<std::size_t>(most - all.begin()));
}

void add_handles(const Rigged& rigged, const std::string& name, const Subject& subject, OutputFolder& out) {
  if (free_vertices(rigged) == rigged.handles.size()) return;  // heat holds nothing
  out.add(name + "_handles.dmat", write_dmat(handle_table(rigged)));
  out.add(name + "_handles.json", handles_json(rigged));
  out.add(name + "_handles.png",
          encode_png(handles_picture(subject, rigged.handles, rigged.character.skeleton.size())));
}

void add_weights(const CommandLine& line, const Rigged& rigged, const Subject& subject, OutputFolder& out) {
  const std::string name = model_name(line);
  const Skeleton& skeleton = rigged.character.skeleton;
  const SkinWeights& weights = rigged.character.weights;
  const JointId joint = pictured_joint(line, rigged);
  out.add(name + "_weights.dmat", write_dmat(weight_table(rigged)));
  out.add(name + "_weights.png", encode_png(weights_picture(subject, weights, skeleton.size())));
  out.add(name + "_weights_of_joint.png",
          encode_png(joint_weights_picture(subject, weights, joint, skeleton[joint].name)));
}

}  // namespace

ExitCode bind_command(const CommandLine& line, Console& console) {
  const Rigged rigged = read_rigged(line, console);
  const std::string name = model_name(line);
  OutputFolder out(line.out.empty() ? "out/" + name : line.out, input_files(line));
  out.add(name + ".glb",
          write_glb(rigged.character, {.max_influences = line.skinning.influences, .extras_json = {}}));
  const Subject subject(rigged.character.mesh, rigged.character.materials);
  add_handles(rigged, name, subject, out);
  add_weights(line, rigged, subject, out);
  const std::vector<std::string> files = out.write();
  for (const std::string& file : files) console.info("wrote " + file);
  print_data(line.json ? as_json(rigged, files) : as_text(rigged));
  return ExitCode::Ok;
}

}  // namespace skinforge
