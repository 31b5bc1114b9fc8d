#include "diff/corner_diff.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "diff/surface_diff.h"

namespace skinforge {

namespace {
struct Corner {
  FaceId face;
  std::size_t corner = 0;  // of the mesh
};

// Items by a key below `count`, in one array.
template <class Item>
class Buckets {
 public:
  explicit Buckets(std::size_t count) : begin_(count + 1, 0) {}

  // Each key once for each of its items, then each item with the same keys.
  void announce(std::size_t key) { ++begin_[key + 1]; }
  void finish_announcing() {
    for (std::size_t k = 1; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
    items_.resize(begin_.back());
    next_.assign(begin_.begin(), begin_.end() - 1);
  }
  void add(std::size_t key, const Item& item) { items_[next_[key]++] = item; }
  std::span<const Item> of(std::size_t key) const {
    return std::span(items_).subspan(begin_[key], begin_[key + 1] - begin_[key]);
  }

 private:
  std::vector<std::size_t> begin_, next_;
  std::vector<Item> items_;
};

Buckets<Corner> corners_by_vertex(const PolygonMesh& mesh) {
  Buckets<Corner> buckets(mesh.vertex_count());
  for (const VertexId v : mesh.corners) buckets.announce(v.index());
  buckets.finish_announcing();
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    std::size_t corner = mesh.first_corner(FaceId(f));
    for (const VertexId v : mesh.face(FaceId(f))) buckets.add(v.index(), {FaceId(f), corner++});
  }
  return buckets;
}

// Per vertex of A those of B that it stands for.
Buckets<VertexId> vertices_by_counterpart(const Correspondence& same) {
  Buckets<VertexId> buckets(same.vertices.size());
  const auto for_each = [&](const auto& visit) {
    for (std::size_t v = 0; v < same.vertices.size(); ++v)
      if (const VertexId w = same.vertices[v]; w.is_valid() && same.back[w.index()] != VertexId(v))
        visit(v, w);
    for (std::size_t w = 0; w < same.back.size(); ++w)
      if (same.back[w].is_valid()) visit(same.back[w].index(), VertexId(w));
  };
  for_each([&](std::size_t v, VertexId) { buckets.announce(v); });
  buckets.finish_announcing();
  for_each([&](std::size_t v, VertexId w) { buckets.add(v, w); });
  return buckets;
}

// A quad that was two triangles has two normals at the ends of its diagonal.
std::vector<Vec3> normals_of(const PolygonMesh& mesh, const Corner& at) {
  const SplitNormals* split = mesh.split_of(at.face);
  const std::size_t k = at.corner - mesh.first_corner(at.face);
  if (split && k % 2 == 0) return {split->first[k / 2], split->second[k / 2]};
  return {mesh.normals[at.corner]};
}

double angle_deg(const Vec3& a, const Vec3& b) {
  return degrees(2 * std::atan2((a - b).norm(), (a + b).norm()));
}

std::vector<Vec3> face_normals(const PolygonMesh& mesh) {
  std::vector<Vec3> normals;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) normals.push_back(area_normal(mesh, FaceId(f)));
  return normals;
}

// Finds the corners of B that stand for one of A.
class CornerMatch {
 public:
  CornerMatch(const Character& a, const Character& b, const Correspondence& same)
      : a_(a.mesh),
        b_(b.mesh),
        same_(same),
        normals_a_(face_normals(a.mesh)),
        normals_b_(face_normals(b.mesh)),
        corners_(corners_by_vertex(b.mesh)),
        counterparts_(vertices_by_counterpart(same)) {}

  std::vector<Corner> of(FaceId face, VertexId vertex) const {
    std::vector<Corner> best;
    int most = 0;
    const Vec3& normal = normals_a_[face.index()];
    for (const VertexId w : counterparts_.of(vertex.index()))
      for (const Corner& candidate : corners_.of(w.index())) {
        const bool is_turned = normal.dot(normals_b_[candidate.face.index()]) < 0;
        const int likeness = 2 * shared_vertices(face, candidate.face) + (is_turned ? 0 : 1);
        if (likeness < most) continue;
        if (likeness > most) best.clear();
        most = likeness;
        best.push_back(candidate);
      }
    return best;
  }

