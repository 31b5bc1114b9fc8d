#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/mirror_symmetry.h"
#include "surface/fusion_solid.h"
#include "surface/preserved.h"

namespace skinforge {

/// How the placed sources map onto each other across the plane of symmetry of the base (junction.md d.1). A
/// source in the middle maps onto itself, a left wing onto a right one.
struct SourceMirror {
  MirrorPlane plane;
  double matched = 0;                         ///< share of the base's vertices that have an image
  std::vector<SourceId> image;                ///< per source; invalid where it has none
  std::vector<std::vector<VertexId>> vertex;  ///< per source, per vertex: its image in the image source
  std::vector<std::vector<FaceId>> face;  ///< per source, per face: the face of the images of its vertices
};

/// None when the base, source 0, has no plane of symmetry. A vertex may lie off its image by a fraction of an
/// edge. O(n log n) in the vertices, for each pair of sources of equal size.
std::optional<SourceMirror> find_source_mirror(std::span<const PreservedSource> sources);

/// Whether a junction's participants map onto those of another one (or of the same): each onto one that
/// takes part in the same way, with the same presence, but for few vertices.
bool are_mirror_images(const SourceMirror& mirror, std::span<const SiteParticipant> a,
                       std::span<const SiteParticipant> b);

/// Discards the images of discarded faces, so that equal choices of a last bit or of an order in `preserved`
/// leave the same on both sides. `site_image`: per site the one that it maps onto, or -1. Returns how many.
std::size_t discard_images(std::span<PreservedSource> sources, const SourceMirror& mirror,
                           std::span<const std::int32_t> site_image);

/// Per border vertex of `from`, loop after loop: its image among those of `to`. None when a vertex or a whole
/// loop has no image.
std::optional<std::vector<std::int32_t>> border_images(const SourceMirror& mirror,
                                                       const std::vector<JunctionLoop>& from,
                                                       const std::vector<JunctionLoop>& to);

}  // namespace skinforge
