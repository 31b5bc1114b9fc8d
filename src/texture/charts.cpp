#include "texture/charts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <queue>

namespace skinforge {
namespace {

constexpr double kTouch =
    1e-7;  // ours: overlap below this part of the longer triangle is rounding, not overlap

using Triangle2 = std::array<Vec2, 3>;

// Neighbours of each face (index into `faces`) across edges, in edge order.
std::vector<std::vector<std::size_t>> face_neighbours(const PolygonMesh& mesh,
                                                      std::span<const FaceId> faces) {
  std::map<std::pair<VertexId, VertexId>, std::vector<std::size_t>> faces_of_edge;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto corners = mesh.face(faces[f]);
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const VertexId a = corners[c], b = corners[(c + 1) % corners.size()];
      faces_of_edge[std::minmax(a, b)].push_back(f);
    }
  }
  std::vector<std::vector<std::size_t>> neighbours(faces.size());
  for (const auto& [edge, list] : faces_of_edge)
    for (const std::size_t f : list)
      for (const std::size_t g : list)
        if (f != g) neighbours[f].push_back(g);
  return neighbours;
}

struct Plane {
  Vec3 x, y, axis;
};

// Any right-handed frame around `axis`, the same for the same axis.
Plane plane_of(const Vec3& axis) {
  Eigen::Index smallest = 0;
  axis.cwiseAbs().minCoeff(&smallest);
  Plane plane;
  plane.axis = axis;
  plane.x = Vec3::Unit(smallest).cross(axis).normalized();
  plane.y = axis.cross(plane.x);
  return plane;
}

std::vector<Vec2> projected(const PolygonMesh& mesh, FaceId face, const Plane& plane) {
  std::vector<Vec2> corners;
  for (const VertexId v : mesh.face(face)) {
    const Vec3& p = mesh.positions[v.index()];
    corners.emplace_back(p.dot(plane.x), p.dot(plane.y));
  }
  return corners;
}

std::vector<Triangle2> triangles_of(const PolygonMesh& mesh, FaceId face, const std::vector<Vec2>& corners) {
  std::vector<Vec3> positions;
  for (const VertexId v : mesh.face(face)) positions.push_back(mesh.positions[v.index()]);
  std::vector<Triangle2> triangles;
  for (const auto& t : triangulate(std::span<const Vec3>(positions)))
    triangles.push_back({corners[t[0]], corners[t[1]], corners[t[2]]});
  return triangles;
}

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double signed_area(const Triangle2& t) {
  return cross(t[1] - t[0], t[2] - t[0]) / 2;
}

