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

Affine3 Clearance::Side::from_model(const Pose& pose) const {
  return anchor.is_valid() ? Affine3(from_anchor * model_from_joint(input->skeleton, pose, anchor).inverse())
                           : from_anchor;
}

std::vector<Vec3> Clearance::Side::bind_places() const {
  const Pose pose = bind_pose(input->skeleton);
  const std::vector<Affine3> joints = model_from_joint(input->skeleton, pose);
  const Affine3 placed = from_model(pose);
  std::vector<Vec3> centers;
  for (const SkinBall& ball : set->balls)
    centers.push_back(placed * (joints[ball.joint.index()] * ball.center));
  return centers;
}

const std::vector<Vec3>& Clearance::Side::at(std::size_t frame) {
  if (places.empty()) places.resize(set->poses.size());
  std::vector<Vec3>& here = places[frame];
  const std::size_t count = set->balls.size();
  if (here.size() == count) return here;
  const Affine3 placed = from_model(set->poses[frame]);
  here.reserve(count);
  for (std::size_t b = 0; b < count; ++b) {
    const float* center = set->ball_centers.data() + 3 * (frame * count + b);
    here.push_back(placed * Vec3(center[0], center[1], center[2]));
  }
  return here;
}

Clearance::Clearance(std::span<const Character* const> characters, const Graft& graft,
                     std::span<const MotionSet* const> motions, const DrivingClip& driver,
                     const PartToComplete& part) {
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
    const auto side = [&](SourceId source, JointId anchor, const Affine3& from_anchor, double scale) {
      const Character* input = characters[graft.sources[source.index()].input];
      Side made{input, motions[source.index()], anchor, from_anchor, scale, {}, {}};
      made.bind = made.bind_places();
      return made;
    };
    const Character& host = *characters[graft.sources[above.source.index()].input];
    const Character& donor = *characters[graft.sources[site.donor.index()].input];
    const double scale_above =
        1 / scale_of(host.skeleton[above.joint].joint_from_model);  // of the meeting joint
    const double host_scale = graft.sources[above.source.index()].model_from_input.scale;
    const double donor_scale = graft.sources[site.donor.index()].model_from_input.scale;
    Side upper = side(above.source, above.joint, Affine3::Identity(), 1 / scale_above);
    Side lower = side(site.donor, donor.skeleton[top.joint].parent, Affine3(top.change.matrix()),
                      donor_scale / (host_scale * scale_above));
    Seam seam{std::move(drives_above ? upper : lower),
              std::move(drives_above ? lower : upper),
              host_scale * scale_above / diagonal,
              {},
              {}};
    seam.pairs = all_pairs(seam);
    seams_.push_back(std::move(seam));
  }
}

// Pairs of balls, closer than in the bind pose by what they may overlap there.
std::vector<Clearance::Pair> Clearance::all_pairs(const Seam& seam) {
  std::vector<Pair> pairs;
  for (std::size_t a = 0; a < seam.driver.bind.size(); ++a)
    for (std::size_t b = 0; b < seam.part.bind.size(); ++b) {
      const double sum = seam.driver.scale * seam.driver.set->balls[a].radius +
                         seam.part.scale * seam.part.set->balls[b].radius;
      pairs.push_back({a, b, std::min(sum, (seam.driver.bind[a] - seam.part.bind[b]).norm())});
    }
  return pairs;
}

double Clearance::depth(std::size_t driver_frame, std::size_t candidate) {
  double deepest = 0;
  for (Seam& seam : seams_) {
    const auto &driver = seam.driver.at(driver_frame), &part = seam.part.at(candidate);
    for (const Pair& pair : seam.pairs) {
      const double distance2 = (driver[pair.driver] - part[pair.part]).squaredNorm();
      if (distance2 < pair.touch * pair.touch)
        deepest = std::max(deepest, seam.unit * (pair.touch - std::sqrt(distance2)));
    }
  }
  return deepest;
}

std::vector<Eigen::AlignedBox3d> Clearance::reach_of(Side& part, const std::vector<bool>& allowed) {
  std::vector<Eigen::AlignedBox3d> reach(part.bind.size());
  for (std::size_t c = 0; c < allowed.size(); ++c) {
    if (!allowed[c]) continue;
    const auto& places = part.at(c);
    for (std::size_t b = 0; b < places.size(); ++b) reach[b].extend(places[b]);
  }
  return reach;
}

std::vector<double> Clearance::depths(std::size_t driver_frame, const std::vector<bool>& allowed) {
  std::vector<double> deepest(allowed.size(), 0.0);
  for (Seam& seam : seams_) {
    if (seam.reach.empty()) seam.reach = reach_of(seam.part, allowed);
    const auto& driver = seam.driver.at(driver_frame);
    for (const Pair& pair : seam.pairs) {
      const Vec3& ball = driver[pair.driver];
      if (seam.reach[pair.part].isEmpty() || seam.reach[pair.part].exteriorDistance(ball) >= pair.touch)
        continue;
      for (std::size_t c = 0; c < allowed.size(); ++c) {
        if (!allowed[c]) continue;
        const double distance2 = (ball - seam.part.places[c][pair.part]).squaredNorm();
        if (distance2 < pair.touch * pair.touch)
          deepest[c] = std::max(deepest[c], seam.unit * (pair.touch - std::sqrt(distance2)));
      }
    }
  }
  return deepest;
}

}  // namespace skinforge
