#include "io/build_character_joints.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/text.h"
#include "io/trs.h"

namespace skinforge {
namespace {

/// A bind TRS this near to the file's default pose is the default pose: what float bind matrices lose.
/// Relative for lengths and scales, radians for turns.
constexpr double kSamePose = 2e-6;
constexpr double kShear = 1e-4;  // of the largest axis; below it TRS is as good as the float matrix

bool is_near(const Transform& a, const Transform& b, double length) {
  const double size = std::max(b.scale.cwiseAbs().maxCoeff(), 1e-300);
  return (a.translation - b.translation).norm() <= kSamePose * length &&
         (a.scale - b.scale).cwiseAbs().maxCoeff() <= kSamePose * size &&
         a.rotation.angularDistance(b.rotation.normalized()) <= kSamePose;
}

/// Nodes that become joints.
class Choice {
 public:
  Choice(const RawScene& scene, const BoundScene& bound) : bound_(bound), chosen(bound.nodes.size(), false) {
    std::vector<bool> is_skin_joint(chosen.size(), false), has_child(chosen.size(), false);
    for (const auto& nodes : bound.skin_nodes)
      for (const std::int32_t n : nodes) is_skin_joint[static_cast<std::size_t>(n)] = true;
    for (const RawScene::Node& node : bound.nodes)
      if (node.parent >= 0) has_child[static_cast<std::size_t>(node.parent)] = true;
    const auto is_skinned_leaf = [&](std::size_t n) {  // its transform moves nothing
      return bound.nodes[n].skin >= 0 && bound.nodes[n].mesh >= 0 && !has_child[n] && !is_skin_joint[n];
    };
    below_ = is_skin_joint;
    for (const std::size_t n : bound.order) {
      const std::int32_t parent = bound.nodes[n].parent;
      if (parent >= 0 && below_[static_cast<std::size_t>(parent)]) below_[n] = true;
      if (below_[n] && !is_skinned_leaf(n)) add(n);
    }
    for (const RawScene::Animation& animation : scene.animations)
      for (const RawScene::NodeTracks& tracks : animation.nodes) {
        const bool moves =
            !tracks.translation.is_empty() || !tracks.rotation.is_empty() || !tracks.scale.is_empty();
        const auto n = static_cast<std::size_t>(tracks.node);
        if (moves && !is_skinned_leaf(n)) add(n);
      }
  }

 private:
  void add(std::size_t n) {
    while (!chosen[n]) {
      chosen[n] = true;
      if (bound_.nodes[n].parent < 0) break;
      n = static_cast<std::size_t>(bound_.nodes[n].parent);
    }
  }

  const BoundScene& bound_;
  std::vector<bool> below_;

 public:
  std::vector<bool> chosen;
};

/// Names in joint order, made printable, non-empty and unique. A name that is unique in the file stays.
class Names {
 public:
  Names(const std::string& place, IssueSink& issues) : place_(place), issues_(issues) {}

  void reserve(const std::string& name) { ++wanted_[name]; }

  std::string settle(const std::string& name) {
    std::string result = name;
    for (int number = 2; !used_.insert(result).second; ++number) {
      result = fmt::format("{}_{}", name, number);
      if (wanted_.count(result)) result = name;  // belongs to another joint
    }
    if (result != name)
      issues_.warn("joint-renamed", place_,
                   fmt::format("joint name \"{}\" is used twice; now \"{}\"", name, result));
    return result;
  }

 private:
  const std::string& place_;
  IssueSink& issues_;
  std::map<std::string, int> wanted_;
  std::set<std::string> used_;
};

class JointBuilder {
 public:
  JointBuilder(const RawScene& scene, const BoundScene& bound, const std::string& place, IssueSink& issues)
      : scene_(scene), bound_(bound), place_(place), issues_(issues), choice_(scene, bound) {}

  JointTable run() {
    table_.joint_of_node.resize(bound_.nodes.size());
    Eigen::AlignedBox3d box;
    for (std::size_t n = 0; n < bound_.nodes.size(); ++n)
      if (choice_.chosen[n]) box.extend(Vec3(bound_.bind[n].translation()));
    size_ = box.isEmpty() ? 0 : box.diagonal().norm();
    if (needs_root()) add_root();
    for (const std::size_t n : bound_.order)
      if (choice_.chosen[n]) add_joint(n);
    name_joints();
    find_carriers();
    return std::move(table_);
  }

 private:
  /// One root that all stands below: the file's own when it is alone and nothing rigid stands beside it.
  bool needs_root() const {
    std::size_t roots = 0;
    std::vector<bool> below_root(bound_.nodes.size(), false);
    for (const std::size_t n : bound_.order) {
      const RawScene::Node& node = bound_.nodes[n];
      if (node.parent < 0 && choice_.chosen[n]) ++roots;
      below_root[n] = node.parent < 0 ? choice_.chosen[n] : below_root[static_cast<std::size_t>(node.parent)];
      if (node.mesh >= 0 && node.skin < 0 && !below_root[n]) return true;
    }
    return roots != 1;
  }

