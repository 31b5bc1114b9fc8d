#include <nlohmann/json.hpp>

#include "base/version.h"
#include "cli/build_id.h"
#include "cli/commands.h"
#include "cli/event_stream.h"
#include "recipe/schema.h"
#include "report/report_json.h"

namespace skinforge {

ExitCode schema_command(const CommandLine& line, Console&) {
  print_data(line.schema == "report"  ? report_schema()
             : line.schema == "event" ? event_schema()
                                      : recipe_schema());
  return ExitCode::Ok;
}

ExitCode version_command(const CommandLine& line, Console&) {
  const nlohmann::json version = {{"version", kVersion}, {"build", build_id()}};
  print_data(line.json ? version.dump(2) : std::string("skinforge ") + kVersion);
  return ExitCode::Ok;
}

}  // namespace skinforge
