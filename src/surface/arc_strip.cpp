#include "surface/arc_strip.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "surface/nearest_pairs.h"
#include "surface/quad_patch.h"

namespace skinforge {
namespace {

// A point of an arc and the unit direction in which its surface arrives there.
struct ArcPoint {
  Vec3 position = Vec3::Zero(), onward = Vec3::Zero();
};

std::vector<ArcPoint> points_of(const JunctionLoop& arc) {
  std::vector<ArcPoint> points;
  for (std::size_t i = 0; i < arc.positions.size(); ++i) {
    Vec3 onward = Vec3::Zero();
    for (const Vec3& p : arc.inward[i]) onward += arc.positions[i] - p;
    points.push_back({arc.positions[i], onward.norm() > 0 ? Vec3(onward.normalized()) : onward});
  }
  return points;
}

// Share of the way along an arc at each of its points.
std::vector<double> shares_of(const std::vector<ArcPoint>& arc) {
  std::vector<double> shares = {0};
  for (std::size_t i = 1; i < arc.size(); ++i)
    shares.push_back(shares.back() + (arc[i].position - arc[i - 1].position).norm());
  for (double& s : shares) s /= shares.back();
  return shares;
}

ArcPoint at_share(const std::vector<ArcPoint>& arc, const std::vector<double>& shares, double share) {
  const auto after = std::upper_bound(shares.begin() + 1, shares.end() - 1, share) - shares.begin();
  const auto i = static_cast<std::size_t>(after);
  const double t = (share - shares[i - 1]) / (shares[i] - shares[i - 1]);
  return {(1 - t) * arc[i - 1].position + t * arc[i].position,
          (1 - t) * arc[i - 1].onward + t * arc[i].onward};
}

// Cubic from one point to the other that leaves both as their surfaces arrive.
Vec3 between(const ArcPoint& a, const ArcPoint& b, double t) {
  const double gap = (b.position - a.position).norm();
  const double h = t * t * (3 - 2 * t);
  return (1 - h) * a.position + h * b.position + gap * t * (1 - t) * ((1 - t) * a.onward + t * b.onward);
}

double mean_edge(const std::vector<ArcPoint>& arc) {
  double length = 0;
  for (std::size_t i = 1; i < arc.size(); ++i) length += (arc[i].position - arc[i - 1].position).norm();
  return length / static_cast<double>(arc.size() - 1);
}

// The places of the rows between the arcs: as many points a row as the first arc has.
std::vector<std::vector<Vec3>> inner_rows(const std::vector<ArcPoint>& a, const std::vector<ArcPoint>& b) {
  const std::vector<double> shares_a = shares_of(a), shares_b = shares_of(b);
  std::vector<ArcPoint> opposite;
  double gap = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    opposite.push_back(at_share(b, shares_b, shares_a[i]));
    gap += (opposite[i].position - a[i].position).norm() / static_cast<double>(a.size());
  }
  const auto rows = static_cast<int>(std::lround(2 * gap / (mean_edge(a) + mean_edge(b))));
  std::vector<std::vector<Vec3>> inner;
  for (int r = 1; r < rows; ++r) {
    std::vector<Vec3>& row = inner.emplace_back();
    for (std::size_t i = 0; i < a.size(); ++i)
      row.push_back(between(a[i], opposite[i], static_cast<double>(r) / rows));
  }
  return inner;
}

using Row = std::vector<std::int32_t>;

// Faces between two rows that run the same way: both go on in steps as even as can be.
void add_row(QuadPatch& patch, const Row& low, const Row& high) {
  const std::size_t n = low.size() - 1, m = high.size() - 1, steps = std::max(n, m);
  for (std::size_t k = 0; k < steps; ++k) {
    const std::size_t i = k * n / steps, next_i = (k + 1) * n / steps;
    const std::size_t j = k * m / steps, next_j = (k + 1) * m / steps;
    if (next_i > i && next_j > j)
      patch.quads.push_back({low[i], low[next_i], high[next_j], high[j]});
    else if (next_i > i)
      patch.triangles.push_back({low[i], low[next_i], high[j]});
    else
      patch.triangles.push_back({low[i], high[next_j], high[j]});
  }
}

}  // namespace

ArcStrip arc_strip(const JunctionLoop& host, const JunctionLoop& donor) {
  const std::vector<ArcPoint> a = points_of(host);
  std::vector<ArcPoint> b = points_of(donor);
  std::reverse(b.begin(), b.end());  // new faces run along either arc: against each other
  QuadPatch patch{host.positions, {}, {}, a.size() + b.size()};
  patch.positions.insert(patch.positions.end(), donor.positions.begin(), donor.positions.end());
  Row low, last;
  for (std::size_t i = 0; i < a.size(); ++i) low.push_back(static_cast<std::int32_t>(i));
  for (std::size_t j = b.size(); j-- > 0;) last.push_back(static_cast<std::int32_t>(a.size() + j));
  const auto inner = inner_rows(a, b);
  for (const std::vector<Vec3>& places : inner) {
    Row row;
    for (const Vec3& p : places) {
      row.push_back(static_cast<std::int32_t>(patch.positions.size()));
      patch.positions.push_back(p);
    }
    add_row(patch, low, row);
    low = std::move(row);
  }
  add_row(patch, low, last);
  return {{host, donor}, halved(patch), patch.quads.size(), 2 * (inner.size() + 1)};
}

std::vector<ArcStrip> arc_strips(std::span<const JunctionLoop> arcs, int& open) {
  std::vector<ArcStrip> strips;
  for (const auto& [host, donor] : nearest_pairs(arcs)) strips.push_back(arc_strip(arcs[host], arcs[donor]));
  open = static_cast<int>(arcs.size() - 2 * strips.size());
  return strips;
}

}  // namespace skinforge
