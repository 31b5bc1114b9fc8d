#include "animation/skin_balls.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "skeleton/pose.h"

namespace skinforge {
namespace {

constexpr double kInside = 0.8;          // ours: of the mean distance of skin from its axis
constexpr std::size_t kMostBalls = 4;    // ours: along one joint
constexpr std::size_t kFewVertices = 4;  // less are no limb
constexpr double kBulge = 0.35;          // ours: of the thickness; skin farther outside the balls than that
constexpr std::size_t kMostBulges = 4;   // ours: of one joint

// The vertices that each joint moves most, in the joint's frame.
std::vector<std::vector<Vec3>> vertices_by_joint(const Character& input) {
  std::vector<std::vector<Vec3>> vertices(input.skeleton.size());
  for (std::size_t v = 0; v < input.weights.vertex_count(); ++v) {
    const auto row = input.weights.of(VertexId(v));
    if (row.empty()) continue;
    const auto most = std::max_element(
        row.begin(), row.end(), [](const Influence& a, const Influence& b) { return a.weight < b.weight; });
    vertices[most->joint.index()].push_back(input.skeleton[most->joint].joint_from_model *
                                            input.mesh.positions[v]);
  }
  return vertices;
}

// The line along which the skin of a joint lies, and how thick it is around it; all in the joint's frame.
struct SkinAxis {
  Vec3 middle = Vec3::Zero(), direction = Vec3::UnitX();
  double low = 0, high = 0;  // ends, from the middle
  double thickness = 0;      // mean distance of the skin

  explicit SkinAxis(const std::vector<Vec3>& points) {
    for (const Vec3& p : points) middle += p / static_cast<double>(points.size());
    Mat3 spread = Mat3::Zero();
    for (const Vec3& p : points) spread += (p - middle) * (p - middle).transpose();
    direction = Eigen::SelfAdjointEigenSolver<Mat3>(spread).eigenvectors().col(2);
    for (const Vec3& p : points) {
      const double along = direction.dot(p - middle);
      low = std::min(low, along);
      high = std::max(high, along);
      thickness += (p - middle - along * direction).norm() / static_cast<double>(points.size());
    }
  }
  Vec3 at(double share) const { return middle + (low + share * (high - low)) * direction; }
  Vec3 nearest(const Vec3& p) const { return middle + direction.dot(p - middle) * direction; }
};

struct Ball {
  Vec3 center;
  double radius;  // of the skin around it

  double distance(const Vec3& p) const { return (p - center).norm() - radius; }
};

// As thick as the skin is in the mean, side by side along the axis.
std::vector<Ball> balls_along(const SkinAxis& axis) {
  const double across = 2 * kInside * axis.thickness;
  const auto count = static_cast<std::size_t>(
      std::clamp((axis.high - axis.low) / across, 1.0, static_cast<double>(kMostBalls)));
  std::vector<Ball> balls;
  for (std::size_t k = 0; k < count; ++k)
    balls.push_back({axis.at((static_cast<double>(k) + 0.5) / static_cast<double>(count)), axis.thickness});
  return balls;
}

// Where the skin lies farther out than the balls (the shoulders of a horse), half way from there to the axis.
void add_bulges(const SkinAxis& axis, const std::vector<Vec3>& points, std::vector<Ball>& balls) {
  std::vector<double> outside(points.size(), std::numeric_limits<double>::infinity());
  const auto see = [&](const Ball& ball) {
    for (std::size_t k = 0; k < points.size(); ++k)
      outside[k] = std::min(outside[k], ball.distance(points[k]));
  };
  for (const Ball& ball : balls) see(ball);
  for (std::size_t k = 0; k < kMostBulges; ++k) {
    const auto farthest = std::max_element(outside.begin(), outside.end());
    if (*farthest <= kBulge * axis.thickness) return;
    const Vec3& skin = points[static_cast<std::size_t>(farthest - outside.begin())];
    const Vec3 inwards = 0.5 * (axis.nearest(skin) - skin);
    balls.push_back({skin + inwards, inwards.norm()});
    see(balls.back());
    *farthest = 0;
  }
}

void add_balls(JointId joint, const std::vector<Vec3>& points, double model_scale,
               std::vector<SkinBall>& balls) {
  const SkinAxis axis(points);
  if (!(axis.thickness > 0)) return;
  std::vector<Ball> found = balls_along(axis);
  add_bulges(axis, points, found);
  for (const Ball& ball : found)
    if (ball.radius > 0) balls.push_back({joint, ball.center, kInside * ball.radius * model_scale});
}

// `joints`: model_from_joint of the input.
std::vector<Vec3> places_of(const std::vector<SkinBall>& balls, const SeamFrame& frame,
                            const std::vector<Affine3>& joints) {
  const Affine3 from_model = frame.from_model(joints);
  std::vector<Vec3> places;
  places.reserve(balls.size());
  for (const SkinBall& ball : balls)
    places.push_back(from_model * (joints[ball.joint.index()] * ball.center));
  return places;
}

}  // namespace

double scale_of(const Affine3& transform) {
  return std::cbrt(std::abs(transform.linear().determinant()));
}

std::optional<Meeting> meeting_at(const Graft& graft, const GraftSite& site) {
  if (!site.donor.is_valid() || !site.fused.is_valid()) return {};
  const JointId joint = graft.skeleton[site.fused].parent;
  if (!joint.is_valid()) return {};
  return Meeting{graft.origins[joint.index()], graft.origins[site.fused.index()]};
}

SeamFrame seam_frame(const Meeting& meeting, SourceId source, const Skeleton& skeleton) {
  if (source == meeting.above.source) return {meeting.above.joint, Affine3::Identity()};
  return {skeleton[meeting.below.joint].parent, Affine3(meeting.below.change.matrix())};
}

std::vector<SkinBall> skin_balls(const Character& input, std::span<const JointId> kept) {
  const auto vertices = vertices_by_joint(input);
  std::vector<SkinBall> balls;
  for (const JointId j : kept)
    if (vertices[j.index()].size() >= kFewVertices)
      add_balls(j, vertices[j.index()], 1 / scale_of(input.skeleton[j].joint_from_model), balls);
  return balls;
}

std::vector<SeamBalls> seam_balls(const Character& input, const Graft& graft, SourceId source,
                                  const MotionSet& set) {
  std::vector<SeamFrame> frames;
  std::vector<SeamBalls> seams;
  for (std::size_t s = 0; s < graft.sites.size(); ++s) {
    const std::optional<Meeting> meeting = meeting_at(graft, graft.sites[s]);
    if (!meeting || (meeting->above.source != source && meeting->below.source != source)) continue;
    frames.push_back(seam_frame(*meeting, source, input.skeleton));
    seams.push_back({s, {}, std::vector<float>(3 * set.balls.size() * set.poses.size())});
  }
  if (seams.empty()) return seams;
  const std::vector<Affine3> bind = model_from_joint(input.skeleton, bind_pose(input.skeleton));
  for (std::size_t s = 0; s < seams.size(); ++s) seams[s].bind = places_of(set.balls, frames[s], bind);
  for (std::size_t f = 0; f < set.poses.size(); ++f) {
    const std::vector<Affine3> joints = model_from_joint(input.skeleton, set.poses[f]);
    for (std::size_t s = 0; s < seams.size(); ++s) {
      float* place = seams[s].places.data() + f;
      for (const Vec3& p : places_of(set.balls, frames[s], joints))
        for (int axis = 0; axis < 3; ++axis, place += set.poses.size()) *place = static_cast<float>(p[axis]);
    }
  }
  return seams;
}

}  // namespace skinforge
