#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/planning.h"
#include "cli/recipe_tasks.h"
#include "cli/session.h"

namespace skinforge {
using nlohmann::json;

namespace {
// A stage needs what another one makes.
struct Edge {
  std::string from, to;  // labels
  std::vector<std::string> artifacts;
};

struct StageGraph {
  std::vector<std::pair<std::string, std::string>> stages;  // label, state
  std::vector<Edge> edges;
};

StageGraph graph_of(Session& session) {
  StageGraph graph;
  for (const StagePlan& plan : plan_recipe(session).stages)
    graph.stages.emplace_back(plan.info.label(), state_name(plan.state));
  std::map<std::string, std::string> maker;  // of each artifact
  for (const StageInfo& stage : session.engine().stages())
    for (const std::string& artifact : stage.writes) maker[artifact] = stage.label();
  for (const StageInfo& stage : session.engine().stages()) {
    std::map<std::string, Edge> from;
    for (const std::string& artifact : stage.reads) {
      const auto made = maker.find(artifact);
      if (made == maker.end()) continue;  // a file
      Edge& edge = from.try_emplace(made->second, Edge{made->second, stage.label(), {}}).first->second;
      edge.artifacts.push_back(artifact);
    }
    for (auto& [label, edge] : from) graph.edges.push_back(std::move(edge));
  }
  return graph;
}

std::string quoted(const std::string& text) {
  std::string safe = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') safe += '\\';
    safe += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
  }
  return safe + "\"";
}

// What would run stands out.
std::string dot_of(const StageGraph& graph, const std::string& name) {
  std::string text = fmt::format(
      "digraph {} {{\n  rankdir=LR;\n  node [shape=box, fontname=\"sans-serif\"];\n", quoted(name));
  for (const auto& [label, state] : graph.stages)
    text += fmt::format("  {}{};\n", quoted(label),
                        state == "hit" ? "" : " [style=filled, fillcolor=\"#ffe9a8\"]");
  for (const Edge& edge : graph.edges)
    text += fmt::format("  {} -> {};\n", quoted(edge.from), quoted(edge.to));
  return text + "}\n";
}

json json_of(const StageGraph& graph, const std::string& name) {
  json stages = json::array(), edges = json::array();
  for (const auto& [label, state] : graph.stages) stages.push_back({{"stage", label}, {"state", state}});
  for (const Edge& edge : graph.edges)
    edges.push_back({{"from", edge.from}, {"to", edge.to}, {"artifacts", edge.artifacts}});
  return {{"name", name}, {"stages", std::move(stages)}, {"edges", std::move(edges)}};
}
}  // namespace

ExitCode graph_command(const CommandLine& line, Console& console) {
  Session session(line, only_recipe(line), console);
  const StageGraph graph = graph_of(session);
  session.tell_trouble();
  const std::string& name = session.recipe().name;
  if (line.json || line.format == "json")
    print_data(json_of(graph, name).dump(2, ' ', false, json::error_handler_t::replace));
  else
    print_data(dot_of(graph, name));
  return ExitCode::Ok;
}

}  // namespace skinforge
