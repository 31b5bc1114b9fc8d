#pragma once

#include <string>
#include <vector>

#include "deform/correctives.h"
#include "model/character.h"
#include "stages/artifacts.h"

namespace skinforge {

struct BakeRequest {
  DeformMethod method = DeformMethod::DualQuaternion;  ///< DualQuaternion, Poisson or Context
  std::size_t targets = 8;                             ///< at most; of Context all examples
  double enough = 1e-4;                                ///< of the diagonal of the bounding box
  std::size_t influences = 4;                          ///< that will be written
  // Of Context:
  std::vector<PosedShape> examples = {};
  bool with_rest = true;  ///< the rest pose is one more example, without change
  RadialKernel kernel = RadialKernel::Linear;
  std::vector<std::string> joints = {};  ///< by which poses are compared; empty: all but roots
};

/// Morph targets and their tracks, ready to be put into the character.
struct BakedCorrectives {
  std::vector<MorphTarget> targets;              ///< sorted by part; of each part all of them
  std::vector<std::vector<MorphTracks>> tracks;  ///< per clip, the new weights of each part
  std::string driver_json;                  ///< of Context: what computes the weights at run time; else empty
  double before = 0, largest = 0, rms = 0;  ///< metres (`Correctives`)
  double between = 0;  ///< metres: largest error half way between keys, where players mix the weights
  std::vector<double> by_count;

  template <class Archive>
  friend void fields(Archive& a, BakedCorrectives& b) {
    a(b.targets, b.tracks, b.driver_json, b.before, b.largest, b.rms, b.between, b.by_count);
  }
};

/// Times at which weights get keys: all key times of the clip's joints, and between them so many more that no
/// two are farther apart than 1 / 30 s. Rising, from 0 to the duration.
std::vector<double> corrective_times(const Clip& clip);

/// Plays every clip of the character with the method and bakes the difference from linear blending of the
/// weights that will be written. An issue at `place` states what was reached.
BakedCorrectives bake_character(const Character& character, const BakeRequest& request,
                                const std::string& place, IssueSink& issues);

/// Puts them in behind the morph targets and tracks that the character has.
void add_correctives(Character& character, const BakedCorrectives& correctives);

}  // namespace skinforge
