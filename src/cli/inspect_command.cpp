#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/inspection.h"
#include "cli/session.h"
#include "io/import.h"

namespace skinforge {

ExitCode inspect_command(const CommandLine& line, Console&) {
  const std::vector<InputFile> files = read_input_files(line.file);
  const RawScene scene = read_scene(files);
  IssueSink issues;
  const Character character = build_character(scene, line.file, issues);
  Inspection inspection = inspect(character, scene);
  inspection.file = line.file;
  inspection.digest = files.front().digest.hex();
  inspection.bytes = files.front().bytes.size();
  inspection.issues = issues.issues();
  if (!line.json) {
    print_data(inspection_text(inspection, character));
    return ExitCode::Ok;
  }
  nlohmann::json document = inspection_json(inspection, character);
  document["issues"] = to_json(inspection.issues);
  print_data(document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  return ExitCode::Ok;
}

}  // namespace skinforge
