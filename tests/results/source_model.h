#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/character.h"
#include "testing/gltf_evaluator.h"

namespace skinforge::testing {

/// An input of a recipe, as the finished character is compared with it. Where the vertices are at rest comes
/// from the importer; where they are when a clip plays from the independent reader for glTF files, and from a
/// plain player of the imported character for others.
class SourceModel {
 public:
  explicit SourceModel(const std::string& path);

  /// At most 4 influences a vertex, as a finished character has them.
  const Character& character() const { return character_; }
  /// Where each vertex of `character()` is.
  std::vector<Vec3> pose(std::size_t clip, double time) const;
  /// Whether some joint turns or moves visibly in a clip.
  bool moves(std::size_t clip) const;
  /// Of all joints in all clips, in radians a second; steps do not count.
  double fastest_turn() const;

 private:
  void find_file_points();

  Character character_;
  std::unique_ptr<GltfEvaluator> file_;
  std::vector<std::size_t> file_points_;  // per vertex, its place in the answers of `file_`
};

/// The model of a file, read once.
const SourceModel& source_model(const std::string& path);

/// How fast a track turns between two of its keys, in radians a second, at most.
double fastest_turn(const std::vector<double>& times, const std::vector<Quat>& values);

}  // namespace skinforge::testing
