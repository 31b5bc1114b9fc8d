#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <span>

#include "base/safe_name.h"
#include "base/share_text.h"
#include "base/text.h"
#include "base/version.h"
#include "cli/accept.h"
#include "cli/commands.h"
#include "cli/diff_page.h"
#include "diff/diff_text.h"
#include "io/export.h"
#include "io/import.h"
#include "pipeline/publish.h"
#include "report/build_verdict.h"
#include "report/junit.h"
#include "stages/compared_pictures.h"
#include "stages/file_facts.h"

namespace skinforge {
namespace fs = std::filesystem;
using nlohmann::json;

namespace {
struct Side {
  Character character;
  FileFacts facts;
  Bytes bytes;  // of the file itself
};

Side read_side(const std::string& path, Console& console) {
  std::vector<InputFile> files = read_input_files(path);
  IssueSink issues;
  Side side;
  side.character = build_character(read_scene(files), path, issues);
  for (const Issue& issue : issues.issues())
    if (issue.severity == Severity::Warning) console.detail(issue.place + ": " + issue.message);
  side.facts = facts_of(files);
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
  DiffThresholds thresholds;
  const std::map<std::string, double*> limits = {{"geometry", &thresholds.geometry},
                                                 {"normals", &thresholds.normals},
                                                 {"uv", &thresholds.uv},
                                                 {"weights", &thresholds.weights},
                                                 {"animation", &thresholds.animation},
                                                 {"duration", &thresholds.duration},
                                                 {"picture", &thresholds.picture}};
  std::vector<std::string> names = {"structure"};
  for (const auto& [name, limit] : limits) names.push_back(name);
  for (const std::string& word : words) {
    const auto equals = word.find('=');
    const std::string name = word.substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : word.substr(equals + 1);
    if (name == "structure" && (value == "any" || value == "none"))
      thresholds.structure = value == "none";
    else if (name == "structure")
      throw Error(ExitCode::Usage, "--threshold structure: expected none (every edit counts) or any");
    else if (const auto limit = limits.find(name); limit != limits.end())
      *limit->second = limit_of(value, word);
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

std::string sarif_of(const std::string& file, const std::vector<DiffFinding>& findings) {
  std::vector<BuildVerdict> verdicts;
  for (const DiffFinding& f : findings) {
    if (!f.is_over) continue;
    BuildVerdict& verdict = verdicts.emplace_back();
    verdict.label = verdict.recipe = file;
    verdict.code = ExitCode::Different;
    verdict.error = fmt::format("{}, {}: {}", f.group, f.name, f.text);
  }
  return sarif(verdicts, kVersion);
}

// 01_bind_pose_front.png, 05_Gallop_0.583s_front.png ...
void write_pictures(const std::string& folder, const std::vector<PictureDiff>& pictures, Console& console) {
  std::error_code error;  // of a folder that cannot be made the first file tells
  fs::create_directories(folder, error);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const PictureDiff& picture = pictures[i];
    const std::string moment = picture.clip.empty()
                                   ? "bind_pose"
                                   : fmt::format("{}_{:.3f}s", safe_file_name(picture.clip), picture.time);
    write_output(fs::path(folder) / fmt::format("{:02}_{}_{}.png", i + 1, moment, picture.camera),
                 encode_png(picture_of_difference(picture.a, picture.b, title_of(picture))));
  }
  console.info(fmt::format("{}: {} pictures", folder, pictures.size()));
}

}  // namespace

ExitCode diff_command(const CommandLine& line, Console& console) {
  const DiffRequest& request = line.diff;
  const DiffThresholds thresholds = thresholds_of(request.thresholds);
  const Side a = read_side(request.a, console), b = read_side(request.b, console);
  CharacterDiff diff = compare_characters(
      a.character, b.character, {.a = a.facts, .b = b.facts, .wants_vertices = !request.html.empty()});
  const bool writes_pictures = !request.pictures.empty();
  if (!request.without_pictures)
    add_pictures(
        a.character, b.character, diff,
        {.keeps_drawings = writes_pictures || !request.html.empty(), .draws_always = writes_pictures});
  const std::vector<DiffFinding> findings = judge(diff, thresholds);
  const std::string text = to_text(diff, findings);
  if (!request.junit.empty()) {
    const std::string xml = junit_of(findings);
    write_output(request.junit, xml);
  }
  if (!request.sarif.empty()) write_output(request.sarif, sarif_of(request.b, findings));
  if (writes_pictures) write_pictures(request.pictures, diff.pictures, console);
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
