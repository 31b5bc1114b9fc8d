#include "io/fbx_animation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "base/error.h"
#include "base/limits.h"
#include "base/text.h"
#include "io/fbx_curve.h"

namespace skinforge {
namespace {

constexpr double kBakedFrames = 1.5;  // keys no farther apart hold the motion by themselves
constexpr double kSamePose = 1e-3;    // relative: our transform of a node against Assimp's float matrix
constexpr double kSlopeStep = 1e-4;   // of a piece; slopes by differences of second order
constexpr double kSameMotion = 1e-3;  // relative, radians: what a pose may miss of its file
constexpr double kJump = 1e-6;  // relative, radians: a curve that ends a piece elsewhere than the next begins
constexpr double kBeforeJump = 1e-3;        // seconds; apart even as floats
constexpr std::size_t kNumbersPerKey = 33;  // three tracks with times, values and their slopes

/// Three curves of one property; a missing one holds its default.
struct Channel {
  std::array<const FbxCurve*, 3> curves{};
  Vec3 defaults = Vec3::Zero();

  bool is_driven() const {
    return std::any_of(curves.begin(), curves.end(), [](const auto& c) { return c && !c->times().empty(); });
  }
  Vec3 at(double time, bool from_left) const {
    Vec3 value = defaults;
    for (int axis = 0; axis < 3; ++axis)
      if (const auto& curve = curves[static_cast<std::size_t>(axis)]; curve && !curve->times().empty())
        value[axis] = curve->at(time, from_left);
    return value;
  }
  bool is_constant() const {
    return std::all_of(curves.begin(), curves.end(), [](const auto& c) { return !c || c->is_constant(); });
  }
};

/// What one stack does to one node: translation, rotation in degrees, scale.
using Motion = std::array<Channel, 3>;

/// The keys of all three curves.
std::vector<double> key_times(const Channel& channel) {
  std::vector<double> times;
  for (const auto& curve : channel.curves) {
    if (!curve || times == curve->times()) continue;  // the common case: baked together
    times.insert(times.end(), curve->times().begin(), curve->times().end());
    std::sort(times.begin(), times.end());
  }
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

Transform local_at(const Motion& motion, const FbxTransform& transform, double time, bool from_left) {
  return transform.local(motion[0].at(time, from_left), motion[1].at(time, from_left),
                         motion[2].at(time, from_left));
}

/// Relative to their lengths, and in radians.
double distance(const Transform& a, const Transform& b) {
  const double reach = std::max(a.translation.norm(), b.translation.norm());
  const double size = std::max(a.scale.norm(), b.scale.norm());
  double worst = a.rotation.angularDistance(b.rotation);
  if (reach > 0) worst = std::max(worst, (a.translation - b.translation).norm() / reach);
  if (size > 0) worst = std::max(worst, (a.scale - b.scale).norm() / size);
  return worst;
}

Transform mix(const Transform& a, const Transform& b, double t) {
  return {a.translation + t * (b.translation - a.translation), a.rotation.slerp(t, b.rotation),
          a.scale + t * (b.scale - a.scale)};
}

/// Whether Assimp's keys, joined by lines and slerps, miss the motion between two keys.
bool is_lost_between(const Motion& motion, const FbxTransform& transform, double begin, double end) {
  const Transform a = local_at(motion, transform, begin, false), b = local_at(motion, transform, end, false);
  for (const double t : {0.25, 0.5, 0.75}) {
    const Transform truth = local_at(motion, transform, begin + t * (end - begin), false);
    if (distance(mix(a, b, t), truth) > kSameMotion) return true;
  }
  return false;
}

/// Whether Assimp's keys miss the motion of a node.
bool is_lost(const Motion& motion, const FbxTransform& transform, double frame) {
  if (transform.has_pivots())  // the translation follows the rotation, and has no keys of its own
    return std::any_of(motion.begin(), motion.end(), [](const Channel& c) { return !c.is_constant(); });
  for (const Channel& channel : motion) {
    if (channel.is_constant()) continue;
    const std::vector<double> times = key_times(channel);
    for (std::size_t k = 0; k + 1 < times.size(); ++k)
      if (times[k + 1] - times[k] > kBakedFrames * frame &&
          is_lost_between(motion, transform, times[k], times[k + 1]))
        return true;
  }
  return false;
}

/// The keys of all curves, and between them as many as there are frames; none where that are more than
/// `most`.
std::vector<double> sample_times(const Motion& motion, double frame, std::size_t most) {
  std::set<double> keys;
  for (const Channel& channel : motion) {
    const std::vector<double> times = key_times(channel);
    keys.insert(times.begin(), times.end());
  }
  std::vector<double> times;
  for (const double key : keys) {
    if (!times.empty()) {
      const double last = times.back(), gap = key - last;
      const double pieces = std::ceil(gap / frame - 1e-6);
      if (pieces + static_cast<double>(times.size()) > static_cast<double>(most)) return {};
      for (double i = 1; i < pieces; ++i) times.push_back(last + gap * i / pieces);
    }
    times.push_back(key);
  }
  if (times.size() > most) return {};
  return times;
}

/// Samples a motion into three cubic splines (glTF 2.0, appendix C).
class Sampler {
 public:
  Sampler(const Motion& motion, const FbxTransform& transform) : motion_(motion), transform_(transform) {}

  RawScene::NodeTracks sample(const std::vector<double>& times, double shift) {
    shift_ = shift;
    for (auto* interpolation :
         {&tracks_.translation.interpolation, &tracks_.rotation.interpolation, &tracks_.scale.interpolation})
      *interpolation = Interpolation::CubicSpline;
    for (std::size_t k = 0; k < times.size(); ++k) {
      const double before = k > 0 ? times[k] - times[k - 1] : 0;
      const double behind = k + 1 < times.size() ? times[k + 1] - times[k] : 0;
      const Transform left = local(times[k], true), right = local(times[k], false);
      if (before > 0 && distance(left, right) > kJump) {
        const double early = times[k] - std::min(kBeforeJump, before / 4);
        add_key(early, left, slope(early, local(early, true), -before), zero_slope());
        add_key(times[k], right, zero_slope(), slope(times[k], right, behind));
      } else {
        add_key(times[k], right, slope(times[k], left, -before), slope(times[k], right, behind));
      }
    }
    return std::move(tracks_);
  }

 private:
  struct Slope {
    Vec3 translation = Vec3::Zero();
    Eigen::Vector4d rotation = Eigen::Vector4d::Zero();
    Vec3 scale = Vec3::Zero();
  };
  static Slope zero_slope() { return {}; }

  Transform local(double time, bool from_left) const {
    return local_at(motion_, transform_, time, from_left);
  }

  /// Derivative towards a piece of signed length `reach`, from its side alone; `a`: the transform there.
  Slope slope(double time, const Transform& a, double reach) const {
    if (reach == 0) return {};
    const bool from_left = reach < 0;
    const double h = reach * kSlopeStep;
    const Transform b = local(time + h, from_left), c = local(time + 2 * h, from_left);
    const auto derive = [&](const auto& x, const auto& y, const auto& z) {
      return ((4 * y - z - 3 * x) / (2 * h)).eval();
    };
    const auto near = [&](const Quat& q) {
      return Eigen::Vector4d(q.dot(a.rotation) < 0 ? -q.coeffs() : q.coeffs());
    };
    return {derive(a.translation, b.translation, c.translation),
            derive(near(a.rotation), near(b.rotation), near(c.rotation)), derive(a.scale, b.scale, c.scale)};
  }

  void add_key(double time, const Transform& value, const Slope& in, const Slope& out) {
    const Quat last = tracks_.rotation.values.empty() ? value.rotation : tracks_.rotation.values.end()[-2];
    const double sign = last.dot(value.rotation) < 0 ? -1 : 1;
    for (auto* times : {&tracks_.translation.times, &tracks_.rotation.times, &tracks_.scale.times})
      times->push_back(time + shift_);
    tracks_.translation.values.insert(tracks_.translation.values.end(),
                                      {in.translation, value.translation, out.translation});
    tracks_.scale.values.insert(tracks_.scale.values.end(), {in.scale, value.scale, out.scale});
    for (const Eigen::Vector4d& q : {in.rotation, Eigen::Vector4d(value.rotation.coeffs()), out.rotation})
      tracks_.rotation.values.emplace_back(Eigen::Vector4d(sign * q));
  }

  const Motion& motion_;
  const FbxTransform& transform_;
  double shift_ = 0;
  RawScene::NodeTracks tracks_;
};

class Restorer {
 public:
  Restorer(const FbxScene& fbx, RawScene& scene) : fbx_(fbx), scene_(scene), frame_(1 / fbx.frame_rate()) {
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) nodes_[scene.nodes[n].name].push_back(n);
    for (std::size_t a = 0; a < scene.animations.size(); ++a)
      animations_[scene.animations[a].name].push_back(a);
    for (const std::int64_t id : fbx.all("Model")) models_[fbx.name(id)].push_back(id);
  }

  void run() {
    std::map<std::string, std::size_t> seen;
    for (const std::int64_t stack : fbx_.all("AnimationStack")) {
      const std::string name = fbx_.name(stack);
      RawScene::Animation* animation = find(name, seen[name]++);
      if (!animation) continue;
      tracks_.clear();
      for (RawScene::NodeTracks& tracks : animation->nodes) tracks_.try_emplace(tracks.node, &tracks);
      for (const auto& [model, motion] : motions_of(stack, name)) restore(model, motion, name);
    }
    if (restored_ > 0)
      scene_.issues.push_back(
          {"curves-sampled", Severity::Note, "scene",
           fmt::format("{} node animations with far keys are sampled at {:.5g} Hz as splines", restored_,
                       1 / frame_)});
  }

 private:
  /// What an AnimationCurveNode brings, whatever it drives.
  struct CurveNode {
    std::array<const FbxCurve*, 3> curves{};
    std::array<std::optional<double>, 3> defaults;
  };

  RawScene::Animation* find(const std::string& name, std::size_t number) {
    const auto found = animations_.find(name);
    const bool is_there = found != animations_.end() && number < found->second.size();
    return is_there ? &scene_.animations[found->second[number]] : nullptr;
  }

  std::map<std::int64_t, Motion> motions_of(std::int64_t stack, const std::string& name) {
    std::vector<std::int64_t> layers;
    for (const FbxScene::Link& layer : fbx_.sources(stack))
      if (drives(layer.object)) layers.push_back(layer.object);
    std::map<std::int64_t, Motion> motions;
    if (layers.size() == 1) add_layer(layers.front(), motions);
    if (layers.size() > 1)
      scene_.issues.push_back({"layers-as-keys", Severity::Warning, "clip " + printable(name),
                               fmt::format("{} animation layers; only their keys are read", layers.size())});
    return motions;
  }

  /// The models that a source of a layer drives, and which of their properties.
  std::vector<std::pair<std::int64_t, std::size_t>> driven_by(std::int64_t curve_node) const {
    std::vector<std::pair<std::int64_t, std::size_t>> driven;
    const FbxNode* node = fbx_.object(curve_node);
    if (!node || node->name != "AnimationCurveNode") return driven;
    for (const FbxScene::Link& target : fbx_.targets(curve_node)) {
      const FbxNode* model = fbx_.object(target.object);
      const auto slot = slot_of(target.property);
      if (model && model->name == "Model" && slot) driven.emplace_back(target.object, *slot);
    }
    return driven;
  }

  bool drives(std::int64_t layer) {
    const auto [known, is_new] = drives_.try_emplace(layer, false);
    for (std::size_t i = 0; is_new && i < fbx_.sources(layer).size(); ++i) {
      const std::int64_t source = fbx_.sources(layer)[i].object;
      if (driven_by(source).empty()) continue;
      curve_node(source);  // refused when it is damaged, though layers beside it are not summed
      known->second = true;
    }
    return known->second;
  }

  void add_layer(std::int64_t layer, std::map<std::int64_t, Motion>& motions) {
    for (const FbxScene::Link& link : fbx_.sources(layer))
      for (const auto& [model, slot] : driven_by(link.object)) {
        const auto [motion, is_new] = motions.try_emplace(model);
        if (is_new) set_defaults(model, motion->second);
        fill(curve_node(link.object), motion->second[slot]);
      }
  }

  static std::optional<std::size_t> slot_of(const std::string& property) {
    constexpr std::array<std::string_view, 3> kProperties = {"Lcl Translation", "Lcl Rotation",
                                                             "Lcl Scaling"};
    const auto found = std::find(kProperties.begin(), kProperties.end(), property);
    if (found == kProperties.end()) return std::nullopt;
    return static_cast<std::size_t>(found - kProperties.begin());
  }

  const FbxTransform& transform_of(std::int64_t model) {
    const auto known = transforms_.find(model);
    return known != transforms_.end() ? known->second
                                      : transforms_.emplace(model, *fbx_.object(model)).first->second;
  }

  void set_defaults(std::int64_t model, Motion& motion) {
    const FbxTransform& transform = transform_of(model);
    motion[0].defaults = transform.translation;
    motion[1].defaults = transform.rotation_deg;
    motion[2].defaults = transform.scale;
  }

  static void fill(const CurveNode& node, Channel& channel) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (node.defaults[axis]) channel.defaults[static_cast<int>(axis)] = *node.defaults[axis];
      if (node.curves[axis]) channel.curves[axis] = node.curves[axis];
    }
  }

