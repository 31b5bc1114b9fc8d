#include "deform/face_context.h"

#include <Eigen/LU>

#include "base/expect.h"
#include "base/parallel.h"
#include "geometry/triangle_math.h"
#include "skeleton/rotations.h"

namespace skinforge {
namespace {

constexpr std::size_t kChunk = 1024;  // ours: faces a task

Mat3 frame_of(const std::array<Vec3, 3>& t) {
  Mat3 frame;
  frame.col(0) = t[1] - t[0];
  frame.col(1) = t[2] - t[0];
  frame.col(2) = frame.col(0).cross(frame.col(1)).normalized();
  return frame;
}

std::array<Vec3, 3> corners_of(std::span<const Vec3> positions, const VertexTriangle& t) {
  return {positions[t[0].index()], positions[t[1].index()], positions[t[2].index()]};
}

}  // namespace

Mat3 triangle_map(const std::array<Vec3, 3>& rest, const std::array<Vec3, 3>& posed) {
  if (is_degenerate(rest)) return Mat3::Identity();
  return frame_of(posed) * frame_of(rest).inverse();
}

FaceContext::FaceContext(const PoissonStitcher& stitcher, const FaceBlend& blend, std::span<const Vec3> rest,
                         std::span<const VertexTriangle> triangles,
                         std::span<const std::vector<Vec3>> examples,
                         std::span<const std::vector<Quat>> bones, Form form) {
  SF_EXPECT(examples.size() == bones.size());
  for (std::size_t j = 0; j < examples.size(); ++j) {
    const std::vector<Quat> rotations = blend.rotations(bones[j]);
    std::vector<Mat3> maps(triangles.size());
    parallel_chunks(maps.size(), kChunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f)
        maps[f] = rotations[f].conjugate().toRotationMatrix() *
                  triangle_map(corners_of(rest, triangles[f]), corners_of(examples[j], triangles[f]));
    });
    unposed_.emplace_back();
    if (form == Form::Stitched) {
      unposed_.back() = stitcher.stitch(maps, rest);
      for (std::size_t f = 0; f < maps.size(); ++f)
        maps[f] = triangle_map(corners_of(rest, triangles[f]), corners_of(unposed_.back(), triangles[f]));
    }
    std::vector<Quat> rotation(maps.size());
    std::vector<Mat3> stretch(maps.size());
    parallel_chunks(maps.size(), kChunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) {
        const Mat3 q = nearest_rotation(maps[f]);
        rotation[f] = Quat(q);
        stretch[f] = q.transpose() * maps[f];
      }
    });
    maps_.push_back(std::move(maps));
    rotation_.push_back(std::move(rotation));
    stretch_.push_back(std::move(stretch));
  }
}

std::vector<Mat3> FaceContext::maps(std::span<const Quat> rotations, std::span<const double> weights,
                                    FaceContextKind kind) const {
  SF_EXPECT(weights.size() == maps_.size());
  std::vector<Mat3> result(rotations.size());
  parallel_chunks(result.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    std::vector<WeightedRotation> terms(weights.size());
    for (std::size_t f = begin; f < end; ++f) {
      Mat3 sum = Mat3::Zero();
      for (std::size_t j = 0; j < weights.size(); ++j) {
        sum += weights[j] * (kind == FaceContextKind::Linear ? maps_[j][f] : stretch_[j][f]);
        terms[j] = {rotation_[j][f], weights[j]};
      }
      const Quat turn =
          kind == FaceContextKind::Linear ? rotations[f] : rotations[f] * average_rotation(terms);
      result[f] = turn.toRotationMatrix() * sum;
    }
  });
  return result;
}

}  // namespace skinforge
