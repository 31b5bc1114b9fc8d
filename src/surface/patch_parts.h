#pragma once

#include "surface/junction_loop.h"
#include "surface/patch_mirror.h"

namespace skinforge {

/// A connected part of a junction's patch: with the loops that it joins, whose vertices are its fixed ones,
/// loop after loop.
struct PatchPart {
  TrianglePatch patch;
  std::vector<std::size_t> loops;    ///< of the junction
  std::vector<std::int32_t> vertex;  ///< per vertex of `patch`: its name in the whole
};

/// The parts of a patch whose fixed vertices are those of `loops`, by their lowest triangle. A loop that
/// no triangle touches belongs to none.
std::vector<PatchPart> split_parts(const TrianglePatch& whole, const std::vector<JunctionLoop>& loops);

/// The part that mirroring makes of a part.
struct PartImage {
  std::size_t part = 0;
  PatchMirror borders;  ///< per fixed vertex of the part its image, a fixed vertex of that other part
};

/// Where part `p` goes when `borders` says where the fixed vertices of the whole go; none where it meets
/// borders of several parts.
std::optional<PartImage> image_of_part(const std::vector<PatchPart>& parts, std::size_t p,
                                       const PatchMirror& borders);

/// Quads made for one part as quads of its image, whose fixed vertices are at `fixed`.
QuadPatch reflected(const QuadPatch& quads, const PatchMirror& borders, std::span<const Vec3> fixed);

/// Puts quads made for one part, with that part's fixed vertices, among those of the whole: positions and
/// faces are appended.
void add_part(QuadPatch& whole, const PatchPart& part, const QuadPatch& quads);

/// The triangles of a part as they are, as faces of the whole.
QuadPatch triangles_of(const PatchPart& part);

}  // namespace skinforge
