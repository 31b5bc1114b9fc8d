#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

#include "cli/child_program.h"
#include "cli/commands.h"
#include "cli/report_page.h"
#include "field/signed_distance.h"
#include "io/import.h"
#include "pipeline/blob_store.h"

namespace skinforge {
using nlohmann::json;
namespace fs = std::filesystem;

namespace {
// One thing that a build may need.
struct Check {
  std::string name;
  bool is_needed = true;  // without it builds fail; else something is left out
  std::string fault;      // empty: all is well
  std::string hint;
};

// What it throws is the fault; libraries throw what they like.
std::string fault_of(const std::function<void()>& work) try {
  work();
  return "";
} catch (const std::exception& error) {
  return error.what();
}

// A triangle, so small that only the child process itself can fail.
void import_triangle() {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const auto bytes = std::as_bytes(std::span(text));
  const Bytes content(bytes.begin(), bytes.end());
  read_scene({{"doctor.obj", content, sha256(content)}});
}

void write_field() {
  DistanceField field;
  field.lattice.voxel = 1;
  field.lattice.size = {2, 2, 2};
  field.values.assign(field.lattice.count(), 1.0F);
  to_vdb(field);
}

std::string cache_fault(const std::string& folder) {
  DiskStore store(folder);
  const std::string name = "doctor/probe";
  const std::string text = "probe";
  const bool is_written = store.write(name, std::as_bytes(std::span(text)));
  store.remove(name);
  std::error_code error;
  fs::remove(fs::path(folder) / "doctor", error);
  if (!is_written) return folder + " cannot be written; results are not kept";
  const auto space = fs::space(folder, error);
  constexpr std::uintmax_t kLittle = 1'000'000'000;  // ours: a few hundred builds
  if (!error && space.available < kLittle)
    return fmt::format("{}: {} are left on this disk", folder, readable_size(space.available));
  return "";
}

std::vector<Check> checks(const CommandLine& line) {
  const auto program_fault = [](std::vector<std::string> words) {
    const auto result = run_child(words, 20);
    return result && result->status == 0 ? std::string() : words.front() + " is not there";
  };
  return {
      {"reading FBX, DAE and OBJ in a child process", true, fault_of(import_triangle),
       "the program must be able to start itself again"},
      {".vdb files (OpenVDB)", true, fault_of(write_field),
       "libskinforge_vdb.so belongs beside the program; build again"},
      {"cache", true, cache_fault(line.cache), "--cache DIR or $SKINFORGE_CACHE names another folder"},
      {"3D view of reports", false,
       viewer_module().empty() ? "skinforge_viewer.js.gz is not beside the program" : "",
       "scripts/setup.sh --node, then build again"},
      {"node, for the Khronos validator", false, program_fault({"node", "--version"}),
       "scripts/setup.sh --node"},
  };
}
}  // namespace

ExitCode doctor_command(const CommandLine& line, Console&) {
  bool is_well = true;
  json list = json::array();
  std::string text;
  for (const Check& check : checks(line)) {
    const bool is_good = check.fault.empty();
    is_well = is_well && (is_good || !check.is_needed);
    const char* verdict = is_good ? "ok" : check.is_needed ? "fault" : "absent";
    text += fmt::format("{:<7} {}{}\n", verdict, check.name,
                        is_good ? "" : ": " + check.fault + " (" + check.hint + ")");
    list.push_back({{"check", check.name}, {"verdict", verdict}});
    if (!is_good) list.back().update({{"fault", check.fault}, {"hint", check.hint}});
  }
  const ExitCode code = is_well ? ExitCode::Ok : ExitCode::StageFailed;
  if (line.json)
    print_data(json{{"checks", std::move(list)}, {"exit_code", static_cast<int>(code)}}.dump(2));
  else
    print_data(text);
  return code;
}

}  // namespace skinforge
