#pragma once

#include <optional>
#include <span>
#include <vector>

#include "render/subject.h"
#include "render/view.h"

namespace skinforge {

/// Where the character's vertices are for one picture.
struct Posture {
  std::span<const Vec3> positions = {};  ///< #V, metres, model space; empty: the mesh's own
  std::span<const Vec3> normals =
      {};  ///< #C, unit; empty: the mesh's own at rest, else `Subject::normals_at`
};

struct DrawOptions {
  int width = 640;  ///< pixels, at least 1
  int height = 640;
  bool wireframe = false;            ///< edges of polygons, without the diagonals of their triangulation
  std::optional<double> floor = {};  ///< height of a floor that only catches shadows (metres); none: no floor
  std::span<const Vec3> vertex_colors =
      {};                                  ///< #V, linear RGB in place of the materials; empty: the materials
  std::span<const FaceId> highlight = {};  ///< faces to tint
  Vec3 highlight_color = Vec3(0.9, 0.22, 0.04);  ///< linear RGB
  /// Linear RGB of the back of single-sided faces: shows what is inside out. None: not drawn, as engines do.
  std::optional<Vec3> back_face_color = {};
  bool alpha_is_coverage = false;  ///< alpha: share of the pixel that the character covers; else opaque
};

/// The character as seen from `view`, over a pale backdrop: shaded in linear light (lighting.h), 16 samples a
/// pixel. Base colour textures, factors, vertex colours, alpha cut-outs and blending (as coverage),
/// double-sided, emissive and unlit materials are honoured; normal, roughness and occlusion textures are not.
/// Equal arguments give equal bytes with any number of threads. Non-finite positions only cost the triangles
/// that touch them. An empty mesh gives the backdrop. Time: linear in triangles and pixels (render.md has
/// figures).
Raster draw(const Subject& subject, const Posture& posture, const View& view,
            const DrawOptions& options = {});

/// Share of a `pixels` x `pixels` picture that `faces` cover as seen from `view`, in [0, 1]: for choosing the
/// view that shows them best. Front faces only.
double visible_area(const Subject& subject, const Posture& posture, std::span<const FaceId> faces,
                    const View& view, int pixels = 96);

}  // namespace skinforge
