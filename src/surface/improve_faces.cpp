#include "surface/improve_faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

namespace skinforge {
namespace {

constexpr double kFlat = 1e-3;  // ours: badness that hardly changes, at which a vertex stays
constexpr double kDamping =
    0.5;  // ours: whole steps made noise in the last bit of a position grow a hundredfold

// Rounds of steps that shrink (ours).
struct Pace {
  int rounds;
  double first_step, shrink;  // how far is asked and gone, of the mean edge at the vertex
  double evenness;            // weight of the squared distance from the middle of the neighbours, in edges
  bool is_careful;            // steps are shorter where a vertex has short edges among long ones
};

// A few rounds tell tables apart; in them a vertex goes an edge or two at most, and what is far from where it
// belongs needs many. So many turn a face over where a step is longer than the face is wide, and noise in the
// last bit grew ten thousandfold by it; but the first few find less with careful steps.
Pace pace_of(FaceGoal goal) {
  if (goal == FaceGoal::Settled) return {60, 0.6, 0.97, 0.1, true};
  return {10, 0.6, 0.8, 0.2, false};
}

class Search {
 public:
  Search(QuadPatch& patch, const WantedSurface& surface, FaceGoal goal, const PatchMirror* mirror)
      : patch_(patch),
        surface_(surface),
        mirror_(mirror),
        pace_(pace_of(goal)),
        badness_(goal, surface.voxel),
        faces_(patch.positions.size()),
        seen_(patch.quads.size() + patch.triangles.size()) {
    for (std::size_t f = 0; f < face_count(); ++f)
      for (const std::int32_t v : face(f)) faces_[v].push_back(f);
  }

  // Every free vertex towards less badness. No place is compared with another: where a vertex goes depends on
  // all numbers continuously, so equal inputs at two scales stay alike.
  void run() {
    double step = pace_.first_step;
    for (int round = 0; round < pace_.rounds; ++round, step *= pace_.shrink) {
      look();
      for (std::size_t v = patch_.fixed; v < patch_.positions.size(); ++v)
        if (!faces_[v].empty() && is_leading(v)) descend(static_cast<std::int32_t>(v), step);
    }
  }

 private:
  std::size_t face_count() const { return patch_.quads.size() + patch_.triangles.size(); }
  std::span<const std::int32_t> face(std::size_t f) const {
    if (f < patch_.quads.size()) return patch_.quads[f];
    return patch_.triangles[f - patch_.quads.size()];
  }

  // Of a vertex and its image the one that is moved.
  bool is_leading(std::size_t v) const {
    return !mirror_ || mirror_->image[v] >= static_cast<std::int32_t>(v);
  }

  void move(std::int32_t v, const Vec3& place) {
    patch_.positions[v] = place;
    if (!mirror_) return;
    const std::int32_t image = mirror_->image[v];
    patch_.positions[image] = image == v ? mirror_->plane.onto(place) : mirror_->plane.mirrored(place);
  }

  struct Shape {
    std::array<Vec3, 4> corners;
    std::size_t count = 0;

    std::span<const Vec3> polygon() const { return std::span(corners).first(count); }
  };
  Shape shape(std::size_t f) const {
    Shape s;
    for (const std::int32_t v : face(f)) s.corners[s.count++] = patch_.positions[v];
    return s;
  }

  // The surface beneath each face, before its vertices are moved about.
  void look() {
    for (std::size_t f = 0; f < face_count(); ++f) {
      Vec3 centre = Vec3::Zero();
      for (const std::int32_t v : face(f)) centre += patch_.positions[v];
      centre /= static_cast<double>(face(f).size());
      seen_[f] = {centre, surface_.outward(centre), surface_.distance(centre)};
    }
  }

  double badness_around(std::int32_t v) const {
    double sum = 0;
    for (const std::size_t f : faces_[v]) sum += badness_.of(shape(f).polygon(), seen_[f]);
    return sum;
  }

  // Two unit tangents at a vertex, the middle of its neighbours, and the mean and the harmonic mean of the
  // lengths of its edges; none where its faces have no direction.
  struct Frame {
    Vec3 x, y, middle;
    double length, harmonic;
  };
  std::optional<Frame> frame(std::int32_t v) const {
    Vec3 normal = Vec3::Zero(), middle = Vec3::Zero();
    double length = 0, inverse = 0;
    int edges = 0;
    for (const std::size_t f : faces_[v]) {
      const auto vertices = face(f);
      const std::size_t k = place_in(f, v), n = vertices.size();
      const Vec3 next = patch_.positions[vertices[(k + 1) % n]] - patch_.positions[v];
      const Vec3 last = patch_.positions[vertices[(k + n - 1) % n]] - patch_.positions[v];
      normal += next.cross(last);
      middle += next + last;
      length += next.norm() + last.norm();
      inverse += 1 / next.norm() + 1 / last.norm();
      edges += 2;
    }
    normal = normal.norm() > 0 ? Vec3(normal.normalized()) : Vec3(Vec3::UnitZ());
    const auto ring = face(faces_[v].front());
    const Vec3 along =
        patch_.positions[ring[(place_in(faces_[v].front(), v) + 1) % ring.size()]] - patch_.positions[v];
    const Vec3 x = (along - along.dot(normal) * normal).normalized();
    if (!x.allFinite()) return std::nullopt;
    return Frame{x, normal.cross(x), patch_.positions[v] + middle / edges, length / edges, edges / inverse};
  }

  std::size_t place_in(std::size_t f, std::int32_t v) const {
    const auto vertices = face(f);
    return static_cast<std::size_t>(std::find(vertices.begin(), vertices.end(), v) - vertices.begin());
  }

  // Half a damped Newton step along either tangent, at most `step` edges long, drawn towards the middle of
  // the vertex's neighbours where that costs little.
  void descend(std::int32_t v, double step) {
    const auto at = frame(v);
    if (!at) return;
    const Vec3 start = patch_.positions[v];
    const double reach = step * (pace_.is_careful ? std::sqrt(at->length * at->harmonic) : at->length);
    const auto badness = [&](const Vec3& place) {
      this->move(v, place);
      return badness_around(v) + badness_.rest() * pace_.evenness * (place - at->middle).squaredNorm() /
                                     (at->length * at->length);
    };
    const double here = badness(start);
    Vec3 step_taken = Vec3::Zero();
    for (const Vec3& axis : {at->x, at->y}) {
      const double ahead = badness(start + reach * axis), behind = badness(start - reach * axis);
      const double slope = (ahead - behind) / 2, curvature = ahead + behind - 2 * here;
      step_taken -= slope / (std::abs(curvature) + std::abs(slope) + badness_.rest() * kFlat) * reach * axis;
    }
    move(v, surface_.project(start + kDamping * step_taken));
  }

  QuadPatch& patch_;
  const WantedSurface& surface_;
  const PatchMirror* mirror_;
  Pace pace_;
  FaceBadness badness_;
  std::vector<std::vector<std::size_t>> faces_;
  std::vector<SurfaceBeneath> seen_;  // of each face
};

}  // namespace

void improve_faces(QuadPatch& patch, const WantedSurface& surface, FaceGoal goal, const PatchMirror* mirror) {
  Search(patch, surface, goal, mirror).run();
}

}  // namespace skinforge
