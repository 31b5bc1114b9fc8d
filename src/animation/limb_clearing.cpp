#include "animation/limb_clearing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "animation/limb_problem.h"
#include "animation/skin_balls.h"
#include "skeleton/rotations.h"

namespace skinforge {
namespace {

constexpr double kMayCut = 0.005;       // ours: of the diagonal; balls are rough
constexpr double kThickness = 1.25;     // ours: of balls, which have 0.8 of the mean thickness
constexpr double kHelps = 0.5;          // ours: of the sum of squared depths
constexpr std::size_t kMostPoses = 90;  // ours: a clip is looked at in so many rows
constexpr double kLong = 3;             // ours: times the radius of its thickest ball
constexpr double kOuter = 0.25;      // ours: of a limb's reach; what is nearer to its root cannot turn away
constexpr double kStands = 0.2;      // ours: of the input's height; what reaches down there stands or walks
constexpr double kLeastTurn = 1e-3;  // radians
constexpr double kLimb = 0.15;       // ours: of the area of all balls of a seam; more is a body
constexpr double kOfItsPart = 0.4;   // ours: of the area of its own side, where that is a body

double square(double x) {
  return x * x;
}

// As much as tells a limb from a body: the sum of squared radii.
double area_of_balls(const SeamSide& side) {
  double area = 0;
  for (const SkinBall& ball : side.set->balls) area += square(side.scale * ball.radius);
  return area;
}

// Where one ball is in the poses that are looked at, in the frame of its seam.
struct PosedBall {
  std::vector<Eigen::Vector3f> places;
  Eigen::AlignedBox3f reach;
};

std::vector<PosedBall> posed_balls(const SeamSide& side, const std::vector<std::size_t>& frames) {
  std::vector<PosedBall> balls;
  for (const BallTrack& track : side.tracks(0, side.set->poses.size())) {
    PosedBall& ball = balls.emplace_back();
    for (const std::size_t f : frames) {
      ball.places.push_back(track.at(f));
      ball.reach.extend(ball.places.back());
    }
  }
  return balls;
}

// One side of a seam whose limbs may turn.
class LimbedPart {
 public:
  LimbedPart(const Seam& seam, const Character& input, const Graft& graft, const ShownFrames& frames)
      : seam_(seam), input_(input), graft_(graft), meeting_(*meeting_at(graft, graft.sites[seam.site])) {
    const std::size_t step = (frames.shown.size() + kMostPoses - 1) / kMostPoses;
    for (std::size_t row = 0; row < frames.shown.size(); row += step) {
      driver_frames_.push_back(frames.first + row);
      part_frames_.push_back(frames.shown[row]);
    }
    driver_ = posed_balls(seam.driver, driver_frames_);
    part_ = posed_balls(seam.part, part_frames_);
    own_area_ = area_of_balls(seam.part);
    area_ = own_area_ + area_of_balls(seam.driver);
  }

  std::vector<LimbTurn> turns(double most) const;

 private:
  double area_of(const std::vector<bool>& carried) const;
  std::vector<double> depths() const;
  std::vector<bool> carried_by(JointId joint) const;
  std::vector<bool> outer_of(JointId pivot, const std::vector<bool>& carried) const;
  Vec3 bind_place(std::size_t ball) const;
  bool is_long(JointId pivot, const std::vector<bool>& carried) const;
  bool reaches_ground(const std::vector<bool>& carried) const;
  std::optional<JointId> pivot_of(std::size_t ball) const;
  bool may_turn(JointId joint, const std::vector<bool>& carried) const;
  std::vector<LimbPair> pairs_of(JointId pivot, double most) const;
  Affine3 parent_from_seam(std::size_t pose, JointId pivot) const;