 private:
  bool stand_for_each_other(VertexId v, VertexId w) const {
    return same_.vertices[v.index()] == w || same_.back[w.index()] == v;
  }
  int shared_vertices(FaceId of_a, FaceId of_b) const {
    const auto ring = b_.face(of_b);
    const auto is_there = [&](VertexId v) {
      return std::any_of(ring.begin(), ring.end(), [&](VertexId w) { return stand_for_each_other(v, w); });
    };
    const auto face = a_.face(of_a);
    return static_cast<int>(std::count_if(face.begin(), face.end(), is_there));
  }

  const PolygonMesh &a_, &b_;
  const Correspondence& same_;
  std::vector<Vec3> normals_a_, normals_b_;  // of faces
  Buckets<Corner> corners_;
  Buckets<VertexId> counterparts_;
};

constexpr double kNone = -1;  // in place of an angle or distance: not compared

double normal_angle(const PolygonMesh& a, const Corner& at, const PolygonMesh& b,
                    const std::vector<Corner>& matches) {
  double largest = kNone;
  for (const Vec3& normal : normals_of(a, at)) {
    double nearest = kNone;
    for (const Corner& match : matches)
      for (const Vec3& other : normals_of(b, match)) {
        if (normal.isZero() || other.isZero()) continue;
        const double angle = angle_deg(normal, other);
        nearest = nearest == kNone ? angle : std::min(nearest, angle);
      }
    largest = std::max(largest, nearest);
  }
  return largest;
}

int uv_sets_of(const PolygonMesh& mesh, FaceId face) {
  return mesh.parts[mesh.face_part[face.index()].index()].uv_sets;
}

double uv_distance(const PolygonMesh& a, const Corner& at, const PolygonMesh& b,
                   const std::vector<Corner>& matches) {
  double largest = kNone;
  for (int set = 0; set < uv_sets_of(a, at.face); ++set) {
    double nearest = kNone;
    for (const Corner& match : matches) {
      if (set >= uv_sets_of(b, match.face)) continue;
      const auto s = static_cast<std::size_t>(set);
      const double distance = (a.uvs[s][at.corner] - b.uvs[s][match.corner]).norm();
      nearest = nearest == kNone ? distance : std::min(nearest, distance);
    }
    largest = std::max(largest, nearest);
  }
  return largest;
}

// `values`: per corner of A.
CornerDiff summed_up(const Character& a, const std::vector<double>& values) {
  CornerDiff diff;
  double sum = 0;
  VertexId worst;
  for (std::size_t c = 0; c < values.size(); ++c) {
    if (values[c] == kNone) continue;
    ++diff.compared;
    sum += values[c];
    if (values[c] <= diff.max) continue;
    diff.max = values[c];
    worst = a.mesh.corners[c];
  }
  if (diff.compared > 0) diff.mean = sum / double(diff.compared);
  if (worst.is_valid()) diff.joint = heaviest_joint(a, worst);
  return diff;
}
}  // namespace

void compare_corners(const Character& a, const Character& b, const Correspondence& same, GeometryDiff& diff) {
  const CornerMatch match(a, b, same);
  std::vector<double> normals(a.mesh.corner_count(), kNone), uvs = normals;
  constexpr std::size_t kChunk = 256;
  parallel_chunks(a.mesh.face_count(), kChunk, [&](std::size_t first, std::size_t last) {
    for (std::size_t f = first; f < last; ++f) {
      Corner at{FaceId(f), a.mesh.first_corner(FaceId(f))};
      for (const VertexId v : a.mesh.face(FaceId(f))) {
        const std::vector<Corner> matches = match.of(FaceId(f), v);
        normals[at.corner] = normal_angle(a.mesh, at, b.mesh, matches);
        uvs[at.corner] = uv_distance(a.mesh, at, b.mesh, matches);
        ++at.corner;
      }
    }
  });
  diff.normals_deg = summed_up(a, normals);
  diff.uvs = summed_up(a, uvs);
}

}  // namespace skinforge
