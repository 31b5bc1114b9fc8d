#include "animation/clearance.h"

#include <algorithm>
#include <cmath>

#include "animation/lanes.h"

namespace skinforge {
namespace {

constexpr std::size_t kBlock = Lanes::kCount;
constexpr std::size_t kStretch = 4 * kBlock;  // frames whose places are looked at only where they may be near

Eigen::AlignedBox3f box_of(const BallTrack& track, std::size_t first, std::size_t count) {
  Eigen::AlignedBox3f box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    const auto places =
        track.places[axis].segment(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(count));
    box.min()[a] = places.minCoeff();
    box.max()[a] = places.maxCoeff();
  }
  return box;
}

// Squared distances of a ball from `count` places, a whole number of blocks; whether any is below `limit`.
SKINFORGE_VECTOR_CLONES bool any_within(const float* x, const float* y, const float* z, const float* ball,
                                        float limit, std::size_t count, float* squared) {
  int any = 0;
  for (std::size_t c = 0; c < count; c += kBlock) {
    const Lanes dx = Lanes::load(x + c) + -ball[0], dy = Lanes::load(y + c) + -ball[1],
                dz = Lanes::load(z + c) + -ball[2];
    const Lanes sum{dx.v * dx.v + dy.v * dy.v + dz.v * dz.v};
    sum.store(squared + c);
    const auto below = sum.v < limit;
    for (std::size_t k = 0; k < kBlock; ++k) any |= below[k];
  }
  return any != 0;
}

}  // namespace

// Pairs of balls that some row and some candidate might bring together: closer than in the bind pose by what
// they may overlap there.
Clearance::Clearance(std::span<const Seam> seams, std::size_t first, std::size_t count) {
  for (const Seam& seam : seams) {
    const std::size_t frames = seam.part.set->poses.size();
    Side side{
        seam.driver.tracks(first, count), seam.part.tracks(0, frames), {}, {}, static_cast<float>(seam.unit)};
    Reaches driver_reach, part_reach;
    for (const BallTrack& track : side.driver) driver_reach.push_back(box_of(track, 0, count));
    for (const BallTrack& track : side.part) {
      Reaches& reaches = side.reaches.emplace_back();
      part_reach.emplace_back();
      for (std::size_t f = 0; f < frames; f += kStretch) {
        reaches.push_back(box_of(track, f, std::min(kStretch, frames - f)));
        part_reach.back().extend(reaches.back());
      }
    }
    for (std::size_t a = 0; a < side.driver.size(); ++a)
      for (std::size_t b = 0; b < side.part.size(); ++b) {
        const float apart = driver_reach[a].exteriorDistance(part_reach[b]);
        if (apart >= static_cast<float>(seam.radii(a, b))) continue;  // most
        const auto touch = static_cast<float>(seam.touching(a, b));
        if (apart < touch) side.pairs.push_back({a, b, touch});
      }
    sides_.push_back(std::move(side));
  }
}

double Clearance::depth(std::size_t row, std::size_t candidate) const {
  float deepest = 0;
  for (const Side& side : sides_)
    for (const Pair& pair : side.pairs) {
      const float distance2 =
          (side.driver[pair.driver].at(row) - side.part[pair.part].at(candidate)).squaredNorm();
      if (distance2 < pair.touch * pair.touch)
        deepest = std::max(deepest, side.unit * (pair.touch - std::sqrt(distance2)));
    }
  return static_cast<double>(deepest);
}

void Clearance::deepen(const Side& side, const Pair& pair, std::size_t row, std::vector<float>& deepest) {
  const Eigen::Vector3f ball = side.driver[pair.driver].at(row);
  const BallTrack& track = side.part[pair.part];
  const Reaches& reaches = side.reaches[pair.part];
  const float limit = pair.touch * pair.touch;
  std::array<float, kStretch> squared = {};
  for (std::size_t s = 0; s < reaches.size(); ++s) {
    if (reaches[s].squaredExteriorDistance(ball) >= limit) continue;
    const std::size_t first = s * kStretch, count = std::min(kStretch, deepest.size() - first);
    const std::size_t whole = count / kBlock * kBlock;
    bool is_near =
        whole > 0 && any_within(track.places[0].data() + first, track.places[1].data() + first,
                                track.places[2].data() + first, ball.data(), limit, whole, squared.data());
    for (std::size_t c = whole; c < count; ++c) {
      squared[c] = (track.at(first + c) - ball).squaredNorm();
      is_near = is_near || squared[c] < limit;
    }
    for (std::size_t c = 0; is_near && c < count; ++c)
      if (squared[c] < limit)
        deepest[first + c] = std::max(deepest[first + c], side.unit * (pair.touch - std::sqrt(squared[c])));
  }
}

Eigen::ArrayXf Clearance::depths(std::size_t row, std::size_t candidates) const {
  std::vector<float> deepest(candidates, 0.0F);
  for (const Side& side : sides_)
    for (const Pair& pair : side.pairs) deepen(side, pair, row, deepest);
  return Eigen::Map<const Eigen::ArrayXf>(deepest.data(), static_cast<Eigen::Index>(candidates));
}

}  // namespace skinforge
