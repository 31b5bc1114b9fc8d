#pragma once

#include <cstdint>
#include <span>

#include "base/math.h"

namespace skinforge {

/// What is better: all faces in sum; the worst of them above all; or all faces in sum by all their corners,
/// and long enough that little moves any more.
enum class FaceGoal : std::uint8_t { All, Worst, Settled };

/// The wanted surface beneath the middle of a face, from where it is told beside it: asking anew for each
/// place tried costs ten times as much.
struct SurfaceBeneath {
  Vec3 centre;   ///< of the face, when it was asked
  Vec3 outward;  ///< away from the solid; need not be unit
  double distance = 0;
};

/// How bad faces are (junction.md, rung 2, step 5): what their scaled Jacobian lacks to 1, raised to a power
/// that is the higher the more the worst shall count, their distance from the wanted surface, and whether
/// they all but turn away from it. A face that turns away is worse than any other.
class FaceBadness {
 public:
  /// `voxel`: metres; infinite where distances do not matter and the way outward is a guess.
  FaceBadness(FaceGoal goal, double voxel);

  /// Of a triangle or quad; at least 0, without unit.
  double of(std::span<const Vec3> corners, const SurfaceBeneath& beneath) const;

  /// What all that counts beside the lack of quality is worth, in [0, 1].
  double rest() const { return rest_; }

 private:
  FaceGoal goal_;
  double voxel_, rest_, facing_weight_;
};

}  // namespace skinforge
