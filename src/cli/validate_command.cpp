#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "cli/commands.h"
#include "cli/khronos_validator.h"
#include "io/file_kind.h"
#include "io/gltf_rules.h"

namespace skinforge {
using nlohmann::json;

namespace {
std::size_t count(const std::vector<GltfFinding>& findings, GltfFinding::Level level) {
  return static_cast<std::size_t>(std::count_if(findings.begin(), findings.end(),
                                                [&](const GltfFinding& f) { return f.level == level; }));
}

json to_json(const std::vector<GltfFinding>& findings) {
  json list = json::array();
  for (const GltfFinding& f : findings)
    list.push_back({{"severity", f.level == GltfFinding::Level::Error ? "error" : "warning"},
                    {"code", f.code},
                    {"pointer", f.pointer},
                    {"message", f.message}});
  return list;
}

std::string text_of(const std::string& file, const std::vector<GltfFinding>& findings) {
  std::string text;
  for (const GltfFinding& f : findings)
    text += fmt::format("{}: {}: {}: {} [{}]\n", printable(file),
                        f.level == GltfFinding::Level::Error ? "error" : "warning",
                        f.pointer.empty() ? "/" : printable(f.pointer), printable(f.message), f.code);
  return text;
}

// What one of the two found and the other did not.
void add_new(const std::vector<GltfFinding>& more, std::vector<GltfFinding>& all) {
  for (const GltfFinding& f : more) {
    const bool is_known = std::any_of(all.begin(), all.end(), [&](const GltfFinding& known) {
      return known.code == f.code && known.pointer == f.pointer;
    });
    if (!is_known) all.push_back(f);
  }
}
}  // namespace

ExitCode validate_command(const CommandLine& line, Console& console) {
  const std::string ending = lower_extension(line.file);
  if (ending != ".glb" && ending != ".gltf")
    throw Error(ExitCode::Usage, printable(line.file) + ": only .glb and .gltf files can be validated");
  std::vector<GltfFinding> findings = check_gltf(read_input_files(line.file));
  const auto khronos = line.without_khronos ? std::nullopt : khronos_findings(line.file);
  if (khronos) add_new(*khronos, findings);
  const std::size_t errors = count(findings, GltfFinding::Level::Error);
  const std::size_t warnings = count(findings, GltfFinding::Level::Warning);
  const bool is_good = errors == 0 && (warnings == 0 || !line.strict);
  const ExitCode code = is_good ? ExitCode::Ok : ExitCode::Invalid;
  if (line.json) {
    const json document = {{"file", line.file},
                           {"errors", errors},
                           {"warnings", warnings},
                           {"khronos_validator", khronos ? "ran" : "absent"},
                           {"findings", to_json(findings)},
                           {"exit_code", static_cast<int>(code)}};
    print_data(document.dump(2, ' ', false, json::error_handler_t::replace));
    return code;
  }
  print_data(text_of(line.file, findings));
  console.info(fmt::format(
      "{}: {} errors, {} warnings ({})", printable(line.file), errors, warnings,
      khronos ? "own rules and the Khronos validator" : "own rules; the Khronos validator is not there"));
  return code;
}

}  // namespace skinforge
