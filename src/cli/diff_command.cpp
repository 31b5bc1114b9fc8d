#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <span>

#include "base/share_text.h"
#include "base/text.h"
#include "cli/accept.h"
#include "cli/commands.h"
#include "cli/diff_page.h"
#include "diff/diff_text.h"
#include "io/import.h"
#include "pipeline/publish.h"
#include "report/junit.h"

namespace skinforge {
using nlohmann::json;

namespace {
struct Side {
  Character character;
  Bytes bytes;  // of the file itself
};

Side read_side(const std::string& path, Console& console) {
  std::vector<InputFile> files = read_input_files(path);
  IssueSink issues;
  Side side;
  side.character = build_character(read_scene(files), path, issues);
  for (const Issue& issue : issues.issues())
    if (issue.severity == Severity::Warning) console.detail(issue.place + ": " + issue.message);
  side.bytes = std::move(files.front().bytes);
  return side;
}

// "0.05%" of the diagonal, or a plain number.
double limit_of(const std::string& text, const std::string& whole) {
  if (const auto share = parse_share(text)) return *share;
  throw Error(ExitCode::Usage,
              fmt::format("--threshold {}: expected a number or a percentage from 0", printable(whole)));
}

DiffThresholds thresholds_of(const std::vector<std::string>& words) {
  const std::vector<std::string> names = {"geometry", "weights", "animation", "duration", "structure"};
  DiffThresholds thresholds;
  for (const std::string& word : words) {
    const auto equals = word.find('=');
    const std::string name = word.substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : word.substr(equals + 1);
    if (name == "structure" && (value == "any" || value == "none"))
      thresholds.structure = value == "none";
    else if (name == "structure")
      throw Error(ExitCode::Usage, "--threshold structure: expected none (every edit counts) or any");
    else if (name == "geometry")
      thresholds.geometry = limit_of(value, word);
    else if (name == "weights")
      thresholds.weights = limit_of(value, word);
    else if (name == "animation")
      thresholds.animation = limit_of(value, word);
    else if (name == "duration")
      thresholds.duration = limit_of(value, word);
    else
      throw Error(ExitCode::Usage, fmt::format("--threshold: nothing is called \"{}\"{}", printable(name),
                                               nearest_hint(name, names)));
  }
  return thresholds;
}

std::string junit_of(const std::vector<DiffFinding>& findings) {
  std::vector<TestCase> cases;
  for (const DiffFinding& f : findings)
    cases.push_back({"diff", f.group + ", " + f.name, f.is_over ? f.text : "", f.group, 0});
  return junit_xml(cases);
}

}  // namespace

ExitCode diff_command(const CommandLine& line, Console& console) {
  const DiffRequest& request = line.diff;
  const DiffThresholds thresholds = thresholds_of(request.thresholds);
  const Side a = read_side(request.a, console), b = read_side(request.b, console);
  const CharacterDiff diff = compare_characters(
      a.character, b.character,
      {.bytes_a = a.bytes.size(), .bytes_b = b.bytes.size(), .wants_vertices = !request.html.empty()});
  const std::vector<DiffFinding> findings = judge(diff, thresholds);
  const std::string text = to_text(diff, findings);
  if (!request.junit.empty()) {
    const std::string xml = junit_of(findings);
    write_output(request.junit, xml);
  }
  if (!request.html.empty()) {
    const std::string page = diff_page(request, a.character, b.character, diff, findings);
    write_output(request.html, page);
    console.info(request.html + " (" + readable_size(page.size()) + ")");
  }
  if (request.accept) accept_model(request.a, request.b, b.bytes, text, console);
  const ExitCode code = is_over(findings) && !request.accept ? ExitCode::Different : ExitCode::Ok;
  if (!line.json) {
    print_data(text);
    return code;
  }
  json document = to_json(diff, findings);
  document["a"] = request.a;
  document["b"] = request.b;
  document["exit_code"] = static_cast<int>(code);
  print_data(document.dump(2, ' ', false, json::error_handler_t::replace));
  return code;
}

}  // namespace skinforge