  const CurveNode& curve_node(std::int64_t id) {
    constexpr std::array<const char*, 3> kAxes = {"d|X", "d|Y", "d|Z"};
    const auto [known, is_new] = curve_nodes_.try_emplace(id);
    CurveNode& node = known->second;
    for (std::size_t axis = 0; is_new && axis < 3; ++axis) {
      node.defaults[axis] = fbx_number(*fbx_.object(id), kAxes[axis]);
      for (const FbxScene::Link& source : fbx_.sources(id))
        if (source.property == kAxes[axis])
          if (const FbxCurve* found = curve(source.object)) node.curves[axis] = found;
    }
    return node;
  }

  /// Null where there is no curve of that id.
  const FbxCurve* curve(std::int64_t id) {
    const FbxNode* node = fbx_.object(id);
    if (!node || node->name != "AnimationCurve") return nullptr;
    const auto known = curves_.find(id);
    if (known != curves_.end()) return &known->second;
    const FbxCurve& read = curves_.emplace(id, *node).first->second;
    check_length(read);
    return &read;
  }

  /// The parent would refuse the frames of a day and more, but only after they were made.
  static void check_length(const FbxCurve& curve) {
    if (curve.times().empty()) return;
    const double seconds = curve.times().back() - curve.times().front();
    if (seconds > static_cast<double>(limits().clip))
      throw Error(ExitCode::BadInput, fmt::format("FBX: a curve of {} s, {}", seconds, limit_hint("clip")));
  }

