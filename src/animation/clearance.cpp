#include "animation/clearance.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "skeleton/pose.h"

namespace skinforge {
namespace {

constexpr double kInside = 0.8;          // ours: of the mean distance of skin from its axis
constexpr std::size_t kMostBalls = 4;    // ours: along one joint
constexpr std::size_t kFewVertices = 4;  // less are no limb
constexpr float kFarAway = 1e15F;        // its square is still a float

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

double scale_of(const Affine3& transform) {
  return std::cbrt(std::abs(transform.linear().determinant()));
}

void add_balls(JointId joint, const std::vector<Vec3>& points, double model_scale,
               std::vector<SkinBall>& balls) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : points) mean += p / static_cast<double>(points.size());
  Mat3 spread = Mat3::Zero();
  for (const Vec3& p : points) spread += (p - mean) * (p - mean).transpose();
  const Vec3 axis = Eigen::SelfAdjointEigenSolver<Mat3>(spread).eigenvectors().col(2);
  double low = 0, high = 0, thickness = 0;
  for (const Vec3& p : points) {
    const double along = axis.dot(p - mean);
    low = std::min(low, along);
    high = std::max(high, along);
    thickness += (p - mean - along * axis).norm() / static_cast<double>(points.size());
  }
  const double radius = kInside * thickness;
  if (radius <= 0) return;
  const auto count =
      static_cast<std::size_t>(std::clamp((high - low) / (2 * radius), 1.0, static_cast<double>(kMostBalls)));
  for (std::size_t k = 0; k < count; ++k) {
    const double share = (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    balls.push_back({joint, mean + (low + share * (high - low)) * axis, radius * model_scale});
  }
}

}  // namespace

std::vector<SkinBall> skin_balls(const Character& input, std::span<const JointId> kept) {
  const auto vertices = vertices_by_joint(input);
  std::vector<SkinBall> balls;
  for (const JointId j : kept)
    if (vertices[j.index()].size() >= kFewVertices)
      add_balls(j, vertices[j.index()], 1 / scale_of(input.skeleton[j].joint_from_model), balls);
  return balls;
}

std::vector<float> ball_centers(const Skeleton& skeleton, const MotionSet& set) {
  std::vector<float> centers;
  centers.reserve(3 * set.poses.size() * set.balls.size());
  for (const Pose& pose : set.poses) {
    const std::vector<Affine3> joints = model_from_joint(skeleton, pose);
    for (const SkinBall& ball : set.balls) {
      const Eigen::Vector3f center = (joints[ball.joint.index()] * ball.center).cast<float>();
      centers.insert(centers.end(), center.data(), center.data() + 3);
    }
  }
  return centers;
}

// One side of a seam: the balls of a source, and how they come into the frame of the joint it meets at.
struct Clearance::Side {
  const Character* input = nullptr;
  const MotionSet* set = nullptr;
  JointId anchor;  // of the input: balls are taken relative to it; invalid: to the model
  Affine3 from_anchor = Affine3::Identity();  // into the frame where both sides meet
  double scale = 1;                           // of radii

  Affine3 from_model(const Pose& pose) const {
    return anchor.is_valid()
               ? Affine3(from_anchor * model_from_joint(input->skeleton, pose, anchor).inverse())
               : from_anchor;
  }

  std::vector<Vec3> bind_places() const {
    const Pose pose = bind_pose(input->skeleton);
    const std::vector<Affine3> joints = model_from_joint(input->skeleton, pose);
    const Affine3 placed = from_model(pose);
    std::vector<Vec3> centers;
    for (const SkinBall& ball : set->balls)
      centers.push_back(placed * (joints[ball.joint.index()] * ball.center));
    return centers;
  }

  // One track per ball, one place per frame; those not asked for stay far from everything.
  std::vector<Track> tracks(std::size_t first, std::size_t count, const std::vector<bool>* allowed) const {
    std::vector<Track> tracks(set->balls.size());
    for (Track& track : tracks)
      track.places = Eigen::ArrayX3f::Constant(static_cast<Eigen::Index>(count), 3, kFarAway);
    for (std::size_t f = 0; f < count; ++f) {
      if (allowed && !(*allowed)[f]) continue;
      const Eigen::Affine3f placed = Eigen::Affine3d(from_model(set->poses[first + f])).cast<float>();
      const float* center = set->ball_centers.data() + 3 * (first + f) * tracks.size();
      for (std::size_t b = 0; b < tracks.size(); ++b, center += 3) {
        const Eigen::Vector3f place = placed * Eigen::Vector3f(center[0], center[1], center[2]);
        tracks[b].places.row(static_cast<Eigen::Index>(f)) = place.transpose().array();
        tracks[b].reach.extend(place);
      }
    }
    return tracks;
  }
};

