#include "finished_character.h"

#include <fstream>

#include "testing/point_index.h"

namespace skinforge::testing {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;

constexpr double kPlacedPosition = 1e-6;  // of the diagonal; a few float roundings
constexpr double kPlacedNormal = 1e-5;    // floats of a unit vector, turned and made unit again

json read_json(const fs::path& path) {
  return json::parse(std::ifstream(path), nullptr, true, true);
}

Similarity placement_of(const json& operation) {
  const auto q = operation.at("rotation_xyzw").get<std::vector<double>>();
  const auto t = operation.at("translation").get<std::vector<double>>();
  return {operation.at("scale"), quaternion_xyzw(q[0], q[1], q[2], q[3]), Vec3(t.data())};
}

// Finds the corners of one source by what a vertex of the result holds.
class CornerFinder {
 public:
  explicit CornerFinder(const PlacedSource& source)
      : source_(source), mesh_(source.model->character().mesh), index_(placed_positions()) {
    corners_of_.resize(mesh_.vertex_count());
    for (std::size_t c = 0; c < mesh_.corner_count(); ++c) corners_of_[mesh_.corners[c].index()].push_back(c);
  }

  std::optional<std::size_t> find(const Vec3& position, const std::vector<double>& normal,
                                  const std::vector<double>& uv) const {
    for (const std::size_t v : index_.near(position, kPlacedPosition * source_.diagonal()))
      for (const std::size_t c : corners_of_[v])
        if (has_position(v, position) && has_normal(c, normal) && has_uv(c, uv)) return c;
    return std::nullopt;
  }

 private:
  std::vector<Vec3> placed_positions() const {
    std::vector<Vec3> placed;
    for (const Vec3& p : mesh_.positions) placed.push_back(source_.placement * p);
    return placed;
  }
  bool has_position(std::size_t v, const Vec3& position) const {
    return !source_.is_base || mesh_.positions[v].cast<float>() == position.cast<float>();
  }
  bool has_normal(std::size_t corner, const std::vector<double>& normal) const {
    if (normal.empty() || mesh_.normals[corner].isZero(0)) return true;  // the file had none
    return is_same_normal(mesh_.normals[corner], Vec3(normal.data()));
  }
  bool is_same_normal(const Vec3& source, const Vec3& given) const {
    if (source_.is_base) return source.cast<float>() == given.cast<float>();
    return (source_.placement.rotation * source - given).norm() < kPlacedNormal;
  }
  bool has_uv(std::size_t corner, const std::vector<double>& uv) const {
    if (uv.empty() || mesh_.uvs.empty()) return true;
    return mesh_.uvs[0][corner].cast<float>() == Vec2(uv.data()).cast<float>();
  }

  const PlacedSource& source_;
  const PolygonMesh& mesh_;
  PointIndex index_;
  std::vector<std::vector<std::size_t>> corners_of_;
};

}  // namespace

FinishedCharacter::FinishedCharacter(const fs::path& recipe, const fs::path& folder,
                                     const std::vector<std::string>& arguments)
    : recipe_(read_json(recipe)) {
  const fs::path out = folder / recipe.stem();
  std::vector<std::string> words = {
      "build",   fs::absolute(recipe), "--quiet", "--report", "json", "--out", out,
      "--cache", folder / "cache"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  run_ = Program(SKINFORGE_BINARY, words, folder).finish();
  if (run_.status != 0) return;
  report_ = read_json(out / "report.json");
  glb_path_ = out / (recipe_.at("name").get<std::string>() + ".glb");
  glb_ = std::make_unique<GltfEvaluator>(glb_path_);
  read_sources(recipe.parent_path());
}

void FinishedCharacter::read_sources(const fs::path& folder) {
  for (const auto& [name, file] : recipe_.at("inputs").items())
    inputs_[name] = &source_model(folder / file.get<std::string>());
  const std::string base = recipe_.at("base");
  sources_.push_back({base, inputs_.at(base), {}, true});
  for (const json& operation : report_.at("operations")) {
    const std::string input = operation.at("input");
    if (!input.empty()) sources_.push_back({input, inputs_.at(input), placement_of(operation), false});
  }
}

int FinishedCharacter::animation(const std::string& name) const {
  for (int a = 0; a < glb_->animation_count(); ++a)
    if (glb_->animation_name(a) == name) return a;
  return -1;
}

std::size_t FinishedCharacter::source_clip(const json& clip) const {
  const auto& clips = input(clip.at("input")).character().clips;
  const auto found = std::find_if(clips.begin(), clips.end(),
                                  [&](const Clip& c) { return c.name == clip.at("source_clip"); });
  return static_cast<std::size_t>(found - clips.begin());
}

std::vector<std::string> FinishedCharacter::inputs_of_nodes() const {
  std::map<std::string, std::string> input_of;
  for (const json& joint : report_.at("joints")) input_of[joint.at("joint")] = joint.at("input");
  std::vector<std::string> inputs;
  for (std::size_t n = 0; n < glb_->json()["nodes"].size(); ++n)
    inputs.push_back(glb_->json()["nodes"][n].contains("mesh") ? "" : input_of[glb_->node_name(n)]);
  return inputs;
}

bool FinishedCharacter::has_operation(const std::string& kind) const {
  for (const json& operation : report_.at("operations"))
    if (operation.at("kind") == kind) return true;
  return false;
}

std::vector<Origin> FinishedCharacter::origins() const {
  std::vector<CornerFinder> finders(sources_.begin(), sources_.end());
  const auto points = glb_->bind_pose();
  const auto normals = glb_->attribute("NORMAL"), uvs = glb_->attribute("TEXCOORD_0");
  std::vector<Origin> origins(points.size());
  for (std::size_t v = 0; v < points.size(); ++v)
    for (std::size_t s = 0; s < finders.size() && origins[v].source < 0; ++s)
      if (const auto corner = finders[s].find(points[v], normals[v], uvs[v]))
        origins[v] = {static_cast<int>(s), *corner};
  return origins;
}

}  // namespace skinforge::testing