  void add_root() {
    node_of_joint_.push_back(-1);
    table_.skeleton.joints.emplace_back();
    table_.rest.emplace_back();
    table_.is_top.push_back(false);
  }

  void add_joint(std::size_t n) {
    const RawScene::Node& node = bound_.nodes[n];
    const bool is_top = node.parent < 0;
    const bool has_added_root = !node_of_joint_.empty() && node_of_joint_.front() < 0;
    Joint joint;
    if (!is_top) joint.parent = table_.joint_of_node[static_cast<std::size_t>(node.parent)];
    if (is_top && has_added_root) joint.parent = JointId(0);
    const Transform rest = is_top ? in_metres(node.local) : node.local;
    joint.bind = bind_of(n, rest);
    joint.joint_from_model = joint_from_model(n);
    table_.joint_of_node[n] = JointId(table_.skeleton.size());
    table_.skeleton.joints.push_back(std::move(joint));
    table_.rest.push_back(rest);
    table_.is_top.push_back(is_top);
    node_of_joint_.push_back(static_cast<std::int32_t>(n));
  }

  Transform in_metres(const Transform& local) const {
    return scene_.metres_from_file.is_identity() ? local : premultiplied(scene_.metres_from_file, local);
  }

  Transform bind_of(std::size_t n, const Transform& rest) {
    const std::int32_t parent = bound_.nodes[n].parent;
    Affine3 local = bound_.bind[n];
    if (parent >= 0) local = bound_.bind[static_cast<std::size_t>(parent)].inverse() * local;
    const TrsForm form = to_trs(local, bound_.nodes[n].local);
    if (form.error > kShear)
      issues_.warn(
          "bind-sheared", place_,
          fmt::format("the bind pose of joint \"{}\" is sheared by {:.2g}; its TRS form leaves that out",
                      printable(bound_.nodes[n].name), form.error));
    const Transform bind = parent < 0 ? in_metres(form.transform) : form.transform;
    return is_near(bind, rest, size_in_parent(n)) ? rest : bind;
  }

  /// Size of the skeleton in the units of the joint's parent.
  double size_in_parent(std::size_t n) const {
    const std::int32_t parent = bound_.nodes[n].parent;
    if (parent < 0) return size_ * scene_.metres_from_file.scale;
    const double scale =
        std::cbrt(std::abs(bound_.bind[static_cast<std::size_t>(parent)].linear().determinant()));
    return scale > 0 ? size_ / scale : 0;
  }

  Affine3 joint_from_model(std::size_t n) const {
    const Affine3 from_file = bound_.node_from_file[n].value_or(bound_.bind[n].inverse());
    if (scene_.metres_from_file.is_identity()) return from_file;
    return from_file * scene_.metres_from_file.matrix().inverse();
  }

  void name_joints() {
    Names names(place_, issues_);
    std::vector<std::string> wanted;
    for (const std::int32_t n : node_of_joint_) {
      const std::string file_name = n < 0 ? "root" : bound_.nodes[static_cast<std::size_t>(n)].name;
      wanted.push_back(file_name.empty() ? fmt::format("node{}", n) : printable(file_name));
      if (n < 0) wanted.back() = "root";
      names.reserve(wanted.back());
      if (!file_name.empty() && wanted.back() != file_name)
        issues_.warn("name-made-printable", place_,
                     fmt::format("joint name \"{}\" is not text", wanted.back()));
    }
    const std::size_t added = node_of_joint_.front() < 0 ? 1 : 0;
    auto& joints = table_.skeleton.joints;
    for (std::size_t j = added; j < joints.size(); ++j) joints[j].name = names.settle(wanted[j]);
    if (added == 0) return;
    joints[0].name = names.settle("root");  // names of the file come first
    issues_.note("root-added", place_,
                 fmt::format("joint \"{}\" is added above {} roots", joints[0].name,
                             std::count(table_.is_top.begin(), table_.is_top.end(), true)));
  }

  void find_carriers() {
    table_.carrier_of_node.assign(bound_.nodes.size(), JointId(0));
    for (const std::size_t n : bound_.order) {
      const std::int32_t parent = bound_.nodes[n].parent;
      if (table_.joint_of_node[n].is_valid())
        table_.carrier_of_node[n] = table_.joint_of_node[n];
      else if (parent >= 0)
        table_.carrier_of_node[n] = table_.carrier_of_node[static_cast<std::size_t>(parent)];
    }
  }

  const RawScene& scene_;
  const BoundScene& bound_;
  const std::string& place_;
  IssueSink& issues_;
  Choice choice_;
  JointTable table_;
  double size_ = 0;  ///< diagonal of the joints' places in the bind pose, file space
  std::vector<std::int32_t> node_of_joint_;
};

}  // namespace

JointTable build_joints(const RawScene& scene, const BoundScene& bound, const std::string& place,
                        IssueSink& issues) {
  return JointBuilder(scene, bound, place, issues).run();
}

}  // namespace skinforge
