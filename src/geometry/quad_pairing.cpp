#include "geometry/quad_pairing.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>

#include "geometry/edges.h"
#include "geometry/scaled_jacobian.h"

namespace skinforge {
namespace {

constexpr double kSameUv = 1e-5;        // ours: a hundredth of a texel of a 1k image
constexpr double kSameColor = 2e-3;     // ours: half a step of 8 bits
constexpr double kLeastFlatness = 0.5;  // ours: normals 60 degrees apart are a modelled edge, not a bent quad

constexpr double kScoreStep = 1.0 / 4096;  // ours: mirrored pairs score alike, whatever their last bits say

// Two triangles that share the edge p-q, by corner: p, q, r of the first, q', p', s of the second.
struct Pair {
  std::int32_t p, q, r;
  std::int32_t p2, q2, s;
};

struct Candidate {
  double rank = 0;  // the score and the bonus
  std::int32_t edge = 0;
  Pair pair{};
};

bool is_triangle(const PolygonMesh& mesh, FaceId f) {
  return mesh.face(f).size() == 3;
}

std::optional<Pair> triangle_pair(const PolygonMesh& mesh, const EdgeList& edges, const Edge& edge) {
  if (edge.half_edges.size() != 2) return std::nullopt;
  const std::int32_t p = edge.half_edges[0], q2 = edge.half_edges[1];
  const FaceId first = edges.face_of_corner[p], second = edges.face_of_corner[q2];
  if (first == second || !is_triangle(mesh, first) || !is_triangle(mesh, second)) return std::nullopt;
  if (mesh.face_material[first.index()] != mesh.face_material[second.index()]) return std::nullopt;
  if (mesh.face_part[first.index()] != mesh.face_part[second.index()]) return std::nullopt;
  if (mesh.corners[p] == mesh.corners[q2]) return std::nullopt;  // the two faces turn different ways
  const std::int32_t q = edges.next_corner[p], p2 = edges.next_corner[q2];
  return Pair{p, q, edges.next_corner[q], p2, q2, edges.next_corner[p2]};
}

bool is_seam(const PolygonMesh& mesh, std::int32_t a, std::int32_t b) {
  for (const auto& uv : mesh.uvs)
    if ((uv[a] - uv[b]).cwiseAbs().maxCoeff() > kSameUv) return true;
  return !mesh.colors.empty() && (mesh.colors[a] - mesh.colors[b]).cwiseAbs().maxCoeff() > kSameColor;
}

// Score of the merged quad; none if it is folded, bent or without area.
std::optional<double> quad_score(const PolygonMesh& mesh, const Pair& pair) {
  const auto at = [&](std::int32_t corner) -> const Vec3& {
    return mesh.positions[mesh.corners[corner].index()];
  };
  const Vec3 &p = at(pair.p), &q = at(pair.q), &r = at(pair.r), &s = at(pair.s);
  const Vec3 n1 = (q - p).cross(r - p), n2 = (p - q).cross(s - q);
  const double lengths = n1.norm() * n2.norm();
  if (!(lengths > 0)) return std::nullopt;
  const double flatness = n1.dot(n2) / lengths;
  const double jacobian = scaled_jacobian_of_quad(p, s, q, r);
  if (flatness < kLeastFlatness || jacobian <= 0) return std::nullopt;
  return std::round((0.5 * jacobian + 0.5 * flatness) / kScoreStep) * kScoreStep;
}

std::vector<Candidate> rated_pairs(const PolygonMesh& mesh, const EdgeList& edges,
                                   const QuadPairingOptions& options) {
  std::vector<Candidate> candidates;
  for (std::size_t e = 0; e < edges.edges.size(); ++e) {
    const auto pair = triangle_pair(mesh, edges, edges.edges[e]);
    if (!pair || is_seam(mesh, pair->p, pair->p2) || is_seam(mesh, pair->q, pair->q2)) continue;
    const auto score = quad_score(mesh, *pair);
    if (!score || *score < options.min_score) continue;
    const std::int32_t apart = edges.face_of_corner[pair->p].value - edges.face_of_corner[pair->p2].value;
    const double bonus = std::abs(apart) == 1 ? options.follower_bonus : 0;
    candidates.push_back({*score + bonus, static_cast<std::int32_t>(e), *pair});
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.rank != b.rank ? a.rank > b.rank : a.edge < b.edge;
  });
  return candidates;
}

// Copies faces corner by corner with all their attributes.
class MeshCopy {
 public:
  explicit MeshCopy(const PolygonMesh& from) : from_(from) {
    to_.positions = from.positions;
    to_.parts = from.parts;
    to_.uvs.resize(from.uvs.size());
    to_.face_begin = {0};
  }