  const Seam& seam_;
  const Character& input_;
  const Graft& graft_;
  Meeting meeting_;
  std::vector<std::size_t> driver_frames_, part_frames_;  // per pose that is looked at
  std::vector<PosedBall> driver_, part_;
  double area_ = 0, own_area_ = 0;  // of the balls of both sides and of the part, in the seam's frame
};

double LimbedPart::area_of(const std::vector<bool>& carried) const {
  double area = 0;
  for (std::size_t b = 0; b < carried.size(); ++b)
    if (carried[b]) area += square(seam_.part.scale * seam_.part.set->balls[b].radius);
  return area;
}

// Of each ball of the part, at its deepest, of the base's diagonal.
std::vector<double> LimbedPart::depths() const {
  std::vector<double> depths(part_.size(), 0.0);
  for (std::size_t a = 0; a < driver_.size(); ++a)
    for (std::size_t b = 0; b < part_.size(); ++b) {
      const auto reach = static_cast<double>(driver_[a].reach.exteriorDistance(part_[b].reach));
      if (reach >= seam_.radii(a, b)) continue;  // most
      const double touching = seam_.touching(a, b);
      for (std::size_t p = 0; reach < touching && p < part_frames_.size(); ++p) {
        const Eigen::Vector3f apart = driver_[a].places[p] - part_[b].places[p];
        depths[b] = std::max(depths[b], seam_.unit * (touching - static_cast<double>(apart.norm())));
      }
    }
  return depths;
}

// Per ball of the part.
std::vector<bool> LimbedPart::carried_by(JointId joint) const {
  const std::vector<bool> below = input_.skeleton.subtree(joint);
  std::vector<bool> carried;
  for (const SkinBall& ball : seam_.part.set->balls) carried.push_back(below[ball.joint.index()]);
  return carried;
}

Vec3 LimbedPart::bind_place(std::size_t ball) const {
  const SkinBall& skin = seam_.part.set->balls[ball];
  return input_.skeleton[skin.joint].joint_from_model.inverse() * skin.center;
}

// Not a head, which turned aside would look somewhere else.
bool LimbedPart::is_long(JointId pivot, const std::vector<bool>& carried) const {
  const Affine3& joint_from_model = input_.skeleton[pivot].joint_from_model;
  double reach = 0, thickest = 0;
  for (std::size_t b = 0; b < carried.size(); ++b) {
    if (!carried[b]) continue;
    reach = std::max(reach, (joint_from_model * bind_place(b)).norm() / scale_of(joint_from_model));
    thickest = std::max(thickest, seam_.part.set->balls[b].radius);
  }
  return reach > kLong * thickest;
}

// Hooves may be on joints of their own, so the leg itself is asked.
bool LimbedPart::reaches_ground(const std::vector<bool>& carried) const {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& p : input_.mesh.positions) {
    low = std::min(low, p.y());
    high = std::max(high, p.y());
  }
  for (std::size_t b = 0; b < carried.size(); ++b)
    if (carried[b] && bind_place(b).y() < low + kStands * (high - low)) return true;
  return false;
}

// Of the balls that a pivot carries those that are far enough from it.
std::vector<bool> LimbedPart::outer_of(JointId pivot, const std::vector<bool>& carried) const {
  std::vector<double> levers;
  for (std::size_t b = 0; b < carried.size(); ++b)
    levers.push_back(carried[b] ? (input_.skeleton[pivot].joint_from_model * bind_place(b)).norm() : 0);
  const double reach = *std::max_element(levers.begin(), levers.end());
  std::vector<bool> outer;
  for (std::size_t b = 0; b < carried.size(); ++b) outer.push_back(carried[b] && levers[b] >= kOuter * reach);
  return outer;
}

// A limb: nothing that carries half a body, a leg or another source, nor a joint whose place in the result is
// not its own.
bool LimbedPart::may_turn(JointId joint, const std::vector<bool>& carried) const {
  const SourceId source = seam_.part.source;
  const JointId result = graft_.sources[source.index()].result_joint[joint.index()];
  if (!result.is_valid() || !graft_.skeleton[result].parent.is_valid()) return false;
  const bool is_top = source == meeting_.below.source && joint == meeting_.below.joint;
  if (!is_top && !graft_.origins[result.index()].change.is_identity()) return false;
  const double area = area_of(carried);
  if (area > kLimb * area_ || (own_area_ > kLimb * area_ && area > kOfItsPart * own_area_)) return false;
  if (!is_long(joint, carried) || reaches_ground(carried)) return false;
  const std::vector<bool> below = input_.skeleton.subtree(joint);
  return std::none_of(graft_.sites.begin(), graft_.sites.end(), [&](const GraftSite& site) {
    const std::optional<Meeting> meeting = meeting_at(graft_, site);
    return meeting && meeting->above.source == source && below[meeting->above.joint.index()];
  });
}

// The joint above a ball that moves it best: much moved in the clips, a long lever, little else on it.
std::optional<JointId> LimbedPart::pivot_of(std::size_t ball) const {
  const MotionSet& set = *seam_.part.set;
  const Vec3 place = bind_place(ball);
  std::optional<JointId> best;
  double most = 0;
  for (JointId joint = set.balls[ball].joint; joint.is_valid(); joint = input_.skeleton[joint].parent) {
    const std::vector<bool> carried = carried_by(joint);
    if (!may_turn(joint, carried) || !outer_of(joint, carried)[ball]) continue;
    const double lever2 = (input_.skeleton[joint].joint_from_model * place).squaredNorm();
    const double range = 2 * std::acos(std::min(1.0, set.ranges[joint.index()].turn));
    const double gain = range * lever2 / area_of(carried);
    if (gain > most) most = gain, best = joint;
  }
  return best;
}

// From the frame of the seam to that of a joint's parent, but from the joint on, and without scale.
Affine3 LimbedPart::parent_from_seam(std::size_t pose, JointId pivot) const {
  const Skeleton& skeleton = input_.skeleton;
  const std::vector<Affine3> joints = model_from_joint(skeleton, seam_.part.set->poses[part_frames_[pose]]);
  const Affine3 from_model = seam_frame(meeting_, seam_.part.source, skeleton).from_model(joints);
  // The parent of a topmost joint is, in the result, the joint whose frame the seam has.
  const bool is_top = seam_.part.source == meeting_.below.source && pivot == meeting_.below.joint;
  Affine3 result = Affine3::Identity();
  if (!is_top)
    result.linear() =
        nearest_rotation((from_model * joints[skeleton[pivot].parent.index()]).linear()).transpose();
  return result * Eigen::Translation3d(-(from_model * joints[pivot.index()].translation()));
}

std::vector<LimbPair> LimbedPart::pairs_of(JointId pivot, double most) const {
  const std::vector<bool> outer = outer_of(pivot, carried_by(pivot));
  std::vector<LimbPair> pairs;
  for (std::size_t p = 0; p < part_frames_.size(); ++p) {
    const Affine3 from_seam = parent_from_seam(p, pivot);
    std::vector<Vec3> obstacles;
    for (const PosedBall& ball : driver_) obstacles.push_back(from_seam * ball.places[p].cast<double>());
    for (std::size_t b = 0; b < outer.size(); ++b) {
      if (!outer[b]) continue;
      const Vec3 ball = from_seam * part_[b].places[p].cast<double>();
      for (std::size_t a = 0; a < obstacles.size(); ++a) {
        LimbPair pair{ball, obstacles[a], kThickness * seam_.radii(a, b)};
        if (!may_meet(pair, most)) continue;  // most
        pair.touching = seam_.touching(a, b, kThickness);
        if (may_meet(pair, most)) pairs.push_back(pair);
      }
    }
  }
  return pairs;
}

std::vector<LimbTurn> LimbedPart::turns(double most) const {
  std::vector<LimbTurn> turns;
  std::vector<double> depth = depths();
  for (;;) {
    const auto deepest = std::max_element(depth.begin(), depth.end());
    if (deepest == depth.end() || *deepest <= kMayCut) return turns;
    const std::optional<JointId> pivot = pivot_of(static_cast<std::size_t>(deepest - depth.begin()));
    *deepest = 0;
    if (!pivot) continue;
    const std::vector<bool> carried = carried_by(*pivot);
    for (std::size_t b = 0; b < depth.size(); ++b)
      if (carried[b]) depth[b] = 0;
    const std::vector<LimbPair> pairs = pairs_of(*pivot, most);
    const Quat turn = clearing_turn(pairs, most);
    if (turn.angularDistance(Quat::Identity()) < kLeastTurn) continue;
    const double before = cut_of(pairs, Quat::Identity()).squares, after = cut_of(pairs, turn).squares;
    if (after <= kHelps * before) turns.push_back({seam_.part.source, *pivot, turn});
  }
}

}  // namespace

std::vector<LimbTurn> clear_limbs(std::span<const Character* const> characters, const Graft& graft,
                                  std::span<const Seam> seams, const ShownFrames& frames, double most) {
  std::vector<LimbTurn> turns;
  if (!(most > 0)) return turns;
  for (const Seam& seam : seams) {
    const Character& input = *characters[graft.sources[seam.part.source.index()].input];
    for (const LimbTurn& turn : LimbedPart(seam, input, graft, frames).turns(most)) {
      const bool is_turned = std::any_of(turns.begin(), turns.end(), [&](const LimbTurn& other) {
        return other.source == turn.source && other.joint == turn.joint;
      });
      if (!is_turned) turns.push_back(turn);
    }
  }
  return turns;
}

}  // namespace skinforge
