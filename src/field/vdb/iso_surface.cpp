#include <openvdb/tools/VolumeToMesh.h>

#include "field/vdb/vdb_grid.h"
#include "field/vdb/vdb_module.h"

namespace skinforge {
namespace {

// Ours: the second diagonal must be shorter by a thousandth, far above the rounding of points, so that no
// last bit chooses between the equal diagonals of a symmetric surface.
constexpr double kClearlyShorter = 0.999;

bool changes_sign(float low, float high, float) {
  return low < 0 && high >= 0;
}

class SurfaceBuilder {
 public:
  SurfaceBuilder(const Lattice& lattice, const std::vector<openvdb::Vec3s>& points)
      : lattice_(lattice), points_(points), new_index_(points.size(), -1) {}

  void add(const openvdb::Vec4I& quad) {
    for (int i = 0; i < 4; ++i)
      if (!is_inside(points_[quad[i]])) return;
    const std::array<std::int32_t, 4> q{use(quad[0]), use(quad[1]), use(quad[2]), use(quad[3])};
    const auto length2 = [&](int a, int b) {
      return (surface_.positions[q[a]] - surface_.positions[q[b]]).squaredNorm();
    };
    if (length2(1, 3) >= kClearlyShorter * length2(0, 2)) {
      surface_.triangles.push_back({q[0], q[1], q[2]});
      surface_.triangles.push_back({q[0], q[2], q[3]});
    } else {
      surface_.triangles.push_back({q[0], q[1], q[3]});
      surface_.triangles.push_back({q[1], q[2], q[3]});
    }
  }

  IsoSurface take() { return std::move(surface_); }

 private:
  bool is_inside(const openvdb::Vec3s& p) const {
    for (int axis = 0; axis < 3; ++axis)
      if (p[axis] < 0 || p[axis] > static_cast<float>(lattice_.size[axis] - 1)) return false;
    return true;
  }

  std::int32_t use(std::uint32_t point) {
    std::int32_t& index = new_index_[point];
    if (index < 0) {
      index = static_cast<std::int32_t>(surface_.positions.size());
      const openvdb::Vec3s& p = points_[point];
      surface_.positions.push_back(lattice_.origin + lattice_.voxel * Vec3(p.x(), p.y(), p.z()));
    }
    return index;
  }

  const Lattice& lattice_;
  const std::vector<openvdb::Vec3s>& points_;
  std::vector<std::int32_t> new_index_;
  IsoSurface surface_;
};

}  // namespace

// Points are computed in index space, in float: a thousandth of a voxel is far above their rounding, and the
// result scales with the lattice. One layer of continued values lets the surface run out of the lattice; what
// OpenVDB closes beyond it is cut off again.
IsoSurface vdb::extract_iso_surface(const DistanceField& field) {
  const auto grid = sparse_grid(field, 1, 1, changes_sign);
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(*grid, points, quads, 0.0);
  SurfaceBuilder builder(field.lattice, points);
  for (const openvdb::Vec4I& quad : quads) builder.add(quad);
  return builder.take();
}

}  // namespace skinforge
