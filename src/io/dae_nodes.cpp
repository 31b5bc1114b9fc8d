#include "io/dae_nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/limits.h"
#include "base/text.h"

namespace skinforge {
namespace {

using Text = std::string_view;

/// The node elements, and what each holds: the nodes within it and those that it names.
struct NodeGraph {
  std::vector<Text> ids;
  std::vector<std::vector<std::size_t>> holds;
};

/// Position of the '>' that ends the tag at `at`, quoted ones left out; the end of the document if there is
/// none.
std::size_t end_of_tag(Text document, std::size_t at) {
  char quote = 0;
  for (; at < document.size(); ++at) {
    const char c = document[at];
    if (quote == 0 && c == '>') return at;
    if (quote == 0 && (c == '"' || c == '\''))
      quote = c;
    else if (c == quote)
      quote = 0;
  }
  return document.size();
}

bool is_tag(Text tag, Text name) {
  if (!tag.starts_with(name)) return false;
  return tag.size() == name.size() || std::isspace(static_cast<unsigned char>(tag[name.size()])) ||
         tag[name.size()] == '/';
}

Text attribute(Text tag, Text name) {
  const std::string start = fmt::format(" {}=\"", name);
  const auto begin = tag.find(start);
  if (begin == Text::npos) return {};
  const Text value = tag.substr(begin + start.size());
  return value.substr(0, value.find('"'));
}

/// Walks over the tags of a document.
class NodeScan {
 public:
  explicit NodeScan(Text document) : document_(document) {}

  NodeGraph scan() {
    for (std::size_t at = 0; (at = document_.find('<', at)) != Text::npos;) {
      const Text rest = document_.substr(at);
      if (rest.starts_with("<!--"))
        at = behind("-->", at);
      else if (rest.starts_with("<![CDATA["))
        at = behind("]]>", at);
      else
        at = read_tag(at + 1);
    }
    resolve();
    return std::move(graph_);
  }

 private:
  std::size_t behind(Text mark, std::size_t at) const {
    const auto found = document_.find(mark, at);
    return found == Text::npos ? document_.size() : found + mark.size();
  }

  /// Returns where it ends.
  std::size_t read_tag(std::size_t begin) {
    const std::size_t end = end_of_tag(document_, begin);
    const Text tag = document_.substr(begin, end - begin);
    if (is_tag(tag, "node")) {
      add_node(tag);
    } else if (is_tag(tag, "/node")) {
      if (!open_.empty()) open_.pop_back();
    } else if (is_tag(tag, "instance_node") && !open_.empty()) {
      if (const Text url = attribute(tag, "url"); url.starts_with('#'))
        named_.push_back({open_.back(), url.substr(1)});
    }
    return end;
  }

  void add_node(Text tag) {
    const std::size_t node = graph_.ids.size();
    graph_.ids.push_back(attribute(tag, "id"));
    graph_.holds.emplace_back();
    by_id_.try_emplace(graph_.ids.back(), node);
    if (!open_.empty()) graph_.holds[open_.back()].push_back(node);
    if (!tag.ends_with('/')) open_.push_back(node);
  }

  void resolve() {
    for (const auto& [node, id] : named_)
      if (const auto found = by_id_.find(id); found != by_id_.end() && !id.empty())
        graph_.holds[node].push_back(found->second);
  }

  Text document_;
  NodeGraph graph_;
  std::vector<std::size_t> open_;
  std::vector<std::pair<std::size_t, Text>> named_;
  std::map<Text, std::size_t> by_id_;
};

/// Counts what each node becomes, from the innermost outwards.
class NodeCount {
 public:
  explicit NodeCount(const NodeGraph& graph) : graph_(graph), counts_(graph.ids.size(), kUnseen) {}

  void check() {
    for (std::size_t node = 0; node < counts_.size(); ++node)
      if (counts_[node] == kUnseen) count_below(node);
  }

 private:
  static constexpr std::uint64_t kUnseen = 0, kOpen = UINT64_MAX;
  struct Step {
    std::size_t node, next;  ///< the next of what it holds
  };

  void count_below(std::size_t root) {
    std::vector<Step> path;
    enter(root, path);
    while (!path.empty()) {
      Step& step = path.back();
      const auto& holds = graph_.holds[step.node];
      if (step.next == holds.size()) {
        finish(step.node);
        path.pop_back();
      } else if (const std::size_t child = holds[step.next++]; counts_[child] == kUnseen) {
        enter(child, path);
      } else if (counts_[child] == kOpen) {
        throw Error(ExitCode::BadInput, fmt::format("COLLADA: node \"{}\" is its own ancestor", name(child)));
      }
    }
  }

  void enter(std::size_t node, std::vector<Step>& path) {
    counts_[node] = kOpen;
    path.push_back({node, 0});
  }

  void finish(std::size_t node) {
    std::uint64_t count = 1;  // each summand is within the limit, and there are no more than bytes
    for (const std::size_t child : graph_.holds[node]) count += counts_[child];
    if (count > limits().nodes)
      throw Error(ExitCode::BadInput, fmt::format("COLLADA: node \"{}\" becomes {} nodes, {}", name(node),
                                                  count, limit_hint("nodes")));
    counts_[node] = count;
  }

  std::string name(std::size_t node) const { return printable(std::string(graph_.ids[node])); }

  const NodeGraph& graph_;
  std::vector<std::uint64_t> counts_;
};

}  // namespace

void check_dae_nodes(std::string_view document) {
  const NodeGraph graph = NodeScan(document).scan();
  NodeCount(graph).check();
}

}  // namespace skinforge
