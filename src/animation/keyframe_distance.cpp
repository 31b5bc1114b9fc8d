#include "animation/keyframe_distance.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "animation/lanes.h"
#include "base/expect.h"
#include "base/parallel.h"

namespace skinforge {
namespace {

constexpr std::size_t kBlock = Lanes::kCount;  // candidates handled together
constexpr std::size_t kRowsAtOnce = 32;        // ours: of a table, by one thread
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
using Neighbourhood = std::array<std::int32_t, 5>;
std::vector<Neighbourhood> neighbourhoods(const FrameSteps& steps) {
  std::vector<Neighbourhood> all;
  for (std::size_t f = 0; f < steps.next.size(); ++f) {
    const auto here = static_cast<std::int32_t>(f);
    const std::int32_t before = step_or_stay(steps.previous, here), after = step_or_stay(steps.next, here);
    all.push_back(
        {step_or_stay(steps.previous, before), before, here, after, step_or_stay(steps.next, after)});
  }
  return all;
}

// Candidates [begin, end) whose k-th neighbours lie side by side, the first at `from`: whole rows are added
// at once.
struct NeighbourRun {
  std::size_t begin, end, from;
};

std::array<std::vector<NeighbourRun>, 5> neighbour_runs(const std::vector<Neighbourhood>& columns) {
  std::array<std::vector<NeighbourRun>, 5> runs;
  for (std::size_t k = 0; k < 5; ++k)
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const auto at = static_cast<std::size_t>(columns[c][k]);
      const bool goes_on = !runs[k].empty() && at == runs[k].back().from + (c - runs[k].back().begin);
      if (!goes_on) runs[k].push_back({c, c, at});
      ++runs[k].back().end;
    }
  return runs;
}

void add_runs(float weight, std::span<const float> row, std::span<const NeighbourRun> runs,
              std::span<float> sums) {
  for (const NeighbourRun& run : runs) {
    const auto length = static_cast<Eigen::Index>(run.end - run.begin);
    Eigen::Map<Eigen::ArrayXf>(sums.data() + run.begin, length) +=
        weight * Eigen::Map<const Eigen::ArrayXf>(row.data() + run.from, length);
  }
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

namespace {

// |q . q'| of a block's joint and one query.
[[gnu::always_inline]] inline Lanes similarity(const std::array<Lanes, 4>& block, const float* q) {
  return abs(block[0] * q[0] + block[1] * q[1] + block[2] * q[2] + block[3] * q[3]);
}

// sums[query][block] += |q . q'| over the joints of a block, for RotationTable::kAtOnce queries at once.
// Written out, because the compiler would keep a loop's sums in memory.
SKINFORGE_VECTOR_CLONES void add_block(const float* values, const float* queries, std::size_t joints,
                                       float* const* sums) {
  static_assert(RotationTable::kAtOnce == 4);
  Lanes a = Lanes::load(sums[0]), b = Lanes::load(sums[1]), c = Lanes::load(sums[2]),
        d = Lanes::load(sums[3]);
  for (std::size_t j = 0; j < joints; ++j, values += 4 * kBlock, queries += 4) {
    const std::array<Lanes, 4> block = {Lanes::load(values), Lanes::load(values + kBlock),
                                        Lanes::load(values + 2 * kBlock), Lanes::load(values + 3 * kBlock)};
    a = a + similarity(block, queries);
    b = b + similarity(block, queries + 4 * joints);
    c = c + similarity(block, queries + 8 * joints);
    d = d + similarity(block, queries + 12 * joints);
  }
  a.store(sums[0]);
  b.store(sums[1]);
  c.store(sums[2]);
  d.store(sums[3]);
}

}  // namespace

void RotationTable::add_similarities(std::span<const float> queries, std::span<float> sums) const {
  const std::size_t stride = weights_.size() * 4, padded = padded_count();
  const std::size_t count = padded == 0 ? 0 : sums.size() / padded;
  SF_EXPECT(sums.size() == count * padded && (stride == 0 || queries.size() == count * stride));
  std::vector<float> weighted(RotationTable::kAtOnce * stride), spare(padded);
  for (std::size_t first = 0; first < count; first += RotationTable::kAtOnce) {
    std::array<float*, RotationTable::kAtOnce> rows;
    for (std::size_t k = 0; k < RotationTable::kAtOnce; ++k) {
      const bool is_there = first + k < count;
      rows[k] = is_there ? sums.data() + (first + k) * padded : spare.data();
      for (std::size_t v = 0; v < stride; ++v)
        weighted[k * stride + v] = is_there ? weights_[v / 4] * queries[(first + k) * stride + v] : 0.0F;
    }
    for (std::size_t block = 0; block < padded; block += kBlock) {
      add_block(packed_.data() + block * stride, weighted.data(), weights_.size(), rows.data());
      for (float*& row : rows) row += kBlock;
    }
  }
}

DistanceTable keyframe_distances(std::span<const MotionPair> pairs, std::size_t first, std::size_t count) {
  SF_EXPECT(!pairs.empty());
  DistanceTable table{count, pairs.front().candidate->poses.size(), {}, {}, {}};
  table.values.assign(table.frames * table.candidates, 0.0F);
  table.frame_stance.assign(table.frames, 0.0F);
  table.candidate_stance.assign(table.candidates, 0.0F);
  float total = 0;
  for (const MotionPair& pair : pairs) {
    const SharedJoints shared = shared_joints(pair);
    if (shared.joints.empty()) continue;
    const auto candidates = gather(*pair.candidate, 0, table.candidates, shared.joints);
    const auto queries = gather(*pair.driver, first, count, shared.joints);
    const RotationTable packed(candidates, shared.weights);
    const std::size_t stride = shared.joints.size() * 4;
    parallel_chunks(count, kRowsAtOnce, [&](std::size_t begin, std::size_t end) {
      std::vector<float> sums((end - begin) * packed.padded_count(), 0.0F);
      packed.add_similarities(std::span(queries).subspan(begin * stride, (end - begin) * stride), sums);
      for (std::size_t f = begin; f < end; ++f) {
        const auto row = table.row(f);
        const float* sum = sums.data() + (f - begin) * packed.padded_count();
        for (std::size_t c = 0; c < row.size(); ++c) row[c] += sum[c];
      }
    });
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

double keyframe_distance(std::span<const MotionPair> pairs, std::size_t frame, std::size_t candidate) {
  double similarity = 0, total = 0;
  for (const MotionPair& pair : pairs) {
    const SharedJoints shared = shared_joints(pair);
    const std::size_t n = pair.driver->confidence.size();
    for (std::size_t k = 0; k < shared.joints.size(); ++k) {
      const std::size_t j = shared.joints[k];
      const Eigen::Map<const Eigen::Vector4f> a(pair.driver->rotations.data() + (frame * n + j) * 4);
      const Eigen::Map<const Eigen::Vector4f> b(pair.candidate->rotations.data() + (candidate * n + j) * 4);
      similarity += static_cast<double>(shared.weights[k] * std::abs(a.dot(b)));
      total += static_cast<double>(shared.weights[k]);
    }
  }
  return total > 0 ? std::clamp(1 - similarity / total, 0.0, 1.0) : 0;
}

DistanceTable windowed(DistanceTable table, const FrameSteps& driver_steps,
                       const FrameSteps& candidate_steps) {
  const auto rows = neighbourhoods(driver_steps), columns = neighbourhoods(candidate_steps);
  SF_EXPECT(rows.size() == table.frames && columns.size() == table.candidates);
  const auto runs = neighbour_runs(columns);
  const float total = kWindow[0] + 2 * kWindow[1] + 2 * kWindow[2];
  std::vector<std::vector<float>> plain(table.frames);  // rows as they were, while others need them
  const auto plain_row = [&](std::int32_t f) {
    const auto& kept = plain[static_cast<std::size_t>(f)];
    return kept.empty() ? std::span<const float>(table.row(static_cast<std::size_t>(f))) : kept;
  };
  for (std::size_t f = 0; f < table.frames; ++f) {
    const auto sums = table.row(f);
    plain[f].assign(sums.begin(), sums.end());
    std::fill(sums.begin(), sums.end(), 0.0F);
    for (std::size_t k = 0; k < 5; ++k)
      add_runs(kWindow[k < 2 ? 2 - k : k - 2] / total, plain_row(rows[f][k]), runs[k], sums);
    if (f >= 4) plain[f - 2] = {};  // the first two come round again in a loop
  }
  return table;
}

}  // namespace skinforge