  void add_corner(std::int32_t c) {
    to_.corners.push_back(from_.corners[c]);
    to_.normals.push_back(from_.normals[c]);
    for (std::size_t set = 0; set < from_.uvs.size(); ++set) to_.uvs[set].push_back(from_.uvs[set][c]);
    if (!from_.colors.empty()) to_.colors.push_back(from_.colors[c]);
  }

  // The quad p s q r of triangles (p, s, q) and (p, q, r).
  void add_quad(const Pair& pair) {
    const auto normal = [&](std::int32_t corner) -> const Vec3& { return from_.normals[corner]; };
    if (normal(pair.p) != normal(pair.p2) || normal(pair.q) != normal(pair.q2))
      to_.split.push_back(
          {FaceId(to_.face_count()), {normal(pair.p2), normal(pair.q2)}, {normal(pair.p), normal(pair.q)}});
    add_corner(pair.p, pair.p2);
    add_corner(pair.s);
    add_corner(pair.q, pair.q2);
    add_corner(pair.r);
  }

  // A corner where two faces met: equal but, perhaps, for the normal.
  void add_corner(std::int32_t c, std::int32_t other) {
    add_corner(c);
    const Vec3 sum = from_.normals[c] + from_.normals[other];
    if (from_.normals[c] != from_.normals[other] && sum.squaredNorm() > 0)
      to_.normals.back() = sum.normalized();
  }

  void end_face(FaceId like) {
    to_.face_begin.push_back(static_cast<std::int32_t>(to_.corners.size()));
    to_.face_material.push_back(from_.face_material[like.index()]);
    to_.face_part.push_back(from_.face_part[like.index()]);
  }

  PolygonMesh take() { return std::move(to_); }

 private:
  const PolygonMesh& from_;
  PolygonMesh to_;
};

}  // namespace

PolygonMesh recover_quads(const PolygonMesh& mesh, const QuadPairingOptions& options) {
  const EdgeList edges = build_edges(mesh);
  const std::vector<Candidate> candidates = rated_pairs(mesh, edges, options);
  constexpr std::int32_t kAlone = -1, kMerged = -2;
  std::vector<std::int32_t> chosen(mesh.face_count(), kAlone);  // by first face: its candidate
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    std::int32_t& a = chosen[edges.face_of_corner[candidates[i].pair.p].index()];
    std::int32_t& b = chosen[edges.face_of_corner[candidates[i].pair.p2].index()];
    if (a != kAlone || b != kAlone) continue;
    const bool a_first = candidates[i].pair.p < candidates[i].pair.p2;
    (a_first ? a : b) = static_cast<std::int32_t>(i);
    (a_first ? b : a) = kMerged;
  }
  MeshCopy copy(mesh);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    if (chosen[f] == kMerged) continue;
    if (chosen[f] == kAlone) {
      for (std::int32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) copy.add_corner(c);
    } else {
      copy.add_quad(candidates[static_cast<std::size_t>(chosen[f])].pair);
    }
    copy.end_face(FaceId(f));
  }
  return copy.take();
}

}  // namespace skinforge
