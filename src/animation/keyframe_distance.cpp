#include "animation/keyframe_distance.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/expect.h"

namespace skinforge {
namespace {

// Candidates handled together; fixed, so that compilers use vector registers.
constexpr std::size_t kBlock = 16;
using Block = Eigen::Array<float, kBlock, 1>;
constexpr double kMinWeight =
    0.01;  // ours: of the largest; joints below change the distance in the third digit

constexpr std::array<float, 3> kWindow = {1.0F, 0.2F, 0.1F};  // Sec. 8.1: this frame, one step, two steps

// Result joints that both sides reach.
struct SharedJoints {
  std::vector<std::size_t> joints;
  std::vector<float> weights;
};

SharedJoints shared_joints(const MotionPair& pair) {
  const std::size_t n = pair.driver->confidence.size();
  std::vector<double> weight(n);
  for (std::size_t j = 0; j < n; ++j)
    weight[j] = std::min(1.0, pair.driver->confidence[j]) * std::min(1.0, pair.candidate->confidence[j]);
  const double largest = n == 0 ? 0 : *std::max_element(weight.begin(), weight.end());
  SharedJoints shared;
  for (std::size_t j = 0; j < n; ++j)
    if (weight[j] > kMinWeight * largest) {
      shared.joints.push_back(j);
      shared.weights.push_back(static_cast<float>(weight[j]));
    }
  return shared;
}

std::vector<float> gather(const MotionSet& set, std::size_t first, std::size_t count,
                          std::span<const std::size_t> joints) {
  const std::size_t n = set.confidence.size();
  std::vector<float> rotations;
  rotations.reserve(count * joints.size() * 4);
  for (std::size_t f = first; f < first + count; ++f)
    for (const std::size_t j : joints) {
      const float* q = set.rotations.data() + (f * n + j) * 4;
      rotations.insert(rotations.end(), q, q + 4);
    }
  return rotations;
}

std::int32_t step_or_stay(const std::vector<std::int32_t>& steps, std::int32_t from) {
  const std::int32_t to = steps[static_cast<std::size_t>(from)];
  return to < 0 ? from : to;
}

// Per frame, where it is after -2, -1, 0, 1, 2 steps.
std::vector<std::array<std::int32_t, 5>> neighbourhoods(const FrameSteps& steps) {
  std::vector<std::array<std::int32_t, 5>> all;
  for (std::size_t f = 0; f < steps.next.size(); ++f) {
    const auto here = static_cast<std::int32_t>(f);
    const std::int32_t before = step_or_stay(steps.previous, here), after = step_or_stay(steps.next, here);
    all.push_back(
        {step_or_stay(steps.previous, before), before, here, after, step_or_stay(steps.next, after)});
  }
  return all;
}

// Sum of weight * |w| per frame: the similarity to the identity, which is every joint's usual stance.
void add_stance_similarities(std::span<const float> rotations, std::span<const float> weights,
                             std::span<float> sums) {
  for (std::size_t f = 0; f < sums.size(); ++f)
    for (std::size_t j = 0; j < weights.size(); ++j)
      sums[f] += weights[j] * std::abs(rotations[(f * weights.size() + j) * 4 + 3]);
}

void turn_into_distances(float total, std::span<float> similarities) {
  for (float& s : similarities) s = std::clamp(1 - s / total, 0.0F, 1.0F);
}

}  // namespace

FrameSteps frame_steps(const MotionSet& set) {
  FrameSteps steps;
  for (std::size_t clip = 0; clip + 1 < set.clip_begin.size(); ++clip) {
    const std::int32_t first = set.clip_begin[clip], end = set.clip_begin[clip + 1];
    for (std::int32_t f = first; f < end; ++f) {
      steps.next.push_back(f + 1 < end ? f + 1 : -1);
      steps.previous.push_back(f > first ? f - 1 : -1);
    }
    if (!set.is_cyclic[clip]) continue;
    const auto last = static_cast<std::size_t>(end - 1);
    steps.next[last - 1] = first;
    steps.next[last] = first + 1;
    steps.previous[static_cast<std::size_t>(first)] = end - 2;
  }
  return steps;
}

RotationTable::RotationTable(std::span<const float> rotations, std::span<const float> weights)
    : frames_(weights.empty() ? 0 : rotations.size() / (4 * weights.size())),
      weights_(weights.begin(), weights.end()) {
  const std::size_t joints = weights.size();
  packed_.assign(padded_count() * joints * 4, 0.0F);
  for (std::size_t f = 0; f < frames_; ++f)
    for (std::size_t v = 0; v < joints * 4; ++v)
      packed_[((f / kBlock) * joints * 4 + v) * kBlock + f % kBlock] = rotations[f * joints * 4 + v];
}

std::size_t RotationTable::padded_count() const {
  return (frames_ + kBlock - 1) / kBlock * kBlock;
}

void RotationTable::add_similarities(std::span<const float> query, std::span<float> sums) const {
  const std::size_t joints = weights_.size();
  SF_EXPECT(query.size() == joints * 4 && sums.size() == padded_count());
  std::vector<float> weighted(query.size());
  for (std::size_t v = 0; v < query.size(); ++v) weighted[v] = weights_[v / 4] * query[v];
  const float* values = packed_.data();
  for (std::size_t block = 0; block < sums.size(); block += kBlock) {
    Block sum = Eigen::Map<const Block>(sums.data() + block);
    for (std::size_t j = 0; j < joints; ++j, values += 4 * kBlock) {
      const float* q = weighted.data() + 4 * j;
      sum += (q[0] * Eigen::Map<const Block>(values) + q[1] * Eigen::Map<const Block>(values + kBlock) +
              q[2] * Eigen::Map<const Block>(values + 2 * kBlock) +
              q[3] * Eigen::Map<const Block>(values + 3 * kBlock))
                 .abs();
    }
    Eigen::Map<Block>(sums.data() + block) = sum;
  }
}

DistanceTable keyframe_distances(std::span<const MotionPair> pairs, std::size_t first, std::size_t count) {
  SF_EXPECT(!pairs.empty());
  DistanceTable table{count, pairs.front().candidate->poses.size(), {}, {}, {}};
  table.values.assign(table.frames * table.candidates, 0.0F);
  table.frame_stance.assign(table.frames, 0.0F);
  table.candidate_stance.assign(table.candidates, 0.0F);
  float total = 0;
  std::vector<float> sums;
  for (const MotionPair& pair : pairs) {
    const SharedJoints shared = shared_joints(pair);
    if (shared.joints.empty()) continue;
    const auto candidates = gather(*pair.candidate, 0, table.candidates, shared.joints);
    const auto queries = gather(*pair.driver, first, count, shared.joints);
    const RotationTable packed(candidates, shared.weights);
    const std::size_t stride = shared.joints.size() * 4;
    for (std::size_t f = 0; f < count; ++f) {
      sums.assign(packed.padded_count(), 0.0F);
      packed.add_similarities(std::span(queries).subspan(f * stride, stride), sums);
      const auto row = table.row(f);
      for (std::size_t c = 0; c < row.size(); ++c) row[c] += sums[c];
    }
    add_stance_similarities(queries, shared.weights, table.frame_stance);
    add_stance_similarities(candidates, shared.weights, table.candidate_stance);
    for (const float weight : shared.weights) total += weight;
  }
  if (total == 0) return table;
  turn_into_distances(total, table.values);
  turn_into_distances(total, table.frame_stance);
  turn_into_distances(total, table.candidate_stance);
  return table;
}

DistanceTable windowed(const DistanceTable& distances, const FrameSteps& driver_steps,
                       const FrameSteps& candidate_steps) {
  const auto rows = neighbourhoods(driver_steps), columns = neighbourhoods(candidate_steps);
  SF_EXPECT(rows.size() == distances.frames && columns.size() == distances.candidates);
  const float total = kWindow[0] + 2 * kWindow[1] + 2 * kWindow[2];
  DistanceTable result{
      distances.frames, distances.candidates, {}, distances.frame_stance, distances.candidate_stance};
  result.values.assign(distances.values.size(), 0.0F);
  for (std::size_t f = 0; f < distances.frames; ++f) {
    const auto sums = result.row(f);
    for (std::size_t k = 0; k < 5; ++k) {
      const float weight = kWindow[k < 2 ? 2 - k : k - 2] / total;
      const auto row = distances.row(static_cast<std::size_t>(rows[f][k]));
      for (std::size_t c = 0; c < sums.size(); ++c)
        sums[c] += weight * row[static_cast<std::size_t>(columns[c][k])];
    }
  }
  return result;
}

}  // namespace skinforge