  void restore(std::int64_t model, const Motion& motion, const std::string& clip) {
    const FbxTransform& transform = transform_of(model);
    if (!is_lost(motion, transform, frame_)) return;
    const std::string name = fbx_.name(model);
    const std::optional<std::size_t> node = node_of(name, transform);
    const auto tracks = node ? tracks_.find(static_cast<std::int32_t>(*node)) : tracks_.end();
    std::string why;
    if (tracks != tracks_.end()) {
      const std::vector<double> times =
          sample_times(motion, frame_, limits().keys / kNumbersPerKey - sampled_);
      if (!times.empty()) return replace(*tracks->second, motion, transform, times);
      why = ", as keys for all frames were too many: " + limit_hint("keys");
    }
    scene_.issues.push_back(
        {"curves-as-keys", Severity::Warning, "clip " + printable(clip),
         fmt::format("only the keys of node \"{}\" are read, not the curves between them{}", printable(name),
                     why)});
  }

  void replace(RawScene::NodeTracks& tracks, const Motion& motion, const FbxTransform& transform,
               const std::vector<double>& times) {
    RawScene::NodeTracks sampled = Sampler(motion, transform).sample(times, shift(tracks, times.front()));
    const bool whole = transform.has_pivots();
    if (whole || motion[0].is_driven()) tracks.translation = std::move(sampled.translation);
    if (whole || motion[1].is_driven()) tracks.rotation = std::move(sampled.rotation);
    if (whole || motion[2].is_driven()) tracks.scale = std::move(sampled.scale);
    ++restored_;
    sampled_ += times.size();
  }

