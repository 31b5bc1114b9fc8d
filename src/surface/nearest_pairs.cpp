#include "surface/nearest_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace skinforge {
namespace {

double distance_to(const std::vector<Vec3>& loop, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& q : loop) least = std::min(least, (p - q).squaredNorm());
  return std::sqrt(least);
}

// Mean way from each vertex of one loop to the nearest of the other.
double mean_distance(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
  double sum = 0;
  for (const Vec3& p : from) sum += distance_to(to, p);
  return sum / static_cast<double>(from.size());
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> nearest_pairs(std::span<const JunctionLoop> borders) {
  std::vector<std::pair<double, std::pair<std::size_t, std::size_t>>> candidates;
  for (std::size_t i = 0; i < borders.size(); ++i)
    for (std::size_t j = 0; j < borders.size(); ++j)
      if (borders[i].is_host && !borders[j].is_host)
        candidates.push_back({mean_distance(borders[i].positions, borders[j].positions) +
                                  mean_distance(borders[j].positions, borders[i].positions),
                              {i, j}});
  std::stable_sort(candidates.begin(), candidates.end());
  std::set<std::size_t> taken;
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const auto& [distance, pair] : candidates) {
    if (taken.contains(pair.first) || taken.contains(pair.second)) continue;
    taken.insert({pair.first, pair.second});
    pairs.push_back(pair);
  }
  return pairs;
}

}  // namespace skinforge
