#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "io/glb_map.h"
#include "stages/inputs.h"
#include "stages/stages.h"

namespace skinforge {
namespace {
using nlohmann::json;

constexpr std::int64_t kNewFace = -1;  // of a junction

// Runs [code, count] of equal codes.
json runs_of(const std::vector<std::int64_t>& codes) {
  json runs = json::array();
  for (std::size_t i = 0; i < codes.size();) {
    std::size_t end = i;
    while (end < codes.size() && codes[end] == codes[i]) ++end;
    runs.push_back({codes[i], end - i});
    i = end;
  }
  return runs;
}

/// {"sources": ["horse", "man", "man 2"], "primitives": [[[0, 1200], [-1, 168], ...], ...]}: for each
/// primitive of the GLB runs of triangles with their source; -1: made by a junction.
class View final : public Stage {
 public:
  View(ArtifactNames names, const Recipe& recipe) : names_(std::move(names)), inputs_(input_names(recipe)) {}

  StageInfo info() const override {
    return {.name = "view",
            .version = 1,
            .reads = {names_.result(), names_.surface(), names_.graft()},
            .writes = {names_.view()}};
  }
  void add_to_key(Hasher& key) const override { key.add_value("inputs", inputs_); }

  void run(const StageInput& in, StageOutput& out, IssueSink&) const override {
    const auto& faces = in.get<SurfaceResult>(names_.surface()).joined.faces;
    json primitives = json::array();
    for (const GlbMap::Primitive& primitive : glb_map(in.get<Character>(names_.result())).primitives) {
      std::vector<std::int64_t> codes;
      for (const FaceId f : primitive.faces) {
        const SourceId source = faces[f.index()].source;
        codes.push_back(source.is_valid() ? static_cast<std::int64_t>(source.index()) : kNewFace);
      }
      primitives.push_back(runs_of(codes));
    }
    const json view = {{"sources", source_names(in.get<Graft>(names_.graft()))},
                       {"primitives", std::move(primitives)}};
    const std::string text = view.dump();
    const auto bytes = std::as_bytes(std::span(text));
    out.put(names_.view(), Bytes(bytes.begin(), bytes.end()));
  }

 private:
  // An input that is used again gets a number.
  std::vector<std::string> source_names(const Graft& graft) const {
    std::map<std::size_t, int> uses;
    std::vector<std::string> names;
    for (const GraftSource& source : graft.sources) {
      const int use = ++uses[source.input];
      names.push_back(use == 1 ? inputs_[source.input] : fmt::format("{} {}", inputs_[source.input], use));
    }
    return names;
  }

  ArtifactNames names_;
  std::vector<std::string> inputs_;
};

}  // namespace

StagePointer make_view_stage(const ArtifactNames& names, const Recipe& recipe) {
  return std::make_unique<View>(names, recipe);
}

}  // namespace skinforge
