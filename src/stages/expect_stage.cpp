#include "stages/expect_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/text.h"
#include "geometry/mesh_measures.h"

namespace skinforge {
namespace {

// What "expect" may ask for, counted on the finished character and its file.
std::map<std::string, double> quantities(const Character& c, std::size_t bytes) {
  std::size_t triangles = 0, influences = 0;
  for (std::size_t f = 0; f < c.mesh.face_count(); ++f) triangles += c.mesh.face(FaceId(f)).size() - 2;
  for (std::size_t v = 0; v < c.weights.vertex_count(); ++v)
    influences = std::max(influences, c.weights.of(VertexId(v)).size());
  const auto number = [](std::size_t n) { return static_cast<double>(n); };
  return {{"triangles", number(triangles)},
          {"vertices", number(c.mesh.vertex_count())},
          {"joints", number(c.skeleton.size())},
          {"influences", number(influences)},
          {"materials", number(c.materials.size())},
          {"images", number(c.images.size())},
          {"morph_targets", number(c.morphs.size())},
          {"clips", number(c.clips.size())},
          {"bytes", number(bytes)}};
}

class Expect final : public Stage {
 public:
  Expect(ArtifactNames names, const Recipe& recipe) : names_(std::move(names)), expect_(recipe.expect) {
    influences_ = static_cast<std::size_t>(recipe.output.influences);
    for (const char* key : {"watertight", "clip_names"}) note_place(recipe, key);
    for (const auto& [key, range] : expect_.ranges) note_place(recipe, key);
  }

  StageInfo info() const override {
    return {.name = "expect",
            .version = 1,
            .reads = {names_.result(), names_.glb()},
            .writes = {names_.expectations()}};
  }
  void add_to_key(Hasher& key) const override {
    key.add_value("expect", expect_);
    key.add_value("influences", influences_);
  }

  void run(const StageInput& in, StageOutput& out, IssueSink&) const override {
    const auto& result = in.get<Character>(names_.result());
    auto found = quantities(result, in.get<Bytes>(names_.glb()).size());
    found["influences"] = std::min(found["influences"], static_cast<double>(influences_));  // as written
    std::vector<std::string> faults;
    for (const auto& [key, range] : expect_.ranges) check_range(key, range, found.at(key), faults);
    check_closed(result, faults);
    for (const std::string& clip : expect_.clips) check_clip(result, clip, faults);
    if (!faults.empty()) throw Error(ExitCode::Invalid, fmt::format("{}", fmt::join(faults, "; ")));
    out.put(names_.expectations(), found);
  }

 private:
  void note_place(const Recipe& recipe, const std::string& key) {
    places_[key] = recipe.place("/expect/" + key);
  }

  void check_range(const std::string& key, const ExpectedRange& range, double found,
                   std::vector<std::string>& faults) const {
    if (range.max && found > *range.max)
      faults.push_back(fmt::format("{}: {} found, at most {} allowed", places_.at(key), found, *range.max));
    if (range.min && found < *range.min)
      faults.push_back(fmt::format("{}: {} found, at least {} wanted", places_.at(key), found, *range.min));
  }

  void check_closed(const Character& result, std::vector<std::string>& faults) const {
    if (!expect_.watertight) return;
    const std::size_t open = measure_topology(result.mesh).boundary_edges;
    if (*expect_.watertight != (open == 0))
      faults.push_back(fmt::format("{}: the surface has {} open edges", places_.at("watertight"), open));
  }

  void check_clip(const Character& result, const std::string& clip, std::vector<std::string>& faults) const {
    std::vector<std::string> names;
    for (const Clip& c : result.clips) names.push_back(c.name);
    if (std::find(names.begin(), names.end(), clip) == names.end())
      faults.push_back(fmt::format("{}: no clip \"{}\"{}", places_.at("clip_names"), printable(clip),
                                   nearest_hint(clip, names)));
  }

  ArtifactNames names_;
  Expectations expect_;
  std::size_t influences_ = 4;
  std::map<std::string, std::string> places_;  // lead messages only
};

}  // namespace

StagePointer make_expect_stage(const ArtifactNames& names, const Recipe& recipe) {
  return std::make_unique<Expect>(names, recipe);
}

}  // namespace skinforge
