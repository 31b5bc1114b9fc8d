#pragma once

#include <span>
#include <string>
#include <vector>

#include "render/pictures.h"

/// Pictures of a skin: what holds it, what a joint moves, and what methods make of it.
namespace skinforge {

/// Front and back three-quarter view, every vertex in the colour of the joint that holds it, free ones pale.
/// `handles`: one a vertex, invalid = free.
Raster handles_picture(const Subject& subject, std::span<const JointId> handles, std::size_t joint_count,
                       int size = 640);

/// Front and back three-quarter view of the weights of one joint, pale 0 to dark red 1.
Raster joint_weights_picture(const Subject& subject, const SkinWeights& weights, JointId joint,
                             const std::string& title, int size = 640);

/// The same frames by several methods.
struct MethodFrames {
  std::string title;
  std::vector<ClipFrame> frames = {};
  std::vector<std::string> captions = {};  ///< one a frame, written below it; may be empty
  /// [frame][#V], in [0, 1]: drawn as heat over the surface; empty: the materials.
  std::vector<std::vector<double>> heat = {};
};

/// One row a method, one column a frame, all through one camera.
Raster methods_picture(const Subject& subject, std::span<const MethodFrames> methods,
                       const StripOptions& options = {.width = 260, .height = 300});

}  // namespace skinforge