  /// The one node of that name, if there is one and we read its transform as Assimp does.
  std::optional<std::size_t> node_of(const std::string& name, const FbxTransform& transform) const {
    const auto found = nodes_.find(name);
    if (found == nodes_.end() || found->second.size() != 1 || models_.at(name).size() != 1)
      return std::nullopt;
    if (!is_understood(transform, found->second[0])) return std::nullopt;
    return found->second[0];
  }

  /// Our reading of the node's transform gives the default pose that Assimp found.
  bool is_understood(const FbxTransform& t, std::size_t n) const {
    const Affine3 ours = t.local(t.translation, t.rotation_deg, t.scale).matrix();
    const RawScene::Node& node = scene_.nodes[n];
    const Affine3 theirs = node.matrix.value_or(node.local.matrix());
    return (ours.linear() - theirs.linear()).norm() <= kSamePose * theirs.linear().norm() &&
           (ours.translation() - theirs.translation()).norm() <= kSamePose * t.reach();
  }

  /// Assimp lets some stacks begin at 0; the sampled tracks go along with those that stay.
  static double shift(const RawScene::NodeTracks& tracks, double first) {
    std::optional<double> theirs;
    for (const auto* times : {&tracks.translation.times, &tracks.rotation.times, &tracks.scale.times})
      if (!times->empty()) theirs = std::min(theirs.value_or(times->front()), times->front());
    const double difference = theirs.value_or(first) - first;
    return std::abs(difference) < 1e-6 ? 0 : difference;
  }

  const FbxScene& fbx_;
  RawScene& scene_;
  double frame_;
  std::map<std::string, std::vector<std::size_t>> nodes_;
  std::map<std::string, std::vector<std::int64_t>> models_;
  std::map<std::string, std::vector<std::size_t>> animations_;
  std::map<std::int32_t, RawScene::NodeTracks*> tracks_;  ///< of the clip at hand, by node
  // Read once, however much they drive: shared by all, they would be read as often as connections multiply.
  std::map<std::int64_t, FbxTransform> transforms_;
  std::map<std::int64_t, bool> drives_;
  std::map<std::int64_t, CurveNode> curve_nodes_;
  std::map<std::int64_t, FbxCurve> curves_;
  std::size_t restored_ = 0;
  std::size_t sampled_ = 0;  ///< keys of all of them
};

}  // namespace

void restore_fbx_curves(const FbxScene& fbx, RawScene& scene) {
  Restorer(fbx, scene).run();
}

}  // namespace skinforge
