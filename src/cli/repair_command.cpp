#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "cli/commands.h"
#include "cli/output_folder.h"
#include "cli/session.h"
#include "io/export.h"
#include "io/file_kind.h"
#include "io/gltf_rules.h"
#include "io/import.h"

namespace skinforge {
using nlohmann::json;
namespace fs = std::filesystem;

namespace {
fs::path output_of(const CommandLine& line) {
  if (!line.out.empty()) return line.out;
  return fs::path(line.file).replace_extension("repaired.glb");
}

std::size_t most_influences(const Character& character) {
  std::size_t most = 0;
  for (std::size_t v = 0; v < character.mesh.vertex_count(); ++v)
    most = std::max(most, character.weights.of(VertexId(v)).size());
  return most;
}

// Rules that the input breaks. What is written breaks none, so each of them is a repair; those that reading
// notices are said by it, too, in its own words.
void add_broken_rules(const std::vector<InputFile>& files, const std::string& place, IssueSink& repairs) {
  const std::string ending = lower_extension(files.front().path);
  if (ending != ".glb" && ending != ".gltf") return;
  for (const GltfFinding& finding : check_gltf(files))
    repairs.note(finding.code, place + " " + finding.pointer, finding.message);
}

// What is written must be without fault; if not, the fault is ours.
void expect_valid(const fs::path& path, const Bytes& glb) {
  const auto findings = check_gltf({{path.string(), glb, sha256(glb)}});
  if (!findings.empty())
    throw Error(ExitCode::Invalid,
                fmt::format("{}: the repaired file is not valid: {} {}: {}", path.string(),
                            findings.front().code, findings.front().pointer, findings.front().message));
}
}  // namespace

ExitCode repair_command(const CommandLine& line, Console& console) {
  const std::vector<InputFile> files = read_input_files(line.file);
  IssueSink repairs;
  const std::string place = fs::path(line.file).filename().string();
  const Character character = build_character(read_scene(files), place, repairs);
  const std::size_t most = most_influences(character);
  const std::size_t written = line.influences != 0 ? line.influences : most > 4 ? 8 : 4;
  const Bytes glb = write_glb(character, {.max_influences = written, .extras_json = {}});
  const fs::path path = output_of(line);
  expect_valid(path, glb);
  std::vector<fs::path> inputs;
  for (const InputFile& file : files) inputs.emplace_back(file.path);
  OutputFolder folder(path.has_parent_path() ? path.parent_path() : fs::path("."), inputs);
  folder.add(path.filename().string(), glb);
  folder.write();
  add_broken_rules(files, place, repairs);
  if (most > written)
    repairs.warn("influences-cut", place,
                 fmt::format("vertices follow up to {} joints; the {} strongest are written", most, written));
  for (const Issue& issue : repairs.issues()) console.issue(issue);
  if (line.json)
    print_data(json{
        {"file", line.file},
        {"written", path.string()},
        {"bytes", glb.size()},
        {"sha256", sha256(glb).hex()},
        {"repairs", to_json(repairs.issues())},
        {"exit_code",
         0}}.dump(2, ' ', false, json::error_handler_t::replace));
  else
    console.info(fmt::format("{} ({}), {} repairs", path.string(), readable_size(glb.size()),
                             repairs.issues().size()));
  return ExitCode::Ok;
}

}  // namespace skinforge
