#pragma once

#include <span>
#include <vector>

#include "geometry/laplacian.h"
#include "skinning/handles.h"

namespace skinforge {

/// A surface whose vertices at one place are one. Parts of a model that touch (face groups, seams that an
/// importer kept) are separate surfaces to a Laplacian and would be bound apart.
struct WeldedSurface {
  std::vector<Vec3> positions;
  std::vector<VertexTriangle> triangles;  ///< those with three different corners
  std::vector<VertexId> welded;           ///< of each vertex of the original
  std::vector<VertexId> original;         ///< the first original of each vertex

  /// Handles of the original: a place is held by the joint that all its held vertices name; free where they
  /// differ.
  Handles weld(const Handles& handles) const;
  /// Values by welded vertex, one for each vertex of the original.
  Handles spread(const Handles& handles) const;
  SkinWeights spread(const SkinWeights& weights) const;
  std::vector<Vec3> spread(std::span<const Vec3> points) const;
  /// Values by original vertex, one for each welded vertex.
  SkinWeights gather(const SkinWeights& weights) const;
  std::vector<Vec3> gather(std::span<const Vec3> points) const;
};

/// Welds vertices whose positions are equal as floats, and where `weights` are given their rows, too. Welded
/// vertices stand in the order of their first original. O(n log n).
WeldedSurface weld_surface(std::span<const Vec3> positions, std::span<const VertexTriangle> triangles,
                           const SkinWeights* weights = nullptr);

}  // namespace skinforge
