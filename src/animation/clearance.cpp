#include "animation/clearance.h"

#include <algorithm>
#include <cmath>

#include "animation/lanes.h"

namespace skinforge {
namespace {

constexpr std::size_t kBlock = Lanes::kCount;
constexpr std::size_t kStretch = 4 * kBlock;  // frames whose places are looked at only where they may be near

struct BallPlaces {
  const float *x, *y, *z;
};

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

// Squared distances of a ball from `count` places, a whole number of blocks; whether any place is deeper in
// it than it was in another, where depth is `touch` less the distance.
SKINFORGE_VECTOR_CLONES bool any_deeper(const BallPlaces& places, const float* ball, float touch,
                                        const float* deepest, std::size_t count, float* squared) {
  int any = 0;
  for (std::size_t c = 0; c < count; c += kBlock) {
    const Lanes dx = Lanes::load(places.x + c) + -ball[0], dy = Lanes::load(places.y + c) + -ball[1],
                dz = Lanes::load(places.z + c) + -ball[2];
    const Lanes sum{dx.v * dx.v + dy.v * dy.v + dz.v * dz.v};
    sum.store(squared + c);
    const Lanes room = max(Lanes::all(touch) + Lanes{-Lanes::load(deepest + c).v}, Lanes::all(0));
    const auto gains = sum.v < room.v * room.v;
    for (std::size_t k = 0; k < kBlock; ++k) any |= gains[k];
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
    // Large balls go deepest; after them few others count.
    std::stable_sort(side.pairs.begin(), side.pairs.end(),
                     [](const Pair& a, const Pair& b) { return a.touch > b.touch; });
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

// One stretch of candidates, of which none is deeper than `shallowest`; `deepest` of its first candidate.
void Clearance::deepen(const Side& side, const Pair& pair, const Eigen::Vector3f& ball, std::size_t stretch,
                       Depths& depths) {
  const float room = pair.touch - depths.shallowest[stretch];
  if (room <= 0 || side.reaches[pair.part][stretch].squaredExteriorDistance(ball) >= room * room) return;
  const BallTrack& track = side.part[pair.part];
  const std::size_t first = stretch * kStretch, count = std::min(kStretch, depths.count - first);
  const std::size_t whole = count / kBlock * kBlock;
  float* deepest = depths.deepest.data() + first;
  std::array<float, kStretch> squared = {};
  const BallPlaces places{track.places[0].data() + first, track.places[1].data() + first,
                          track.places[2].data() + first};
  const bool gains =
      whole > 0 && any_deeper(places, ball.data(), pair.touch, deepest, whole, squared.data());
  for (std::size_t c = whole; c < count; ++c) squared[c] = (track.at(first + c) - ball).squaredNorm();
  for (std::size_t c = gains ? 0 : whole; c < count; ++c) {
    const float lacks = pair.touch - deepest[c];
    if (lacks > 0 && squared[c] < lacks * lacks)
      deepest[c] = std::min(depths.most, pair.touch - std::sqrt(squared[c]));
  }
  if (gains) depths.shallowest[stretch] = *std::min_element(deepest, deepest + count);
}

Eigen::ArrayXf Clearance::depths(std::size_t row, std::size_t candidates, double most) const {
  Eigen::ArrayXf result = Eigen::ArrayXf::Zero(static_cast<Eigen::Index>(candidates));
  for (const Side& side : sides_) {
    const std::size_t stretches = (candidates + kStretch - 1) / kStretch;
    Depths depths{candidates, static_cast<float>(most) / side.unit,
                  std::vector<float>(stretches * kStretch, 0.0F), std::vector<float>(stretches, 0.0F)};
    for (const Pair& pair : side.pairs) {
      const Eigen::Vector3f ball = side.driver[pair.driver].at(row);
      for (std::size_t s = 0; s < stretches; ++s)
        if (depths.shallowest[s] < depths.most) deepen(side, pair, ball, s, depths);
    }
    result = result.max(side.unit *
                        Eigen::Map<const Eigen::ArrayXf>(depths.deepest.data(), result.size()));
  }
  return result;
}

}  // namespace skinforge