double longest_edge(const Triangle2& t) {
  return std::max({(t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm()});
}

// Whether an edge line of `a` has all of `b` on its outer side. Both counter-clockwise.
bool separates(const Triangle2& a, const Triangle2& b, double tolerance) {
  for (int i = 0; i < 3; ++i) {
    const Vec2 edge = a[(i + 1) % 3] - a[i];
    const double slack = tolerance * edge.norm();
    if (std::all_of(b.begin(), b.end(), [&](const Vec2& p) { return cross(edge, p - a[i]) <= slack; }))
      return true;
  }
  return false;
}

bool overlap(const Triangle2& a, const Triangle2& b) {
  const double tolerance = kTouch * std::max(longest_edge(a), longest_edge(b));
  return !separates(a, b, tolerance) && !separates(b, a, tolerance);
}

// One chart while it grows.
class GrowingChart {
 public:
  GrowingChart(const PolygonMesh& mesh, const Vec3& axis) : mesh_(mesh), plane_(plane_of(axis)) {}

  // Whether all triangles of the face point up and lie clear of the others.
  bool accepts(FaceId face) const {
    for (const Triangle2& t : triangles_of(mesh_, face, projected(mesh_, face, plane_))) {
      if (signed_area(t) <= kTouch * longest_edge(t) * longest_edge(t)) return false;
      if (std::any_of(triangles_.begin(), triangles_.end(),
                      [&](const Triangle2& u) { return overlap(t, u); }))
        return false;
    }
    return true;
  }
  void add(std::size_t index, FaceId face) {
    const auto corners = projected(mesh_, face, plane_);
    const auto triangles = triangles_of(mesh_, face, corners);
    triangles_.insert(triangles_.end(), triangles.begin(), triangles.end());
    faces_[index] = corners;
  }
  // The chart turned so that its box is small, longer side along x.
  Chart finish() const;

 private:
  const PolygonMesh& mesh_;
  Plane plane_;
  std::vector<Triangle2> triangles_;
  std::map<std::size_t, std::vector<Vec2>> faces_;
};

struct Box2 {
  Vec2 low = Vec2::Constant(1e300), high = Vec2::Constant(-1e300);
  void extend(const Vec2& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  Vec2 size() const { return high - low; }
};

Vec2 turned(const Vec2& p, const Vec2& along) {
  return {p.dot(along), cross(along, p)};
}

Box2 box_along(const std::map<std::size_t, std::vector<Vec2>>& faces, const Vec2& along) {
  Box2 box;
  for (const auto& [index, corners] : faces)
    for (const Vec2& p : corners) box.extend(turned(p, along));
  return box;
}

Chart GrowingChart::finish() const {
  constexpr int kTurns = 24;  // ours: directions tried over half a turn, 7.5 degrees apart
  Vec2 best_along = Vec2::UnitX();
  double best_area = 0;
  for (int i = 0; i < kTurns; ++i) {
    const double angle = std::numbers::pi * i / kTurns;
    const Vec2 along(std::cos(angle), std::sin(angle));
    const Vec2 size = box_along(faces_, along).size();
    if (size.x() < size.y() || (i > 0 && best_area > 0 && size.x() * size.y() >= best_area)) continue;
    best_area = size.x() * size.y();
    best_along = along;
  }
  const Box2 box = box_along(faces_, best_along);
  Chart chart;
  chart.size = box.size();
  for (const auto& [index, corners] : faces_) {
    chart.faces.push_back(index);
    chart.corners.emplace_back();
    for (const Vec2& p : corners) chart.corners.back().push_back(turned(p, best_along) - box.low);
  }
  return chart;
}

Vec3 unit_or_up(const Vec3& v) {
  return v.norm() > 0 ? v.normalized() : Vec3(0, 1, 0);
}

// Mean normal of a face and its neighbours, so that one tilted seed does not tilt the chart; its own where
// that turns away.
Vec3 axis_at(std::size_t seed, const std::vector<std::vector<std::size_t>>& neighbours,
             const std::vector<Vec3>& normals, double least_cosine) {
  Vec3 sum = normals[seed];
  for (const std::size_t g : neighbours[seed]) sum += normals[g];
  const Vec3 mean = unit_or_up(sum);
  return mean.dot(normals[seed]) >= least_cosine ? mean : normals[seed];
}

// Faces waiting to join, least turned first (in steps, so that mirrored faces are equal), then lowest index.
using Candidate = std::pair<std::int64_t, std::size_t>;
using Candidates = std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>>;

}  // namespace

std::vector<Chart> grow_charts(const PolygonMesh& mesh, std::span<const FaceId> faces,
                               const ChartOptions& options) {
  const auto neighbours = face_neighbours(mesh, faces);
  std::vector<Vec3> normals;
  for (const FaceId f : faces) normals.push_back(unit_or_up(area_normal(mesh, f)));
  const double least_cosine = options.max_turn_deg > 0 ? std::cos(radians(options.max_turn_deg)) : 2;
  std::vector<bool> taken(faces.size(), false);
  std::vector<Chart> charts;
  for (std::size_t seed = 0; seed < faces.size(); ++seed) {
    if (taken[seed]) continue;
    const Vec3 axis = axis_at(seed, neighbours, normals, least_cosine);
    GrowingChart chart(mesh, axis);
    Candidates open;
    const auto take = [&](std::size_t f) {
      taken[f] = true;
      chart.add(f, faces[f]);
      for (const std::size_t g : neighbours[f]) {
        const double cosine = normals[g].dot(axis);
        if (!taken[g] && cosine >= least_cosine) open.emplace(std::llround((1 - cosine) * 4096), g);
      }
    };
    take(seed);
    while (!open.empty()) {
      const std::size_t f = open.top().second;
      open.pop();
      if (!taken[f] && chart.accepts(faces[f])) take(f);
    }
    charts.push_back(chart.finish());
  }
  return charts;
}

}  // namespace skinforge
