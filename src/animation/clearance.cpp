#include "animation/clearance.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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

// Which of many balls may be nearer to some place in a box than their `touch` less `shallowest`; how many.
SKINFORGE_VECTOR_CLONES std::size_t balls_near(const float* balls, const float* touch, std::size_t count,
                                               const float* low, const float* high, float shallowest,
                                               std::uint32_t* found) {
  std::size_t size = 0;
  for (std::size_t c = 0; c < count; c += kBlock) {
    Lanes squared = Lanes::all(0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Lanes place = Lanes::load(balls + axis * count + c);
      const Lanes below{low[axis] - place.v}, above = place + -high[axis];
      const Lanes apart = max(max(below, above), Lanes::all(0));
      squared.v += apart.v * apart.v;
    }
    const Lanes room = max(Lanes::load(touch + c) + -shallowest, Lanes::all(0));
    const auto is_near = squared.v < room.v * room.v;
    int any = 0;
    for (std::size_t k = 0; k < kBlock; ++k) any |= is_near[k];
    for (std::size_t k = 0; any && k < kBlock; ++k) {
      found[size] = static_cast<std::uint32_t>(c + k);
      size += is_near[k] != 0;
    }
  }
  return size;
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
    const Lanes room = max(Lanes{touch - Lanes::load(deepest + c).v}, Lanes::all(0));
    const auto gains = sum.v < room.v * room.v;
    for (std::size_t k = 0; k < kBlock; ++k) any |= gains[k];
  }
  return any != 0;
}

// Thick balls go deepest; after them few others count.
std::vector<std::size_t> thick_first(const std::vector<SkinBall>& balls) {
  std::vector<std::size_t> order(balls.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return balls[a].radius > balls[b].radius; });
  return order;
}

std::vector<BallTrack> in_order(const std::vector<BallTrack>& tracks, const std::vector<std::size_t>& order) {
  std::vector<BallTrack> sorted;
  for (const std::size_t b : order) sorted.push_back(tracks[b]);
  return sorted;
}

}  // namespace

void Clearance::Side::add(std::uint32_t driver_ball, float distance) {
  meets.push_back(driver_ball);
  touch.push_back(distance);
}

std::vector<float> Clearance::Side::met_at(std::size_t row, std::size_t part_ball) const {
  const std::size_t first = begin[part_ball], count = begin[part_ball + 1] - first;
  std::vector<float> places(3 * count);
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis)
      places[axis * count + k] = driver[meets[first + k]].places[axis][static_cast<Eigen::Index>(row)];
  return places;
}

// Only balls that some row and some candidate may bring together meet.
Clearance::Side Clearance::make_side(const Seam& seam, std::size_t first, std::size_t count) {
  const std::size_t frames = seam.part.set->poses.size();
  const auto driver_order = thick_first(seam.driver.set->balls),
             part_order = thick_first(seam.part.set->balls);
  Side side{in_order(seam.driver.tracks(first, count), driver_order),
            in_order(seam.part.tracks(0, frames), part_order),
            {},
            {0},
            {},
            {},
            static_cast<float>(seam.unit)};
  std::vector<Eigen::AlignedBox3f> driver_reach;
  for (const BallTrack& track : side.driver) driver_reach.push_back(box_of(track, 0, count));
  for (std::size_t b = 0; b < side.part.size(); ++b) {
    auto& reaches = side.reaches.emplace_back();
    Eigen::AlignedBox3f reach;
    for (std::size_t f = 0; f < frames; f += kStretch) {
      reaches.push_back(box_of(side.part[b], f, std::min(kStretch, frames - f)));
      reach.extend(reaches.back());
    }
    for (std::size_t a = 0; a < side.driver.size(); ++a) {
      const float apart = driver_reach[a].exteriorDistance(reach);
      if (apart >= static_cast<float>(seam.radii(driver_order[a], part_order[b]))) continue;  // most
      const auto touch = static_cast<float>(seam.touching(driver_order[a], part_order[b]));
      if (apart < touch) side.add(static_cast<std::uint32_t>(a), touch);
    }
    while (side.meets.size() % kBlock != 0) side.add(0, 0);
    side.begin.push_back(side.meets.size());
  }
  return side;
}