// Pairs of balls that some row and some candidate might bring together: closer than in the bind pose by what
// they may overlap there.
Clearance::Seam Clearance::make_seam(const Side& driver, const Side& part, double unit, const Scope& scope) {
  Seam seam{driver.tracks(scope.first, scope.count, nullptr),
            part.tracks(0, scope.allowed.size(), &scope.allowed),
            {},
            static_cast<float>(unit)};
  const std::vector<Vec3> driver_bind = driver.bind_places(), part_bind = part.bind_places();
  for (std::size_t a = 0; a < driver_bind.size(); ++a)
    for (std::size_t b = 0; b < part_bind.size(); ++b) {
      const double sum = driver.scale * driver.set->balls[a].radius + part.scale * part.set->balls[b].radius;
      const auto touch = static_cast<float>(std::min(sum, (driver_bind[a] - part_bind[b]).norm()));
      if (seam.driver[a].reach.exteriorDistance(seam.part[b].reach) < touch)
        seam.pairs.push_back({a, b, touch});
    }
  return seam;
}

Clearance::Clearance(std::span<const Character* const> characters, const Graft& graft,
                     std::span<const MotionSet* const> motions, const DrivingClip& driver,
                     const PartToComplete& part, const Scope& scope)
    : candidates_(static_cast<Eigen::Index>(scope.allowed.size())) {
  const auto is_in = [](const std::vector<SourceId>& sources, SourceId s) {
    return std::find(sources.begin(), sources.end(), s) != sources.end();
  };
  const GraftSource& base = graft.sources.front();
  const double diagonal = base.model_from_input.scale * characters[base.input]->mesh.diagonal();
  for (const GraftSite& site : graft.sites) {
    if (!site.donor.is_valid() || !site.fused.is_valid() || diagonal <= 0) continue;
    const JointId meeting = graft.skeleton[site.fused].parent;
    if (!meeting.is_valid()) continue;
    const JointOrigin &above = graft.origins[meeting.index()], &top = graft.origins[site.fused.index()];
    const bool drives_above = is_in(driver.sources, above.source) && is_in(part.sources, site.donor);
    const bool drives_below = is_in(driver.sources, site.donor) && is_in(part.sources, above.source);
    if (!drives_above && !drives_below) continue;
    const GraftSource &host_source = graft.sources[above.source.index()],
                      &donor_source = graft.sources[site.donor.index()];
    const Character &host = *characters[host_source.input], &donor = *characters[donor_source.input];
    const double scale_above =
        1 / scale_of(host.skeleton[above.joint].joint_from_model);  // of the meeting joint
    const double host_scale = host_source.model_from_input.scale;
    const Side upper{&host, motions[above.source.index()], above.joint, Affine3::Identity(), 1 / scale_above};
    const Side lower{&donor, motions[site.donor.index()], donor.skeleton[top.joint].parent,
                     Affine3(top.change.matrix()),
                     donor_source.model_from_input.scale / (host_scale * scale_above)};
    const double unit = host_scale * scale_above / diagonal;
    seams_.push_back(drives_above ? make_seam(upper, lower, unit, scope)
                                  : make_seam(lower, upper, unit, scope));
  }
}

double Clearance::depth(std::size_t row, std::size_t candidate) const {
  const auto r = static_cast<Eigen::Index>(row), c = static_cast<Eigen::Index>(candidate);
  float deepest = 0;
  for (const Seam& seam : seams_)
    for (const Pair& pair : seam.pairs) {
      const float distance2 = (seam.driver[pair.driver].places.row(r) - seam.part[pair.part].places.row(c))
                                  .matrix()
                                  .squaredNorm();
      if (distance2 < pair.touch * pair.touch)
        deepest = std::max(deepest, seam.unit * (pair.touch - std::sqrt(distance2)));
    }
  return static_cast<double>(deepest);
}

Eigen::ArrayXf Clearance::depths(std::size_t row) const {
  Eigen::ArrayXf deepest = Eigen::ArrayXf::Zero(candidates_);
  for (const Seam& seam : seams_)
    for (const Pair& pair : seam.pairs) {
      const Eigen::Vector3f ball = seam.driver[pair.driver].places.row(static_cast<Eigen::Index>(row));
      const Track& track = seam.part[pair.part];
      if (track.reach.exteriorDistance(ball) >= pair.touch) continue;
      const auto& p = track.places;
      deepest = deepest.max(seam.unit *
                            (pair.touch - ((p.col(0) - ball.x()).square() + (p.col(1) - ball.y()).square() +
                                           (p.col(2) - ball.z()).square())
                                              .sqrt()));
    }
  return deepest;
}

}  // namespace skinforge
