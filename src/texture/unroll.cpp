#include "texture/unroll.h"

#include <Eigen/SVD>
#include <Eigen/SparseLU>
#include <algorithm>
#include <iterator>
#include <map>
#include <queue>
#include <set>

namespace skinforge {
namespace {

constexpr double kMostStretch =
    2.5;  // ours: beyond it texels blur visibly beside neighbours at normal density
constexpr double kOutlierArea = 0.05;  // ours: part of the area that may lie beyond
constexpr double kStraight =
    1e-9;  // of the edge lengths' product: an angle this close to 180 degrees counts as it

using HalfEdge = std::pair<VertexId, VertexId>;

// One connected surface with what the steps need.
struct Ring {
  const PolygonMesh* mesh = nullptr;
  std::span<const FaceId> faces;
  std::span<const std::size_t> members;
  std::map<HalfEdge, std::size_t> face_of;           // half-edge -> member face (index into `faces`)
  std::map<VertexId, std::vector<VertexId>> linked;  // along edges

  const Vec3& at(VertexId v) const { return mesh->positions[v.index()]; }
  double length(VertexId a, VertexId b) const { return (at(a) - at(b)).norm(); }
};

// None when a half-edge occurs twice: not an oriented surface with at most two faces an edge.
std::optional<Ring> ring_of(const PolygonMesh& mesh, std::span<const FaceId> faces,
                            std::span<const std::size_t> members) {
  Ring ring{&mesh, faces, members, {}, {}};
  for (const std::size_t f : members) {
    const auto corners = mesh.face(faces[f]);
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const HalfEdge edge{corners[c], corners[(c + 1) % corners.size()]};
      if (!ring.face_of.emplace(edge, f).second) return std::nullopt;
    }
  }
  for (const auto& [edge, face] : ring.face_of) {
    ring.linked[edge.first].push_back(edge.second);
    if (!ring.face_of.count({edge.second, edge.first})) ring.linked[edge.second].push_back(edge.first);
  }
  return ring;
}

// The border loops in the direction of their faces, from their lowest vertex; none if a vertex has two border
// edges out.
std::optional<std::vector<std::vector<VertexId>>> border_loops(const Ring& ring) {
  std::map<VertexId, VertexId> next;
  for (const auto& [edge, face] : ring.face_of)
    if (!ring.face_of.count({edge.second, edge.first}) && !next.emplace(edge.first, edge.second).second)
      return std::nullopt;
  std::vector<std::vector<VertexId>> loops;
  while (!next.empty()) {
    std::vector<VertexId> loop;
    VertexId v = next.begin()->first;
    for (auto found = next.find(v); found != next.end(); found = next.find(v)) {
      loop.push_back(v);
      v = found->second;
      next.erase(found);
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

int euler_number(const Ring& ring) {
  std::set<HalfEdge> edges;
  for (const auto& [edge, face] : ring.face_of) edges.insert(std::minmax(edge.first, edge.second));
  return static_cast<int>(ring.linked.size()) - static_cast<int>(edges.size()) +
         static_cast<int>(ring.members.size());
}

// Lengths of the edges in whole steps, so that mirrored ways round the ring are equally long to the last bit.
class StepLength {
 public:
  explicit StepLength(const Ring& ring) : ring_(ring) {
    for (const auto& [edge, face] : ring.face_of) sum_ += ring.length(edge.first, edge.second);
    steps_ = 4096.0 * static_cast<double>(ring.face_of.size());  // ours: 4096 a mean edge
  }
  std::int64_t operator()(VertexId a, VertexId b) const {
    return sum_ > 0 ? std::llround(ring_.length(a, b) / sum_ * steps_) : 1;
  }

 private:
  const Ring& ring_;
  double sum_ = 0, steps_ = 0;
};

// Shortest path of edges from a vertex of `from` to one of `to` (Dijkstra, ties to the lower vertex). Empty
// if there is none.
std::vector<VertexId> shortest_path(const Ring& ring, const std::vector<VertexId>& from,
                                    const std::vector<VertexId>& to) {
  const std::set<VertexId> goals(to.begin(), to.end());
  const StepLength length(ring);
  std::map<VertexId, std::int64_t> distance;
  std::map<VertexId, VertexId> before;
  using Reached = std::pair<std::int64_t, VertexId>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  for (const VertexId v : from) {
    distance[v] = 0;
    open.emplace(0, v);
  }
  while (!open.empty()) {
    const auto [d, v] = open.top();
    open.pop();
    if (d > distance[v]) continue;
    if (goals.count(v)) {
      std::vector<VertexId> path = {v};
      for (auto b = before.find(v); b != before.end(); b = before.find(b->second)) path.push_back(b->second);
      std::reverse(path.begin(), path.end());
      return path;
    }
    for (const VertexId n : ring.linked.at(v)) {
      const std::int64_t reached = d + length(v, n);
      const auto known = distance.find(n);
      if (known != distance.end() && known->second <= reached) continue;
      distance[n] = reached;
      before[n] = v;
      open.emplace(reached, n);
    }
  }
  return {};
}

// Corners (face, vertex) that lie left of the path: they see their path vertex one period further on.
std::set<std::pair<std::size_t, VertexId>> left_of(const Ring& ring, const std::vector<VertexId>& path) {
  std::set<HalfEdge> cut;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    cut.insert({path[i], path[i + 1]});
    cut.insert({path[i + 1], path[i]});
  }
  std::set<std::pair<std::size_t, VertexId>> left;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const VertexId v = path[i];
    std::vector<std::size_t> open;
    const auto reach = [&](const HalfEdge& edge) {
      const auto face = ring.face_of.find(edge);
      if (face != ring.face_of.end() && left.insert({face->second, v}).second) open.push_back(face->second);
    };
    if (i + 1 < path.size()) reach({path[i], path[i + 1]});
    if (i > 0) reach({path[i - 1], path[i]});
    while (!open.empty()) {
      const std::size_t f = open.back();
      open.pop_back();
      const auto corners = ring.mesh->face(ring.faces[f]);
      for (std::size_t c = 0; c < corners.size(); ++c) {
        const VertexId a = corners[c], b = corners[(c + 1) % corners.size()];
        if ((a == v || b == v) && !cut.count({a, b}))
          reach({b, a});  // across an edge at v, never across the cut
      }
    }
  }
  return left;
}

// A triangle of the strip: vertices and whether each is seen one period further on.
struct StripTriangle {
  std::array<VertexId, 3> vertices;
  Vec3 shift;
};

std::vector<StripTriangle> strip_triangles(const Ring& ring,
                                           const std::set<std::pair<std::size_t, VertexId>>& left) {
  std::vector<StripTriangle> triangles;
  for (const std::size_t f : ring.members) {
    const auto corners = ring.mesh->face(ring.faces[f]);
    std::vector<Vec3> positions;
    for (const VertexId v : corners) positions.push_back(ring.at(v));
    for (const auto& t : triangulate(std::span<const Vec3>(positions))) {
      StripTriangle triangle;
      for (int i = 0; i < 3; ++i) {
        triangle.vertices[i] = corners[t[i]];
        triangle.shift[i] = left.count({f, triangle.vertices[i]}) ? 1 : 0;
      }
      triangles.push_back(triangle);
    }
  }
  return triangles;
}

// Arc length from `start` along the loop, as a part of its length.
std::map<VertexId, double> arc_lengths(const Ring& ring, const std::vector<VertexId>& loop, VertexId start) {
  const auto first = std::find(loop.begin(), loop.end(), start) - loop.begin();
  std::map<VertexId, double> arc;
  double sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const VertexId v = loop[(i + first) % loop.size()];
    arc[v] = sum;
    sum += ring.length(v, loop[(i + first + 1) % loop.size()]);
  }
  for (auto& [v, s] : arc) s = sum > 0 ? s / sum : 0;
  return arc;
}

// Tangent of half the angle between two edges.
double tan_half(const Vec3& a, const Vec3& b) {
  const double product = a.norm() * b.norm();
  return a.cross(b).norm() / std::max(product + a.dot(b), kStraight * product);
}

using Strip = std::map<VertexId, Vec2>;

// Step 3. `fixed`: the vertices of both loops.
std::optional<Strip> harmonic_strip(const Ring& ring, const std::vector<StripTriangle>& triangles,
                                    const Strip& fixed) {
  std::map<VertexId, int> number;
  for (const auto& [v, neighbours] : ring.linked)
    if (!fixed.count(v)) number.emplace(v, static_cast<int>(number.size()));
  Strip strip = fixed;
  if (number.empty()) return strip;
  std::vector<Eigen::Triplet<double>> entries;
  const auto n = static_cast<Eigen::Index>(number.size());
  Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(n, 2);
  for (const StripTriangle& t : triangles)
    for (int i = 0; i < 3; ++i) {
      const auto row = number.find(t.vertices[i]);
      if (row == number.end()) continue;
      for (int step = 1; step <= 2; ++step) {
        const int j = (i + step) % 3, k = (i + 3 - step) % 3;
        const Vec3 to_j = ring.at(t.vertices[j]) - ring.at(t.vertices[i]);
        const Vec3 to_k = ring.at(t.vertices[k]) - ring.at(t.vertices[i]);
        if (!(to_j.norm() > 0 && to_k.norm() > 0)) return std::nullopt;
        const double weight = tan_half(to_j, to_k) / to_j.norm();
        entries.emplace_back(row->second, row->second, weight);
        right(row->second, 0) += weight * (t.shift[j] - t.shift[i]);
        if (const auto column = number.find(t.vertices[j]); column != number.end())
          entries.emplace_back(row->second, column->second, -weight);
        else
          right.row(row->second) += weight * fixed.at(t.vertices[j]).transpose();
      }
    }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseLU<Eigen::SparseMatrix<double>> solver(matrix);
  if (solver.info() != Eigen::Success) return std::nullopt;
  const Eigen::MatrixX2d solution = solver.solve(right);
  if (!solution.allFinite()) return std::nullopt;
  for (const auto& [v, i] : number) strip[v] = solution.row(i);
  return strip;
}

// Derivative of the strip by the surface, 2 x 2 in a frame of the triangle, and the triangle's area.
struct Jacobian {
  Eigen::Matrix2d strip_by_surface;
  double area = 0;
};

std::optional<Jacobian> jacobian(const Ring& ring, const StripTriangle& t, const Strip& strip) {
  const Vec3 a = ring.at(t.vertices[1]) - ring.at(t.vertices[0]),
             b = ring.at(t.vertices[2]) - ring.at(t.vertices[0]);
  const double length = a.norm(), twice_area = a.cross(b).norm();
  if (!(twice_area > 0)) return std::nullopt;
  Eigen::Matrix2d surface, flat;
  surface << length, a.dot(b) / length, 0, twice_area / length;
  for (int i = 1; i < 3; ++i)
    flat.col(i - 1) = strip.at(t.vertices[i]) - strip.at(t.vertices[0]) + Vec2(t.shift[i] - t.shift[0], 0);
  return Jacobian{flat * surface.inverse(), twice_area / 2};
}

// Step 4: lengths of x and y in metres; none when a triangle is turned over.
std::optional<Vec2> strip_size(const std::vector<Jacobian>& jacobians) {
  double area = 0;
  Vec2 energy = Vec2::Zero();
  for (const Jacobian& j : jacobians) {
    if (!(j.strip_by_surface.determinant() > 0)) return std::nullopt;
    area += j.area;
    energy += j.area * j.strip_by_surface.rowwise().squaredNorm();
  }
  const double ratio = std::sqrt(energy.y() / energy.x());  // x length over y length
  const Vec2 size(std::sqrt(area * ratio), std::sqrt(area / ratio));
  if (!size.allFinite() || !(size.minCoeff() > 0)) return std::nullopt;
  return size;
}

bool is_little_stretched(const std::vector<Jacobian>& jacobians, const Vec2& size) {
  double area = 0, outside = 0;
  for (const Jacobian& j : jacobians) {
    const Eigen::Matrix2d scaled = size.asDiagonal() * j.strip_by_surface;
    const Vec2 stretch = scaled.jacobiSvd().singularValues();
    area += j.area;
    if (stretch[0] > kMostStretch || stretch[1] < 1 / kMostStretch) outside += j.area;
  }
  return outside <= kOutlierArea * area;
}

Chart chart_of(const Ring& ring, const Strip& strip, const std::set<std::pair<std::size_t, VertexId>>& left,
               const Vec2& size) {
  Chart chart;
  Vec2 low = Vec2::Constant(1e300), high = -low;
  for (const std::size_t f : ring.members) {
    chart.faces.push_back(f);
    chart.corners.emplace_back();
    for (const VertexId v : ring.mesh->face(ring.faces[f])) {
      const Vec2 p = (strip.at(v) + Vec2(left.count({f, v}) ? 1 : 0, 0)).cwiseProduct(size);
      chart.corners.back().push_back(p);
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  for (auto& corners : chart.corners)
    for (Vec2& p : corners) p -= low;
  chart.size = high - low;
  return chart;
}

// Turned by a quarter where y is the longer side.
Chart lying(Chart chart) {
  if (chart.size.x() >= chart.size.y()) return chart;
  for (auto& corners : chart.corners)
    for (Vec2& p : corners) p = Vec2(p.y(), chart.size.x() - p.x());
  std::swap(chart.size.x(), chart.size.y());
  return chart;
}

// Faces of each part that hangs together across edges, by lowest face.
std::vector<std::vector<std::size_t>> connected_parts(const PolygonMesh& mesh,
                                                      std::span<const FaceId> faces) {
  std::map<HalfEdge, std::vector<std::size_t>> faces_of_edge;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto corners = mesh.face(faces[f]);
    for (std::size_t c = 0; c < corners.size(); ++c)
      faces_of_edge[std::minmax(corners[c], corners[(c + 1) % corners.size()])].push_back(f);
  }
  std::vector<std::size_t> part_of(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) part_of[f] = f;
  const auto root = [&](std::size_t f) {
    while (part_of[f] != f) f = part_of[f] = part_of[part_of[f]];
    return f;
  };
  for (const auto& [edge, list] : faces_of_edge)
    for (const std::size_t f : list) {
      const std::size_t a = root(f), b = root(list.front());
      part_of[std::max(a, b)] = std::min(a, b);
    }
  std::map<std::size_t, std::vector<std::size_t>> parts;
  for (std::size_t f = 0; f < faces.size(); ++f) parts[root(f)].push_back(f);
  std::vector<std::vector<std::size_t>> result;
  for (auto& [lowest, list] : parts) result.push_back(std::move(list));
  return result;
}

}  // namespace

std::optional<Chart> unroll_annulus(const PolygonMesh& mesh, std::span<const FaceId> faces,
                                    std::span<const std::size_t> members) {
  const auto ring = ring_of(mesh, faces, members);  // 1.
  if (!ring || euler_number(*ring) != 0) return std::nullopt;
  const auto loops = border_loops(*ring);
  if (!loops || loops->size() != 2) return std::nullopt;

  const auto path = shortest_path(*ring, (*loops)[0], (*loops)[1]);  // 2.
  if (path.empty()) return std::nullopt;
  const auto left = left_of(*ring, path);
  const auto triangles = strip_triangles(*ring, left);

  Strip fixed;  // 3.
  for (const auto& [v, arc] : arc_lengths(*ring, (*loops)[0], path.front())) fixed[v] = Vec2(arc, 0);
  for (const auto& [v, arc] : arc_lengths(*ring, (*loops)[1], path.back()))
    fixed[v] = Vec2(arc > 0 ? 1 - arc : 0, 1);
  const auto strip = harmonic_strip(*ring, triangles, fixed);
  if (!strip) return std::nullopt;

  std::vector<Jacobian> jacobians;  // 4.
  for (const StripTriangle& t : triangles) {
    const auto j = jacobian(*ring, t, *strip);
    if (!j) return std::nullopt;
    jacobians.push_back(*j);
  }
  const auto size = strip_size(jacobians);
  if (!size || !is_little_stretched(jacobians, *size)) return std::nullopt;
  return lying(chart_of(*ring, *strip, left, *size));
}

std::vector<Chart> make_charts(const PolygonMesh& mesh, std::span<const FaceId> faces,
                               const ChartOptions& options) {
  std::vector<Chart> charts;
  for (const auto& members : connected_parts(mesh, faces)) {
    std::vector<FaceId> part;
    for (const std::size_t f : members) part.push_back(faces[f]);
    std::vector<Chart> grown = grow_charts(mesh, part, options);
    for (Chart& chart : grown)
      for (std::size_t& f : chart.faces) f = members[f];
    if (grown.size() > 1)
      if (auto strip = unroll_annulus(mesh, faces, members)) grown.assign(1, std::move(*strip));
    std::move(grown.begin(), grown.end(), std::back_inserter(charts));
  }
  return charts;
}

}  // namespace skinforge
