#include "surface/remesh.h"

// The mesh must come before its vector traits.
// clang-format off
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>
// clang-format on

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace skinforge {
namespace {

struct Traits : OpenMesh::DefaultTraits {
  using Point = Vec3;
  using Normal = Vec3;
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge | OpenMesh::Attributes::Status);
  VertexTraits {
    double length = 0;      // target edge length here
    bool is_fixed = false;  // border vertex of a preserved mesh
  };
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using VertexHandle = Mesh::VertexHandle;
using EdgeHandle = Mesh::EdgeHandle;
using HalfedgeHandle = Mesh::HalfedgeHandle;

// Handles in index order; collected first because the loops below change the mesh.
std::vector<EdgeHandle> all_edges(const Mesh& mesh) {
  std::vector<EdgeHandle> edges;
  for (const EdgeHandle e : mesh.edges()) edges.push_back(e);
  return edges;
}

double target_length(const Mesh& mesh, EdgeHandle e) {
  const HalfedgeHandle h = mesh.halfedge_handle(e, 0);
  return 0.5 * (mesh.data(mesh.from_vertex_handle(h)).length + mesh.data(mesh.to_vertex_handle(h)).length);
}

Vec3 face_cross(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b - a).cross(c - a);
}

// Below this share of its longest edge squared, twice a face's area is rounding, and where it faces is
// chance.
constexpr double kNoArea = 1e-4;

bool has_area(const Vec3& cross, const Vec3& a, const Vec3& b, const Vec3& c) {
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return cross.norm() > kNoArea * longest;
}

// Ours: a face may turn by at most about 78 degrees in one step of relaxation, 75 where an edge collapses.
constexpr double kTurnsWhenMoved = 0.2, kTurnsWhenCollapsed = 0.25;

// Whether moving `v` to `place` turns over any of its faces, or leaves one of them without area.
// `least_cosine`: of the angle by which a face may turn.
bool turns_faces(const Mesh& mesh, VertexHandle v, const Vec3& place, double least_cosine,
                 VertexHandle except_a = VertexHandle(), VertexHandle except_b = VertexHandle()) {
  for (const HalfedgeHandle h : mesh.voh_range(v)) {
    if (mesh.is_boundary(h)) continue;
    const VertexHandle p = mesh.to_vertex_handle(h), q = mesh.to_vertex_handle(mesh.next_halfedge_handle(h));
    if (p == except_a || q == except_a || p == except_b || q == except_b) continue;
    const Vec3 before = face_cross(mesh.point(v), mesh.point(p), mesh.point(q));
    const Vec3 after = face_cross(place, mesh.point(p), mesh.point(q));
    if (!has_area(before, mesh.point(v), mesh.point(p), mesh.point(q))) continue;
    if (after.dot(before) < least_cosine * after.norm() * before.norm() ||
        after.norm() < 1e-3 * before.norm())
      return true;
  }
  return false;
}

void split_long_edges(Mesh& mesh, double ratio) {
  for (const EdgeHandle e : all_edges(mesh)) {
    if (mesh.is_boundary(e)) continue;
    if (mesh.calc_edge_length(e) <= ratio * target_length(mesh, e)) continue;
    const HalfedgeHandle h = mesh.halfedge_handle(e, 0);
    const Vec3 middle = 0.5 * (mesh.point(mesh.from_vertex_handle(h)) + mesh.point(mesh.to_vertex_handle(h)));
    const double length = target_length(mesh, e);
    const VertexHandle v = mesh.add_vertex(middle);
    mesh.data(v).length = length;
    mesh.split(e, v);
  }
}

// The end that may go: the free one; of two free ones that of halfedge 0; none when both are fixed or on the
// boundary.
HalfedgeHandle collapsible_halfedge(const Mesh& mesh, EdgeHandle e) {
  for (const int side : {0, 1}) {
    const HalfedgeHandle h = mesh.halfedge_handle(e, side);
    const VertexHandle gone = mesh.from_vertex_handle(h);
    if (!mesh.data(gone).is_fixed && !mesh.is_boundary(gone)) return h;
  }
  return HalfedgeHandle();
}

bool makes_long_edges(const Mesh& mesh, HalfedgeHandle h, double ratio) {
  const VertexHandle stays = mesh.to_vertex_handle(h);
  for (const VertexHandle v : mesh.vv_range(mesh.from_vertex_handle(h))) {
    const double target = 0.5 * (mesh.data(v).length + mesh.data(stays).length);
    if ((mesh.point(v) - mesh.point(stays)).norm() > ratio * target) return true;
  }
  return false;
}

// Whether collapsing `h` would join its end, a fixed vertex, to another fixed vertex by a new edge.
bool makes_chord(const Mesh& mesh, HalfedgeHandle h) {
  const VertexHandle stays = mesh.to_vertex_handle(h);
  if (!mesh.data(stays).is_fixed) return false;
  for (const VertexHandle v : mesh.vv_range(mesh.from_vertex_handle(h)))
    if (v != stays && mesh.data(v).is_fixed && !mesh.find_halfedge(stays, v).is_valid()) return true;
  return false;
}

void collapse_short_edges(Mesh& mesh, const RemeshOptions& options) {
  for (const EdgeHandle e : all_edges(mesh)) {
    if (mesh.status(e).deleted()) continue;
    if (mesh.calc_edge_length(e) >= options.collapse_ratio * target_length(mesh, e)) continue;
    const HalfedgeHandle h = collapsible_halfedge(mesh, e);
    if (!h.is_valid() || makes_long_edges(mesh, h, options.split_ratio)) continue;
    if (!mesh.is_collapse_ok(h) || makes_chord(mesh, h)) continue;
    const VertexHandle gone = mesh.from_vertex_handle(h), stays = mesh.to_vertex_handle(h);
    if (turns_faces(mesh, gone, mesh.point(stays), kTurnsWhenCollapsed, stays)) continue;
    mesh.collapse(h);
  }
  mesh.garbage_collection();
}

// Valences of all vertices, kept as edges are flipped.
class Valences {
 public:
  explicit Valences(const Mesh& mesh) {
    for (const VertexHandle v : mesh.vertices()) {
      valence_.push_back(static_cast<int>(mesh.valence(v)));
      wanted_.push_back(mesh.is_boundary(v) ? 4 : 6);
    }
  }

  int of(VertexHandle v) const { return valence_[static_cast<std::size_t>(v.idx())]; }
  int defect(VertexHandle v, int change) const {
    const int defect = of(v) + change - wanted_[static_cast<std::size_t>(v.idx())];
    return defect * defect;
  }
  // Edge a-b becomes c-d.
  void flip(VertexHandle a, VertexHandle b, VertexHandle c, VertexHandle d) {
    for (const VertexHandle v : {a, b}) --valence_[static_cast<std::size_t>(v.idx())];
    for (const VertexHandle v : {c, d}) ++valence_[static_cast<std::size_t>(v.idx())];
  }

 private:
  std::vector<int> valence_, wanted_;
};

void flip_towards_regular(Mesh& mesh) {
  Valences valences(mesh);
  for (const EdgeHandle e : all_edges(mesh)) {
    if (mesh.is_boundary(e) || !mesh.is_flip_ok(e)) continue;
    const HalfedgeHandle h = mesh.halfedge_handle(e, 0), o = mesh.halfedge_handle(e, 1);
    const VertexHandle a = mesh.from_vertex_handle(h), b = mesh.to_vertex_handle(h);
    const VertexHandle c = mesh.to_vertex_handle(mesh.next_halfedge_handle(h));
    const VertexHandle d = mesh.to_vertex_handle(mesh.next_halfedge_handle(o));
    if (mesh.data(c).is_fixed && mesh.data(d).is_fixed) continue;
    const int before =
        valences.defect(a, 0) + valences.defect(b, 0) + valences.defect(c, 0) + valences.defect(d, 0);
    const int after =
        valences.defect(a, -1) + valences.defect(b, -1) + valences.defect(c, 1) + valences.defect(d, 1);
    if (after >= before) continue;
    if (!mesh.is_boundary(a) && valences.of(a) <= 3) continue;
    if (!mesh.is_boundary(b) && valences.of(b) <= 3) continue;
    const Vec3 normal = face_cross(mesh.point(a), mesh.point(b), mesh.point(c)) +
                        face_cross(mesh.point(b), mesh.point(a), mesh.point(d));
    const Vec3 first = face_cross(mesh.point(c), mesh.point(a), mesh.point(d)),
               second = face_cross(mesh.point(d), mesh.point(b), mesh.point(c));
    constexpr double kLeastCosine = 0.3;  // ours: the new faces keep facing the way the old ones did
    const auto faces_away = [&](const Vec3& cross, VertexHandle p, VertexHandle q, VertexHandle r) {
      return has_area(cross, mesh.point(p), mesh.point(q), mesh.point(r)) &&
             cross.dot(normal) < kLeastCosine * cross.norm() * normal.norm();
    };
    if (faces_away(first, c, a, d) || faces_away(second, d, b, c)) continue;
    mesh.flip(e);
    valences.flip(a, b, c, d);
  }
}

Vec3 vertex_normal(const Mesh& mesh, VertexHandle v) {
  Vec3 normal = Vec3::Zero();
  for (const HalfedgeHandle h : mesh.voh_range(v)) {
    if (mesh.is_boundary(h)) continue;
    normal += face_cross(mesh.point(v), mesh.point(mesh.to_vertex_handle(h)),
                         mesh.point(mesh.to_vertex_handle(mesh.next_halfedge_handle(h))));
  }
  return normal.norm() > 0 ? Vec3(normal.normalized()) : normal;
}

// Area-weighted centre of the neighbouring faces: keeps the density that the target lengths ask for.
Vec3 relaxed_place(const Mesh& mesh, VertexHandle v) {
  Vec3 sum = Vec3::Zero();
  double weight = 0;
  for (const VertexHandle n : mesh.vv_range(v)) {
    const double w = 1 / std::max(mesh.data(n).length, 1e-300);
    sum += w * mesh.point(n);
    weight += w;
  }
  return sum / weight;
}

void relax(Mesh& mesh, const Projection& project, double share) {
  std::vector<Vec3> places;
  for (const VertexHandle v : mesh.vertices()) {
    Vec3 place = mesh.point(v);
    if (!mesh.data(v).is_fixed && !mesh.is_boundary(v)) {
      Vec3 step = share * (relaxed_place(mesh, v) - place);
      if (project) {
        const Vec3 normal = vertex_normal(mesh, v);
        step -= normal * normal.dot(step);
      }
      place += step;
      if (project) place = project(place);
    }
    places.push_back(place);
  }
  for (const VertexHandle v : mesh.vertices()) {
    Vec3 place = places[v.idx()];
    for (int halving = 0; halving < 3 && turns_faces(mesh, v, place, kTurnsWhenMoved); ++halving)
      place = 0.5 * (place + mesh.point(v));
    if (!turns_faces(mesh, v, place, kTurnsWhenMoved)) mesh.set_point(v, place);
  }
}

// log of the target length: harmonic over the graph, border vertices hold the mean of their border edges.
void set_target_lengths(Mesh& mesh, double inner_scale) {
  const int count = static_cast<int>(mesh.n_vertices());
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  std::vector<Eigen::Triplet<double>> entries;
  for (const VertexHandle v : mesh.vertices()) {
    if (mesh.is_boundary(v)) {
      double sum = 0;
      int edges = 0;
      for (const EdgeHandle e : mesh.ve_range(v))
        if (mesh.is_boundary(e)) sum += mesh.calc_edge_length(e), ++edges;
      entries.emplace_back(v.idx(), v.idx(), 1);
      right[v.idx()] = std::log(std::max(sum / std::max(edges, 1), 1e-300));
      continue;
    }
    for (const VertexHandle n : mesh.vv_range(v)) {
      entries.emplace_back(v.idx(), v.idx(), 1);
      if (mesh.is_boundary(n)) continue;
      entries.emplace_back(v.idx(), n.idx(), -1);
    }
  }
  // Known values move to the right-hand side, so the matrix stays symmetric.
  for (const VertexHandle v : mesh.vertices())
    if (!mesh.is_boundary(v))
      for (const VertexHandle n : mesh.vv_range(v))
        if (mesh.is_boundary(n)) right[v.idx()] += right[n.idx()];
  Eigen::SparseMatrix<double> system(count, count);
  system.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(system);
  const Eigen::VectorXd logarithm = solver.solve(right);
  for (const VertexHandle v : mesh.vertices())
    mesh.data(v).length = std::exp(logarithm[v.idx()]) * (mesh.is_boundary(v) ? 1 : inner_scale);
}

// Whether a directed edge is used twice: OpenMesh would leave out the face, and say so on stderr.
bool has_complex_edge(const TrianglePatch& patch) {
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  for (const Triangle& t : patch.triangles)
    for (int k = 0; k < 3; ++k)
      if (!edges.insert({t[k], t[(k + 1) % 3]}).second) return true;
  return false;
}

Mesh to_mesh(const TrianglePatch& patch) {
  Mesh mesh;
  for (std::size_t v = 0; v < patch.positions.size(); ++v)
    mesh.data(mesh.add_vertex(patch.positions[v])).is_fixed = v < patch.fixed;
  for (const Triangle& t : patch.triangles)
    mesh.add_face(mesh.vertex_handle(t[0]), mesh.vertex_handle(t[1]), mesh.vertex_handle(t[2]));
  return mesh;
}

TrianglePatch to_patch(const Mesh& mesh, std::size_t fixed) {
  TrianglePatch patch;
  patch.fixed = fixed;
  for (const VertexHandle v : mesh.vertices()) patch.positions.push_back(mesh.point(v));
  for (const auto f : mesh.faces()) {
    Triangle t{};
    int k = 0;
    for (const VertexHandle v : mesh.fv_range(f)) t[k++] = v.idx();
    patch.triangles.push_back(t);
  }
  return patch;
}

}  // namespace

TrianglePatch remesh(const TrianglePatch& patch, const Projection& project, const RemeshOptions& options) {
  if (has_complex_edge(patch)) return patch;  // better unchanged than with a hole
  Mesh mesh = to_mesh(patch);
  if (mesh.n_faces() != patch.triangles.size()) return patch;  // a vertex that OpenMesh does not take
  set_target_lengths(mesh, options.length_scale);
  for (int pass = 0; pass < options.passes; ++pass) {
    split_long_edges(mesh, options.split_ratio);
    collapse_short_edges(mesh, options);
    flip_towards_regular(mesh);
    relax(mesh, project, options.relax);
  }
  for (int pass = 0; pass < 3; ++pass) relax(mesh, project, options.relax / 2);
  return without_unused_vertices(to_patch(mesh, patch.fixed));
}

}  // namespace skinforge
