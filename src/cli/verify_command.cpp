#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "cli/commands.h"
#include "cli/recipe_tasks.h"
#include "io/glb_provenance.h"
#include "io/glb_stamp.h"
#include "io/import.h"
#include "recipe/recipe_files.h"

namespace skinforge {
using nlohmann::json;

namespace {
// Null when the file does not say what it was made of.
json provenance_of(const Bytes& glb) {
  const std::string text = provenance_text(glb);
  return text.empty() ? json() : json::parse(text);
}

std::string stamp_fault(const Bytes& glb) {
  switch (check_stamp(glb)) {
    case StampState::Absent:
      return "it carries no digest of its own: not made by this tool, or taken out since";
    case StampState::Wrong:
      return "its content is not as it was written";
    case StampState::Right:
      break;
  }
  return "";
}

// The text of a member; empty where there is none: anybody may have written the file.
std::string text_in(const json& object, const char* key) {
  const auto member = object.is_object() ? object.find(key) : object.end();
  return member != object.end() && member->is_string() ? member->get<std::string>() : std::string();
}

// Files that the model was made of against those that the recipe names now.
void compare_inputs(const json& provenance, const Recipe& recipe, std::vector<std::string>& faults) {
  std::vector<std::pair<std::string, std::string>> now;  // name, digest
  for (const auto& path : input_files(recipe))
    for (const InputFile& file : read_input_files(path.string()))
      now.push_back({std::filesystem::path(file.path).filename().string(), file.digest.hex()});
  const json inputs = provenance.value("inputs", json::object());
  for (const auto& [input, files] : inputs.items())
    for (const json& file : files) {
      const std::string name = text_in(file, "file"), digest = text_in(file, "sha256");
      const bool is_same = std::find(now.begin(), now.end(), std::pair(name, digest)) != now.end();
      const auto named = std::find_if(now.begin(), now.end(), [&](const auto& f) { return f.first == name; });
      if (is_same) continue;
      faults.push_back(fmt::format("input \"{}\": {} was {}, {}", printable(input), printable(name),
                                   printable(digest.substr(0, 12)),
                                   named == now.end() ? "and the recipe names no such file now"
                                                      : "now it is " + named->second.substr(0, 12)));
    }
}

void compare_recipe(const json& provenance, const CommandLine& line, std::vector<std::string>& faults) {
  const Recipe recipe = read_resolved(only_recipe(line));
  const std::string was = text_in(provenance, "recipe_sha256"), is = recipe_digest(recipe).hex();
  if (was != is)
    faults.push_back(fmt::format("{} asks for something else now: {} then, {} now", line.recipes.front(),
                                 printable(was.substr(0, 12)), is.substr(0, 12)));
  compare_inputs(provenance, recipe, faults);
}
}  // namespace

ExitCode verify_command(const CommandLine& line, Console& console) {
  const InputFile file = read_input_file(line.file);
  const json provenance = with_context(line.file, [&] { return provenance_of(file.bytes); });
  std::vector<std::string> faults;
  if (const std::string fault = stamp_fault(file.bytes); !fault.empty()) faults.push_back(fault);
  if (provenance.is_null())
    faults.push_back("it does not say what it was made of");
  else if (!line.recipes.empty())
    compare_recipe(provenance, line, faults);
  for (const std::string& fault : faults) console.error(line.file + ": " + fault);

  const ExitCode code = faults.empty() ? ExitCode::Ok : ExitCode::Invalid;
  if (line.json) {
    const json document = {{"file", line.file},
                           {"provenance", provenance},
                           {"faults", faults},
                           {"exit_code", static_cast<int>(code)}};
    print_data(document.dump(2, ' ', false, json::error_handler_t::replace));
  } else if (faults.empty()) {
    console.info(fmt::format("{}: as it was written{}", line.file,
                             line.recipes.empty() ? "" : ", from this recipe and these files"));
  }
  return code;
}

}  // namespace skinforge