Clearance::Clearance(std::span<const Seam> seams, std::size_t first, std::size_t count) {
  for (const Seam& seam : seams) sides_.push_back(make_side(seam, first, count));
}

double Clearance::depth(std::size_t row, std::size_t candidate) const {
  float deepest = 0;
  for (const Side& side : sides_)
    for (std::size_t b = 0; b < side.part.size(); ++b) {
      const Eigen::Vector3f place = side.part[b].at(candidate);
      for (std::size_t k = side.begin[b]; k < side.begin[b + 1]; ++k) {
        const float apart2 = (side.driver[side.meets[k]].at(row) - place).squaredNorm();
        if (apart2 < side.touch[k] * side.touch[k])
          deepest = std::max(deepest, side.unit * (side.touch[k] - std::sqrt(apart2)));
      }
    }
  return static_cast<double>(deepest);
}

// One ball of the part in one stretch of candidates; `met`: places of the balls that it may meet.
void Clearance::deepen(const Side& side, std::size_t part_ball, const std::vector<float>& met,
                       std::size_t stretch, Depths& depths) {
  const Eigen::AlignedBox3f& reach = side.reaches[part_ball][stretch];
  const float* touches = side.touch.data() + side.begin[part_ball];
  const std::size_t others = met.size() / 3;
  depths.near.resize(others);
  const std::size_t found = balls_near(met.data(), touches, others, reach.min().data(), reach.max().data(),
                                       depths.shallowest[stretch], depths.near.data());
  if (found == 0) return;
  const BallTrack& track = side.part[part_ball];
  const std::size_t first = stretch * kStretch, count = std::min(kStretch, depths.count - first);
  const std::size_t whole = count / kBlock * kBlock;
  float* deepest = depths.deepest.data() + first;
  std::array<float, kStretch> squared = {};
  const BallPlaces places{track.places[0].data() + first, track.places[1].data() + first,
                          track.places[2].data() + first};
  for (std::size_t n = 0; n < found; ++n) {
    const std::size_t k = depths.near[n];
    const Eigen::Vector3f ball(met[k], met[others + k], met[2 * others + k]);
    const bool gains = any_deeper(places, ball.data(), touches[k], deepest, whole, squared.data());
    for (std::size_t c = whole; c < count; ++c) squared[c] = (track.at(first + c) - ball).squaredNorm();
    for (std::size_t c = gains ? 0 : whole; c < count; ++c) {
      const float lacks = touches[k] - deepest[c];
      if (lacks > 0 && squared[c] < lacks * lacks)
        deepest[c] = std::min(depths.most, touches[k] - std::sqrt(squared[c]));
    }
  }
  depths.shallowest[stretch] = *std::min_element(deepest, deepest + count);
}

Eigen::ArrayXf Clearance::depths(std::size_t row, std::size_t candidates, double most) const {
  Eigen::ArrayXf result = Eigen::ArrayXf::Zero(static_cast<Eigen::Index>(candidates));
  for (const Side& side : sides_) {
    const std::size_t stretches = (candidates + kStretch - 1) / kStretch;
    Depths depths{candidates,
                  static_cast<float>(most) / side.unit,
                  std::vector<float>(stretches * kStretch, 0.0F),
                  std::vector<float>(stretches, 0.0F),
                  {}};
    for (std::size_t b = 0; b < side.part.size(); ++b) {
      const std::vector<float> met = side.met_at(row, b);
      for (std::size_t s = 0; s < stretches; ++s)
        if (!met.empty() && depths.shallowest[s] < depths.most) deepen(side, b, met, s, depths);
    }
    result = result.max(side.unit * Eigen::Map<const Eigen::ArrayXf>(depths.deepest.data(), result.size()));
  }
  return result;
}

}  // namespace skinforge
