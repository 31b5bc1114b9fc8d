#include "source_model.h"

#include <filesystem>
#include <map>

#include "io/import.h"
#include "testing/point_index.h"
#include "testing/posed_points.h"
#include "visible_motion.h"

namespace skinforge::testing {
namespace {

constexpr std::size_t kInfluences = 4;  // the default of `output.influences`

SkinWeights cut_to_four(const SkinWeights& weights) {
  SkinWeights cut;
  for (std::size_t v = 0; v < weights.vertex_count(); ++v) {
    const auto row = weights.of(VertexId(v));
    cut.push_row(normalised_row({row.begin(), row.end()}, kInfluences));
  }
  return cut;
}

Character imported(const std::string& path) {
  IssueSink issues;
  Character character = import_character(path, issues);
  character.weights = cut_to_four(character.weights);
  return character;
}

bool is_gltf(const std::string& path) {
  const auto extension = std::filesystem::path(path).extension();
  return extension == ".glb" || extension == ".gltf";
}

std::vector<Quat> key_values(const QuatTrack& track) {
  if (track.interpolation != Interpolation::CubicSpline) return track.values;
  std::vector<Quat> values;
  for (std::size_t k = 0; k < track.times.size(); ++k) values.push_back(track.values[3 * k + 1].normalized());
  return values;
}

}  // namespace

SourceModel::SourceModel(const std::string& path) : character_(imported(path)) {
  if (!is_gltf(path)) return;
  file_ = std::make_unique<GltfEvaluator>(path);
  find_file_points();
}

// A vertex of the character is the point of the file that is at the same place in the middle of a clip: the
// importer welds, turns and scales, so neither numbers nor rest positions agree.
void SourceModel::find_file_points() {
  const double time = character_.clips.empty() ? 0 : character_.clips[0].duration / 2;
  const auto posed = character_.clips.empty() ? CharacterPlayer(character_).bind_pose()
                                              : CharacterPlayer(character_).pose(character_.clips[0], time);
  const PointIndex index(character_.clips.empty() ? file_->bind_pose() : file_->pose(0, time));
  for (const Vec3& p : posed) file_points_.push_back(index.nearest(p));
}

std::vector<Vec3> SourceModel::pose(std::size_t clip, double time) const {
  if (!file_) return CharacterPlayer(character_).pose(character_.clips[clip], time);
  const auto points = file_->pose(static_cast<int>(clip), time);
  std::vector<Vec3> posed;
  for (const std::size_t p : file_points_) posed.push_back(points[p]);
  return posed;
}

bool SourceModel::moves(std::size_t clip) const {
  const double length = character_.mesh.diagonal();
  for (const JointTracks& tracks : character_.clips[clip].joints) {
    for (const Quat& q : key_values(tracks.rotation))
      if (turns_visibly(tracks.rotation.values.front(), q)) return true;
    if (tracks.translation.interpolation == Interpolation::CubicSpline) continue;
    for (const Vec3& p : tracks.translation.values)
      if (moves_visibly(tracks.translation.values.front(), p, length)) return true;
  }
  return false;
}

double SourceModel::fastest_turn() const {
  double fastest = 0;
  for (const Clip& clip : character_.clips)
    for (const JointTracks& tracks : clip.joints)
      if (tracks.rotation.interpolation != Interpolation::Step)
        fastest =
            std::max(fastest, testing::fastest_turn(tracks.rotation.times, key_values(tracks.rotation)));
  return fastest;
}

const SourceModel& source_model(const std::string& path) {
  static std::map<std::string, std::unique_ptr<SourceModel>> known;
  auto& model = known[std::filesystem::canonical(path).string()];
  if (!model) model = std::make_unique<SourceModel>(path);
  return *model;
}

double fastest_turn(const std::vector<double>& times, const std::vector<Quat>& values) {
  double fastest = 0;
  for (std::size_t k = 1; k < times.size(); ++k)
    fastest = std::max(fastest, values[k - 1].angularDistance(values[k]) / (times[k] - times[k - 1]));
  return fastest;
}

}  // namespace skinforge::testing
