#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/skin_weights.h"
#include "render/draw.h"

/// The pictures of a report, composed of single drawings. All are opaque; equal arguments give equal bytes.
namespace skinforge {

/// Front three-quarter, side and back three-quarter view of the character in its materials, in one row.
/// `size`: pixels along each square view.
Raster rest_picture(const Subject& subject, const Posture& posture = {}, int size = 640);

/// What a junction close-up shows.
struct JunctionShot {
  std::span<const FaceId> faces;  ///< the junction's, tinted
  Vec3 center = Vec3::Zero();     ///< of a ball around them, metres, model space
  double radius = 0;              ///< metres
  std::string title;              ///< written into the corner; may be empty
};

/// Two close-ups of a junction with wireframe, from the two sides that show most of it; back faces stand out
/// in red. The second view is at least 90 degrees away from the first.
Raster junction_picture(const Subject& subject, const JunctionShot& shot, const Posture& posture = {},
                        int size = 640);

/// Front and back three-quarter view, every vertex in the colour of its strongest joint.
Raster weights_picture(const Subject& subject, const SkinWeights& weights, std::size_t joint_count,
                       int size = 640);

/// One frame of a clip.
struct ClipFrame {
  double time = 0;                  ///< seconds, written below the frame
  std::vector<Vec3> positions;      ///< #V, metres, model space
  std::vector<FaceId> marked = {};  ///< faces to tint, because something is wrong there; says "worst" below
};

struct StripOptions {
  int width = 180;  ///< of one frame, pixels
  int height = 220;
  ViewAngles angles{radians(40), radians(10)};
};

/// The frames of a clip, one picture each, all through one camera that holds every frame; the time below
/// each, `title` (the clip's name) in the first.
std::vector<Raster> clip_frames(const Subject& subject, std::span<const ClipFrame> frames,
                                const std::string& title, const StripOptions& options = {});

/// The same in one row, all through one camera that holds every frame; normals follow the positions.
/// `title` (the clip's name) stands in the first frame's corner. No frames: one pixel.
Raster clip_picture(const Subject& subject, std::span<const ClipFrame> frames, const std::string& title,
                    const StripOptions& options = {});

}  // namespace skinforge
