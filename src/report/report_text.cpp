#include "report/report_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "report/text_table.h"

namespace skinforge {
namespace {

constexpr double kTurnLimit = 1.1;  // the goal for completed motion: fastest turn over the sources' fastest
constexpr std::size_t kListedDrops = 8;  // ours: more would push the rest off the screen; report.json has all

std::string section(const std::string& title, const std::string& body) {
  return body.empty() ? "" : "\n" + title + "\n" + body;
}

std::string counted(std::int64_t n, const std::string& one, const std::string& many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}
std::string counted(std::int64_t n, const std::string& one) {
  return counted(n, one, one + "s");
}

std::string size_text(const std::array<double, 3>& size) {
  return fmt::format("{:.3g} x {:.3g} x {:.3g} m", size[0], size[1], size[2]);
}

std::string bytes_text(std::int64_t bytes) {
  if (bytes < 1000) return fmt::format("{} B", bytes);
  if (bytes < 1'000'000) return fmt::format("{:.1f} kB", static_cast<double>(bytes) / 1e3);
  return fmt::format("{:.2f} MB", static_cast<double>(bytes) / 1e6);
}

std::string percent(double share) {
  return fmt::format("{:.1f} %", 100 * share);
}

std::string joined(const std::vector<std::string>& items, std::string_view separator = ", ") {
  return fmt::format("{}", fmt::join(items, separator));
}

std::string input_lines(const Report& report) {
  TextTable table;
  for (const InputReport& i : report.inputs)
    table.add({i.name, i.file, counted(i.faces, "face"), counted(i.joints, "joint"), counted(i.clips, "clip"),
               size_text(i.bind_size),
               i.repairs.empty() ? "" : counted(static_cast<std::int64_t>(i.repairs.size()), "repair")});
  return table.str();
}

std::string operation_line(const OperationReport& o) {
  std::string line = o.kind + " " + joined(o.at, " + ");
  if (!o.input.empty()) line += fmt::format(" <- {} of {}", o.joint, o.input);
  if (o.scale != 1) line += fmt::format(", scaled by {:.3g}", o.scale);
  return line;
}

std::string operation_lines(const Report& report) {
  TextTable table;
  for (std::size_t i = 0; i < report.operations.size(); ++i)
    table.add({std::to_string(i + 1), operation_line(report.operations[i])});
  return table.str();
}

std::string mesh_line(const MeshReport& m) {
  std::string line =
      fmt::format("{} vertices, {} faces ({} quads, {} triangles)\n            {} copied unchanged, {}",
                  m.vertices, m.faces, m.quads, m.triangles, percent(m.kept_share), size_text(m.bind_size));
  if (m.open_edges_inherited > 0)
    line += fmt::format(", {} open edges as in the inputs", m.open_edges_inherited);
  return line;
}

std::string weights_line(const WeightsReport& w) {
  std::string line =
      fmt::format("at most {}", counted(w.max_influences, "joint moves", "joints move")) + " a vertex";
  if (w.cut_vertices > 0)
    line += fmt::format("; {} had more and lost {} at most", counted(w.cut_vertices, "vertex", "vertices"),
                        percent(w.cut_weight_max));
  if (w.unweighted_vertices > 0)
    line += "; ! " + counted(w.unweighted_vertices, "vertex has", "vertices have") + " no weight";
  if (!w.joints_without_weight.empty())
    line += "; " +
            counted(static_cast<std::int64_t>(w.joints_without_weight.size()), "joint moves", "joints move") +
            " no vertex";
  if (w.junction_step > w.neighbour_step)
    line += fmt::format("; weights step by {:.2f} in a junction, {:.2f} beside it", w.junction_step,
                        w.neighbour_step);
  return line;
}

std::string result_lines(const Report& report) {
  const std::string joints = counted(static_cast<std::int64_t>(report.joints.size()), "joint");
  return "  mesh      " + mesh_line(report.mesh) + "\n  skin      " + weights_line(report.weights) +
         "\n  skeleton  " + joints + "\n";
}

std::string loops_text(const JunctionReport& j) {
  std::vector<std::string> lengths;
  for (const std::int64_t n : j.border_loops) lengths.push_back(std::to_string(n));
  return lengths.empty() ? "no border" : "borders of " + joined(lengths, " + ");
}

std::vector<std::string> faults(const JunctionReport& j) {
  std::vector<std::string> found;
  const auto add = [&](std::int64_t n, const char* what) {
    if (n > 0) found.push_back(fmt::format("{} {}", n, what));
  };
  add(j.boundary_edges, "open edges");
  add(j.non_manifold_edges, "non-manifold edges");
  add(j.degenerate_faces, "degenerate faces");
  add(j.folded_faces.value_or(0), "folded faces");
  add(j.self_intersections.value_or(0), "self-intersections");
  return found;
}

std::string junction_text(const JunctionReport& j) {
  std::string text = fmt::format("{}: {} ({} quads, {} triangles), {}", j.rung, counted(j.faces, "face"),
                                 j.quads, j.triangles, loops_text(j));
  if (j.deviation) text += fmt::format(", within {:.2f} voxels of the field", j.deviation->p95);
  if (j.border_dihedral) text += fmt::format(", {:.0f} deg across the border", j.border_dihedral->mean);
  if (j.border_color_step) text += fmt::format(", colour steps of {:.1f}", j.border_color_step->mean);
  if (j.symmetry && j.symmetry->faces_symmetric)
    text += j.symmetry->max_deviation == 0.0 ? ", mirror symmetric" : ", mirror symmetric faces";
  const std::vector<std::string> found = faults(j);
  text += found.empty() ? ", sound" : "\n     ! " + joined(found);
  if (!j.reason.empty()) text += "\n     " + j.reason;
  return text;
}

std::string junction_lines(const Report& report) {
  std::string lines;
  for (const JunctionReport& j : report.junctions)
    lines += fmt::format("  {}  {}\n", j.operation, junction_text(j));
  return lines;
}

std::string completed_text(const ClipReport& c) {
  std::vector<std::string> clips;
  for (const FrameRun& run : c.completed_from)
    if (std::find(clips.begin(), clips.end(), run.clip) == clips.end()) clips.push_back(run.clip);
  return clips.empty() ? "" : "with " + joined(clips);
}

std::string posed_text(const PosedReport& p) {
  if (p.intersections == 0 && p.folds == 0) return "";
  return fmt::format("at {:.2f} s {} and {} more than at rest", p.worst_time,
                     counted(p.intersections, "intersection"), counted(p.folds, "fold"));
}

std::string clip_lines(const Report& report) {
  TextTable table;
  for (const ClipReport& c : report.clips) {
    const bool is_fast = c.turn_ratio.value_or(0) > kTurnLimit;
    table.add({is_fast ? "!" : " ", c.name, "from " + c.input, fmt::format("{:.2f} s", c.duration),
               counted(c.driven_joints, "joint"), completed_text(c),
               is_fast ? fmt::format("{} turns {:.2f} times as fast as in any source", c.fastest_joint,
                                     *c.turn_ratio)
                       : posed_text(c.posed)});
  }
  return table.str(1);
}

struct Tally {
  std::int64_t kept = 0, changed = 0, dropped = 0;
};

std::string ledger_lines(const Report& report) {
  std::map<LedgerKind, Tally> tallies;
  std::map<std::pair<std::string, std::string>, std::vector<std::string>> drops;  // (input, reason) -> items
  for (const LedgerEntry& entry : report.ledger) {
    Tally& tally = tallies[entry.kind];
    tally.kept += entry.state == LedgerState::Kept ? 1 : 0;
    tally.changed += entry.state == LedgerState::Changed ? 1 : 0;
    tally.dropped += entry.state == LedgerState::Dropped ? 1 : 0;
    if (entry.state == LedgerState::Dropped) drops[{entry.input, entry.reason}].push_back(entry.item);
  }
  TextTable table;
  for (const auto& [kind, tally] : tallies)
    table.add({std::string(to_string(kind)) + "s", fmt::format("{} kept", tally.kept),
               tally.changed > 0 ? fmt::format("{} changed", tally.changed) : "",
               tally.dropped > 0 ? fmt::format("{} dropped", tally.dropped) : ""});
  std::string lines = table.str();
  for (auto& [place, items] : drops) {
    const std::size_t more = items.size() > kListedDrops ? items.size() - kListedDrops : 0;
    items.resize(items.size() - more);
    lines += fmt::format("  {}: {}{}: {}\n", place.first, joined(items),
                         more > 0 ? fmt::format(" and {} more", more) : "", place.second);
  }
  return lines;
}

std::string issue_lines(const std::vector<Issue>& issues) {
  std::string lines;
  for (const Issue& i : issues)
    lines += fmt::format("{} {}: {} [{}]\n", i.severity == Severity::Warning ? " !" : "  ", i.place,
                         i.message, i.code);
  return lines;
}

std::string all_issue_lines(const Report& report) {
  std::string lines;
  for (const InputReport& input : report.inputs) lines += issue_lines(input.repairs);
  return lines + issue_lines(report.issues);
}

std::string output_lines(const Report& report) {
  TextTable table;
  for (const FileReport& o : report.outputs) table.add({o.name, bytes_text(o.bytes)});
  return table.str();
}

}  // namespace

std::string to_text(const Report& report) {
  return fmt::format("{}  ({} {})\n", report.recipe.name, report.tool.name, report.tool.version) +
         section("inputs", input_lines(report)) + section("operations", operation_lines(report)) +
         section("result", result_lines(report)) + section("junctions", junction_lines(report)) +
         section("clips", clip_lines(report)) + section("nothing lost", ledger_lines(report)) +
         section("issues", all_issue_lines(report)) + section("files", output_lines(report));
}

std::string to_text(const Timings& timings) {
  std::vector<StageTiming> stages = timings.stages;
  std::stable_sort(stages.begin(), stages.end(),
                   [](const StageTiming& a, const StageTiming& b) { return a.cpu > b.cpu; });
  TextTable table;
  for (const StageTiming& s : stages)
    table.add(
        {s.stage, s.subject, s.outcome, fmt::format("{:.3f} s", s.wall), fmt::format("{:.3f} s cpu", s.cpu)});
  return table.str() + fmt::format("  in all {:.3f} s, {:.3f} s cpu, {} at most\n", timings.wall, timings.cpu,
                                   bytes_text(timings.peak_memory));
}

}  // namespace skinforge
