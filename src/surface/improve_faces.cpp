#include "surface/improve_faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/scaled_jacobian.h"

namespace skinforge {
namespace {

// What counts beside the lack of quality (ours): voxels off the surface, beyond the first; the squared
// distance from the middle of the neighbours, in edges; and badness that hardly changes, at which a vertex
// stays. And what a unit normal and the field's gradient lack to that product.
constexpr double kOff = 0.5, kOffWeight = 0.2, kEvenWeight = 0.2, kFlat = 1e-3, kFacing = 0.2,
                 kFacingWeight = 4;

constexpr double kRestWorst = 0.1;  // ours: what all that counts beside it is worth to the worst face
constexpr int kRounds = 10;
constexpr double kFirstStep = 0.6,
                 kShrink = 0.8;  // ours: how far is asked and gone, of the mean edge at the vertex
constexpr double kDamping =
    0.5;  // ours: whole steps made noise in the last bit of a position grow a hundredfold

class Search {
 public:
  Search(QuadPatch& patch, const WantedSurface& surface, FaceGoal goal, const PatchMirror* mirror)
      : patch_(patch),
        surface_(surface),
        mirror_(mirror),
        goal_(goal),
        rest_(goal == FaceGoal::Worst ? kRestWorst : 1),
        faces_(patch.positions.size()),
        facing_weight_(std::isfinite(surface.voxel) ? kFacingWeight : 0),
        seen_(patch.quads.size() + patch.triangles.size()) {
    for (std::size_t f = 0; f < face_count(); ++f)
      for (const std::int32_t v : face(f)) faces_[v].push_back(f);
  }

  // Every free vertex towards less badness. No place is compared with another: where a vertex goes depends on
  // all numbers continuously, so equal inputs at two scales stay alike.
  void run() {
    double step = kFirstStep;
    for (int round = 0; round < kRounds; ++round, step *= kShrink) {
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
    Vec3 centre = Vec3::Zero();
  };
  Shape shape(std::size_t f) const {
    Shape s;
    for (const std::int32_t v : face(f)) s.centre += s.corners[s.count++] = patch_.positions[v];
    s.centre /= static_cast<double>(s.count);
    return s;
  }

  static Vec3 unit_normal(const Shape& s) {
    const auto& c = s.corners;
    const Vec3 normal = s.count == 4 ? (c[2] - c[0]).cross(c[3] - c[1]) : (c[1] - c[0]).cross(c[2] - c[0]);
    return normal.norm() > 0 ? Vec3(normal.normalized()) : normal;
  }
  // `facing`: of the unit normal and the way outward.
  static double quality(const Shape& s, double facing) {
    const double jacobian = scaled_jacobian(std::span(s.corners).first(s.count));
    return facing < 0 ? std::min(jacobian, 0.0) - 1 : jacobian;
  }
  // The surface beneath each face, before its vertices are moved about. What it is like at the places tried
  // is told from there: asking anew for each costs ten times as much.
  void look() {
    for (std::size_t f = 0; f < face_count(); ++f) {
      const Vec3 centre = shape(f).centre;
      seen_[f] = {centre, surface_.outward(centre), surface_.distance(centre)};
    }
  }

  // In sum over the faces around. A cube weighs the worst most, and still gains from all, its square the
  // worst above all; what is off the surface by more than the gate allows for most faces counts, too, and
  // what all but turns away from it, as faces do that span a thin part, where the field in their middle is
  // flat (ours).
  double badness_around(std::int32_t v) const {
    double sum = 0;
    for (const std::size_t f : faces_[v]) {
      const Shape s = shape(f);
      const Seen& seen = seen_[f];
      const double facing = unit_normal(s).dot(seen.outward), away = std::max(kFacing - facing, 0.0);
      const double distance = seen.distance + seen.outward.dot(s.centre - seen.centre);
      const double bad = 1 - quality(s, facing),
                   off = std::max(std::abs(distance) / surface_.voxel - kOff, 0.0);
      const double cube = bad * bad * bad;
      sum += (goal_ == FaceGoal::Worst ? cube * cube : cube) + rest_ * kOffWeight * off * off +
             facing_weight_ * away * away;
    }
    return sum;
  }

  // Two unit tangents at a vertex, the middle of its neighbours, and the mean length of its edges; none where
  // its faces have no direction.
  struct Frame {
    Vec3 x, y, middle;
    double length;
  };
  std::optional<Frame> frame(std::int32_t v) const {
    Vec3 normal = Vec3::Zero(), middle = Vec3::Zero();
    double length = 0;
    int edges = 0;
    for (const std::size_t f : faces_[v]) {
      const auto vertices = face(f);
      const std::size_t k = place_in(f, v), n = vertices.size();
      const Vec3 next = patch_.positions[vertices[(k + 1) % n]] - patch_.positions[v];
      const Vec3 last = patch_.positions[vertices[(k + n - 1) % n]] - patch_.positions[v];
      normal += next.cross(last);
      middle += next + last;
      length += next.norm() + last.norm();
      edges += 2;
    }
    normal = normal.norm() > 0 ? Vec3(normal.normalized()) : Vec3(Vec3::UnitZ());
    const auto ring = face(faces_[v].front());
    const Vec3 along =
        patch_.positions[ring[(place_in(faces_[v].front(), v) + 1) % ring.size()]] - patch_.positions[v];
    const Vec3 x = (along - along.dot(normal) * normal).normalized();
    if (!x.allFinite()) return std::nullopt;
    return Frame{x, normal.cross(x), patch_.positions[v] + middle / edges, length / edges};
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
    const double reach = step * at->length;
    const auto badness = [&](const Vec3& place) {
      this->move(v, place);
      return badness_around(v) +
             rest_ * kEvenWeight * (place - at->middle).squaredNorm() / (at->length * at->length);
    };
    const double here = badness(start);
    Vec3 step_taken = Vec3::Zero();
    for (const Vec3& axis : {at->x, at->y}) {
      const double ahead = badness(start + reach * axis), behind = badness(start - reach * axis);
      const double slope = (ahead - behind) / 2, curvature = ahead + behind - 2 * here;
      step_taken -= slope / (std::abs(curvature) + std::abs(slope) + rest_ * kFlat) * reach * axis;
    }
    move(v, surface_.project(start + kDamping * step_taken));
  }

  QuadPatch& patch_;
  const WantedSurface& surface_;
  const PatchMirror* mirror_;
  FaceGoal goal_;
  double rest_;  // what counts beside the lack of quality, by this
  std::vector<std::vector<std::size_t>> faces_;
  double facing_weight_;  // 0 where the way outward is a guess
  struct Seen {
    Vec3 centre, outward;
    double distance;
  };
  std::vector<Seen> seen_;  // of each face
};

}  // namespace

void improve_faces(QuadPatch& patch, const WantedSurface& surface, FaceGoal goal, const PatchMirror* mirror) {
  Search(patch, surface, goal, mirror).run();
}

}  // namespace skinforge
