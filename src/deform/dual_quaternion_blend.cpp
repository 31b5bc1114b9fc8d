#include "deform/dual_quaternion_blend.h"

#include "base/expect.h"
#include "base/parallel.h"
#include "skeleton/rotations.h"

namespace skinforge {
namespace {

constexpr std::size_t kChunk = 2048;  // ours: vertices a task
constexpr double kCancelled = 1e-6;   // ours: a mixed quaternion this short has lost its direction

std::vector<DualQuat> dual_quaternions(std::span<const RigidMotion> motions) {
  std::vector<DualQuat> all;
  all.reserve(motions.size());
  for (const RigidMotion& motion : motions) all.push_back(dual_quaternion(motion));
  return all;
}

// The mix of a row that is not empty, on the hemisphere of its largest weight; not normalised.
struct Mix {
  Vec4 real = Vec4::Zero(), dual = Vec4::Zero();
};
Mix mix_of(std::span<const Influence> row, std::span<const DualQuat> bones) {
  const DualQuat& pivot = bones[largest_influence(row).joint.index()];
  Mix mix;
  for (const Influence& influence : row) {
    const DualQuat& bone = bones[influence.joint.index()];
    const double signed_weight =
        bone.real.coeffs().dot(pivot.real.coeffs()) < 0 ? -influence.weight : influence.weight;
    mix.real += signed_weight * bone.real.coeffs();
    mix.dual += signed_weight * bone.dual.coeffs();
  }
  if (mix.real.squaredNorm() < kCancelled * kCancelled) return {pivot.real.coeffs(), pivot.dual.coeffs()};
  return mix;
}

// The rigid motion of a dual quaternion applied to a point, without division by the length twice: with q the
// real and e the dual part, |q|^2 p' = |q|^2 p + 2 v x (v x p + w p) + 2 (w e_v - e_w v + v x e_v).
Vec3 moved(const Mix& mix, const Vec3& p) {
  const Vec3 v = mix.real.head<3>(), e = mix.dual.head<3>();
  const double w = mix.real[3], scale = 2 / mix.real.squaredNorm();
  return p + scale * (v.cross(v.cross(p) + w * p + e) + w * e - mix.dual[3] * v);
}

}  // namespace

const Influence& largest_influence(std::span<const Influence> row) {
  const Influence* best = &row.front();
  for (const Influence& influence : row.subspan(1))
    if (influence.weight > best->weight ||
        (influence.weight == best->weight && influence.joint < best->joint))
      best = &influence;
  return *best;
}

std::vector<Vec3> dual_quaternion_blend(std::span<const Vec3> positions, const SkinWeights& weights,
                                        std::span<const RigidMotion> motions) {
  SF_EXPECT(positions.size() == weights.vertex_count());
  const std::vector<DualQuat> bones = dual_quaternions(motions);
  std::vector<Vec3> posed(positions.size());
  parallel_chunks(positions.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const auto row = weights.of(VertexId(v));
      posed[v] = row.empty() ? positions[v] : moved(mix_of(row, bones), positions[v]);
    }
  });
  return posed;
}

std::vector<RigidMotion> dual_quaternion_motions(const SkinWeights& weights,
                                                 std::span<const RigidMotion> motions) {
  const std::vector<DualQuat> bones = dual_quaternions(motions);
  std::vector<RigidMotion> all(weights.vertex_count());
  parallel_chunks(all.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const auto row = weights.of(VertexId(v));
      if (row.empty()) continue;
      const Mix mix = mix_of(row, bones);
      all[v] = rigid_motion({Quat(mix.real), Quat(mix.dual)});
    }
  });
  return all;
}

}  // namespace skinforge
