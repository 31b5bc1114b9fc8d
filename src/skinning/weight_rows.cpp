#include "skinning/weight_rows.h"

#include <algorithm>
#include <cmath>

#include "base/expect.h"

namespace skinforge {
namespace {

bool falls(const Influence& a, const Influence& b) {
  return a.weight != b.weight ? a.weight > b.weight : a.joint < b.joint;
}

// Adds up equal joints and sorts; unlike `normalised_row` no weight is scaled.
std::vector<Influence> merged_row(std::vector<Influence> row) {
  std::stable_sort(row.begin(), row.end(), [](const auto& a, const auto& b) { return a.joint < b.joint; });
  std::vector<Influence> merged;
  for (const Influence& i : row) {
    if (!merged.empty() && merged.back().joint == i.joint)
      merged.back().weight += i.weight;
    else
      merged.push_back(i);
  }
  std::sort(merged.begin(), merged.end(), falls);
  return merged;
}

std::vector<Influence> images_of(std::span<const Influence> row, const JointMap& map, bool by_confidence) {
  std::vector<Influence> images;
  for (const Influence& i : row) {
    const MappedJoint& to = map[i.joint.index()];
    images.push_back({to.image, by_confidence ? i.weight * to.confidence : i.weight});
  }
  return images;
}

}  // namespace

std::vector<Influence> retargeted_row(std::span<const Influence> row, const JointMap& map) {
  const bool sure = std::all_of(row.begin(), row.end(),
                                [&](const Influence& i) { return map[i.joint.index()].confidence >= 1; });
  if (sure) return merged_row(images_of(row, map, false));
  auto weighted = normalised_row(images_of(row, map, true));
  return weighted.empty() ? normalised_row(images_of(row, map, false)) : weighted;
}

SkinWeights retarget(const SkinWeights& weights, const JointMap& map) {
  SkinWeights result;
  for (std::size_t v = 0; v < weights.vertex_count(); ++v)
    result.push_row(retargeted_row(weights.of(VertexId(v)), map));
  return result;
}

std::vector<Influence> interpolate_row(const SkinWeights& weights, const std::array<VertexId, 3>& triangle,
                                       const Vec3& barycentric) {
  std::array<RowShare, 3> shares;
  for (int i = 0; i < 3; ++i) shares[i] = {weights.of(triangle[i]), barycentric[i]};
  return blend_rows(shares, 0);
}

std::vector<Influence> blend_rows(std::span<const RowShare> shares, std::size_t limit) {
  std::vector<Influence> mix;
  for (const RowShare& share : shares) {
    SF_EXPECT(share.factor >= 0);
    for (const Influence& i : share.row) mix.push_back({i.joint, share.factor * i.weight});
  }
  return normalised_row(std::move(mix), limit);
}

double row_distance(std::span<const Influence> a, std::span<const Influence> b) {
  std::vector<Influence> difference(a.begin(), a.end());
  for (const Influence& i : b) difference.push_back({i.joint, -i.weight});
  double sum = 0;
  for (const Influence& i : merged_row(std::move(difference))) sum += std::abs(i.weight);
  return sum;
}

}  // namespace skinforge
