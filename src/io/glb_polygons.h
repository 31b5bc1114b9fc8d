#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/math.h"

namespace skinforge {

/// Turns polygons into triangles so that FB_ngon_encoding can read them back: each polygon is a fan whose
/// triangles start at one vertex, and no polygon starts at the vertex at which the one before it started.
/// Source: FB_ngon_encoding, https://github.com/KhronosGroup/glTF/pull/1620
class FanWriter {
 public:
  /// Appends the triangles of one polygon. `positions` and `vertices` are those of its corners, in order; the
  /// vertices are what is written. A quad is split from its first corner unless a half of it would turn over,
  /// as `triangulate` does. A polygon that no fan covers without folding is written as separate triangles
  /// (ear clipping).
  void add(std::span<const Vec3> positions, std::span<const std::uint32_t> vertices);

  const std::vector<std::uint32_t>& indices() const { return indices_; }
  /// Polygons that had to be written as separate triangles.
  std::size_t broken_count() const { return broken_; }

 private:
  void add_fan(std::span<const std::uint32_t> vertices, std::size_t start);
  void add_ears(std::span<const Vec3> positions, std::span<const std::uint32_t> vertices);
  std::optional<std::size_t> first_free(std::span<const std::size_t> starts,
                                        std::span<const std::uint32_t> vertices) const;

  std::vector<std::uint32_t> indices_;
  std::optional<std::uint32_t> last_start_;
  std::size_t broken_ = 0;
};

}  // namespace skinforge
