#include "skinning/bone_heat.h"

#include <algorithm>
#include <cmath>

#include "base/expect.h"
#include "base/parallel.h"
#include "geometry/solid_voxels.h"

namespace skinforge {
namespace {

constexpr double kDropped = 1e-4;     // ours: cross-talk that artists prune
constexpr double kLeastShare = 0.05;  // ours: of a cell; keeps heat finite where a bone touches the surface
constexpr std::size_t kChunk = 512;

// The pieces of one joint.
struct Bone {
  JointId joint;
  std::vector<BoneSegment> segments;
};

std::vector<Bone> bones_of(std::span<const BoneSegment> segments) {
  std::vector<Bone> bones;
  for (const BoneSegment& segment : segments) {
    if (bones.empty() || bones.back().joint != segment.joint) bones.push_back({segment.joint, {}});
    bones.back().segments.push_back(segment);
  }
  return bones;
}

// Points along a bone, half a cell apart.
std::vector<Vec3> points_along(const Bone& bone, double cell) {
  std::vector<Vec3> points;
  for (const BoneSegment& s : bone.segments) {
    const int steps = std::max(1, static_cast<int>(std::ceil(2 * (s.b - s.a).norm() / cell)));
    for (int i = 0; i <= steps; ++i) points.push_back(s.a + (s.b - s.a) * i / steps);
  }
  return points;
}

double straight_distance(const Bone& bone, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const BoneSegment& s : bone.segments) least = std::min(least, s.distance(p));
  return least;
}

/// Which bone heats each vertex, and from how far.
struct Heaters {
  std::vector<std::size_t> bone;
  std::vector<double> distance;
};

Heaters find_heaters(std::span<const Vec3> positions, const std::vector<Bone>& bones,
                     const SolidVoxels& voxels) {
  std::vector<std::vector<double>> through(bones.size());
  parallel_for(bones.size(), [&](std::size_t k) {
    through[k] = voxels.distances_from(points_along(bones[k], voxels.size()));
  });
  Heaters heaters{std::vector<std::size_t>(positions.size(), 0), std::vector<double>(positions.size())};
  parallel_chunks(positions.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const std::int32_t cell = voxels.nearest(positions[v]);
      double least = std::numeric_limits<double>::infinity();
      for (const bool is_straight : {false, true}) {
        if (std::isfinite(least)) break;
        for (std::size_t k = 0; k < bones.size(); ++k) {
          // Of two bones equally far through cells, which are coarse, the one nearer in space.
          const double straight = straight_distance(bones[k], positions[v]);
          const double d =
              is_straight ? straight : std::max(straight, through[k][static_cast<std::size_t>(cell)]);
          if (d >= least) continue;
          least = d;
          heaters.bone[v] = k;
        }
      }
      heaters.distance[v] =
          std::max(straight_distance(bones[heaters.bone[v]], positions[v]), kLeastShare * voxels.size());
    }
  });
  return heaters;
}

// Third of the areas of the triangles around each vertex.
std::vector<double> masses(std::span<const Vec3> positions, std::span<const VertexTriangle> triangles) {
  std::vector<double> mass(positions.size(), 0.0);
  for (const VertexTriangle& t : triangles) {
    const Vec3& a = positions[t[0].index()];
    const double sixth = (positions[t[1].index()] - a).cross(positions[t[2].index()] - a).norm() / 6;
    for (const VertexId v : t) mass[v.index()] += sixth;
  }
  return mass;
}

// Laplacian without negative cotangents, plus heat on the diagonal: an M-matrix.
LowerColumns heat_system(std::span<const VertexTriangle> triangles, const CotangentWeights& cotangents,
                         std::span<const double> heat) {
  std::vector<std::array<double, 3>> positive = cotangents.half_cotangents;
  for (auto& of_triangle : positive)
    for (double& weight : of_triangle) weight = std::max(weight, 0.0);
  std::vector<std::int32_t> local(heat.size());
  for (std::size_t v = 0; v < local.size(); ++v) local[v] = static_cast<std::int32_t>(v);
  LowerColumns system = laplacian_block(triangles, positive, local, heat.size());
  for (std::size_t v = 0; v < heat.size(); ++v)
    system.value[static_cast<std::size_t>(system.begin[v])] += heat[v];
  return system;
}

SkinWeights rows_of(std::span<const double> solution, const std::vector<Bone>& bones) {
  SkinWeights weights;
  const std::size_t n = solution.size() / bones.size();
  for (std::size_t v = 0; v < n; ++v) {
    std::vector<Influence> row;
    for (std::size_t k = 0; k < bones.size(); ++k)
      if (solution[v * bones.size() + k] > kDropped)
        row.push_back({bones[k].joint, solution[v * bones.size() + k]});
    weights.push_row(normalised_row(std::move(row)));
  }
  return weights;
}

}  // namespace

SkinWeights bone_heat_weights(std::span<const Vec3> positions, std::span<const VertexTriangle> triangles,
                              std::span<const BoneSegment> segments, const BoneHeatOptions& options) {
  SF_EXPECT(!segments.empty());
  const std::vector<Bone> bones = bones_of(segments);
  std::vector<std::array<std::int32_t, 3>> soup;
  for (const VertexTriangle& t : triangles) soup.push_back({t[0].value, t[1].value, t[2].value});
  const SolidVoxels voxels(positions, soup, options.resolution);
  const Heaters heaters = find_heaters(positions, bones, voxels);
  std::vector<double> heat = masses(positions, triangles);
  for (std::size_t v = 0; v < heat.size(); ++v) {
    if (heat[v] <= 0) heat[v] = 1;  // of no face, or of faces without area: its bone alone
    heat[v] /= heaters.distance[v] * heaters.distance[v];
  }
  std::vector<double> solution(positions.size() * bones.size(), 0.0);
  for (std::size_t v = 0; v < heat.size(); ++v) solution[v * bones.size() + heaters.bone[v]] = heat[v];
  SparseFactor(heat_system(triangles, cotangent_weights(positions, triangles), heat))
      .solve(solution, bones.size());
  return rows_of(solution, bones);
}

}  // namespace skinforge
