#pragma once

#include <Eigen/Geometry>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "base/archive.h"
#include "base/math.h"

namespace skinforge {

/// A regular lattice: point (i, j, k) sits at origin + voxel * (i, j, k), metres, model space.
struct Lattice {
  Vec3 origin = Vec3::Zero();
  double voxel = 0;
  std::array<std::int32_t, 3> size = {0, 0, 0};  ///< points along x, y, z

  std::size_t count() const { return static_cast<std::size_t>(size[0]) * size[1] * size[2]; }
  std::size_t index(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * size[1] + j) * size[0] + i;
  }
  Vec3 point(int i, int j, int k) const { return origin + voxel * Vec3(i, j, k); }
  Eigen::AlignedBox3d box() const { return {origin, point(size[0] - 1, size[1] - 1, size[2] - 1)}; }

  template <class Archive>
  friend void fields(Archive& a, Lattice& l) {
    a(l.origin, l.voxel, l.size);
  }
};

/// Signed distances on a lattice, negative inside; x runs fastest.
struct DistanceField {
  Lattice lattice;
  /// In voxels, so that the same scene at another size has the same floats: rounding that depends on the size
  /// would be thousands of times that of doubles, and what is made of a field would hang on it.
  std::vector<float> values;

  /// Trilinear value in metres at a model-space point; points outside the lattice take the value of the
  /// nearest lattice point.
  double at(const Vec3& p) const;
  /// Gradient of the trilinear interpolant by central differences of half a voxel.
  Vec3 gradient(const Vec3& p) const;

  template <class Archive>
  friend void fields(Archive& a, DistanceField& f) {
    a(f.lattice, f.values);
  }
};

/// Surface of a field: quads and triangles with shared vertices, counter-clockwise from outside.
struct IsoSurface {
  std::vector<Vec3> positions;
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< quads split along the shorter diagonal
};

/// Zero surface of the field by dual contouring: in each cell a vertex for each sheet that passes through it,
/// at the mean of the points where that crosses edges (in float, in voxels), and a quad across each edge that
/// is crossed. Vertex for vertex OpenVDB's `volumeToMesh` at adaptivity 0, whose order and whose choice
/// between the two ways to join an ambiguous face it follows; that would have to be loaded first. Closed
/// inside the lattice; open where it meets the lattice's faces.
IsoSurface extract_iso_surface(const DistanceField& field);

/// The field as a `.vdb` file that other tools open: one FloatGrid "distance" of class level set, with its
/// transform. No dates, hosts or random ids in the bytes: equal fields give equal files.
Bytes to_vdb(const DistanceField& field);

}  // namespace skinforge
