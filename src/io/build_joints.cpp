#include "io/build_joints.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "base/text.h"

namespace skinforge {
namespace {

constexpr double kSameMatrix =
    1e-4;  // ours: of a joint's reach; binds that differ by less are one (float matrices, a few products)

Affine3 local_matrix(const RawScene::Node& node) {
  return node.matrix ? *node.matrix : node.local.matrix();
}

// Nodes in an order that has parents first, siblings as the file has them.
std::vector<std::int32_t> depth_first(const RawScene& scene) {
  std::vector<std::vector<std::int32_t>> children(scene.nodes.size());
  std::vector<std::int32_t> stack, order;
  for (std::size_t n = scene.nodes.size(); n-- > 0;) {
    const std::int32_t parent = scene.nodes[n].parent;
    (parent < 0 ? stack : children[parent]).push_back(static_cast<std::int32_t>(n));
  }
  while (!stack.empty()) {
    const std::int32_t n = stack.back();
    stack.pop_back();
    order.push_back(n);
    stack.insert(stack.end(), children[n].begin(), children[n].end());
  }
  return order;
}

std::vector<Affine3> default_worlds(const RawScene& scene, const std::vector<std::int32_t>& order) {
  std::vector<Affine3> world(scene.nodes.size(), Affine3::Identity());
  for (const std::int32_t n : order) {
    const std::int32_t parent = scene.nodes[n].parent;
    world[n] = parent < 0 ? local_matrix(scene.nodes[n]) : world[parent] * local_matrix(scene.nodes[n]);
  }
  return world;
}

// Joints of skins, everything below them, animated nodes, nodes with a mesh of their own, and all their
// ancestors.
std::vector<char> choose_nodes(const RawScene& scene, const std::vector<std::int32_t>& order) {
  std::vector<char> in_skin(scene.nodes.size(), 0), chosen(scene.nodes.size(), 0),
      animated(scene.nodes.size(), 0);
  for (const RawScene::Skin& skin : scene.skins)
    for (const std::int32_t n : skin.joints) in_skin[n] = 1;
  for (const RawScene::Animation& animation : scene.animations)
    for (const RawScene::NodeTracks& tracks : animation.nodes)
      if (!tracks.translation.is_empty() || !tracks.rotation.is_empty() || !tracks.scale.is_empty())
        animated[tracks.node] = 1;
  std::vector<char> below_skin = in_skin;
  for (const std::int32_t n : order) {
    const std::int32_t parent = scene.nodes[n].parent;
    if (parent >= 0 && below_skin[parent]) below_skin[n] = 1;
    const bool is_skinned_mesh = scene.nodes[n].mesh >= 0 && scene.nodes[n].skin >= 0;
    const bool has_rigid_mesh = scene.nodes[n].mesh >= 0 && scene.nodes[n].skin < 0;
    chosen[n] = in_skin[n] || has_rigid_mesh || (animated[n] && !is_skinned_mesh) ||
                (below_skin[n] && !is_skinned_mesh);
  }
  for (auto n = order.rbegin(); n != order.rend(); ++n)
    if (chosen[*n] && scene.nodes[*n].parent >= 0) chosen[scene.nodes[*n].parent] = 1;
  return chosen;
}

class Names {
 public:
  std::string unique(const std::string& wanted, const std::string& otherwise) {
    const std::string base = wanted.empty() ? otherwise : printable(wanted);
    std::string name = base;
    for (int n = 2; !taken_.insert(name).second; ++n) name = fmt::format("{}_{}", base, n);
    renamed_ += name != wanted && !wanted.empty();
    return name;
  }
  int renamed() const { return renamed_; }

 private:
  std::set<std::string> taken_;
  int renamed_ = 0;
};

// Where the mesh space of a skin lies in the file's world when the skin is in its bind pose. glTF: joints are
// bound in the space of the node above the topmost skin joint. Other formats record the mesh node's own
// place.
Affine3 file_from_skin_mesh(const RawScene& scene, std::size_t skin, const std::vector<Affine3>& world) {
  if (!scene.skin_ignores_mesh_node)
    for (std::size_t n = 0; n < scene.nodes.size(); ++n)
      if (scene.nodes[n].skin == static_cast<std::int32_t>(skin)) return world[n];
  const std::set<std::int32_t> joints(scene.skins[skin].joints.begin(), scene.skins[skin].joints.end());
  for (std::int32_t n : scene.skins[skin].joints) {
    std::int32_t above = scene.nodes[n].parent;
    bool is_top = true;
    for (std::int32_t a = above; a >= 0; a = scene.nodes[a].parent) is_top &= !joints.contains(a);
    if (is_top) return above >= 0 ? world[above] : Affine3::Identity();
  }
  return Affine3::Identity();
}

bool same_matrix(const Affine3& a, const Affine3& b) {
  const double reach = a.translation().norm() + b.translation().norm();
  const double linear = (a.linear() - b.linear()).norm();
  return linear <= kSameMatrix * (a.linear().norm() + b.linear().norm()) &&
         (a.translation() - b.translation()).norm() <= kSameMatrix * std::max(reach, a.linear().norm());
}

// TRS of an affine map; what shear it has is lost and told.
Transform decompose(const Affine3& m, bool& has_shear) {
  Mat3 linear = m.linear();
  const bool mirrored = linear.determinant() < 0;
  if (mirrored) linear.col(0) *= -1;
  Vec3 scale(linear.col(0).norm(), linear.col(1).norm(), linear.col(2).norm());
  Mat3 rotation = Mat3::Identity();
  if (scale.minCoeff() > 0) {
    for (int k = 0; k < 3; ++k) rotation.col(k) = linear.col(k) / scale[k];
    const Eigen::JacobiSVD<Mat3> svd(rotation, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Mat3 nearest = svd.matrixU() * svd.matrixV().transpose();
    has_shear |= (nearest - rotation).norm() > kSameMatrix;
    rotation = nearest;
  }
  if (mirrored) scale[0] *= -1;
  return {m.translation(), Quat(rotation).normalized(), scale};
}

bool nearly_equal(const Transform& a, const Transform& b) {
  constexpr double kSame = 1e-6;  // ours: rounding of float matrices
  const double size = std::max({a.translation.norm(), b.translation.norm(), 1e-300});
  return (a.translation - b.translation).norm() <= kSame * size &&
         std::abs(a.rotation.dot(b.rotation)) >= 1 - kSame * kSame &&
         (a.scale - b.scale).norm() <= kSame * (a.scale.norm() + b.scale.norm());
}

/// Works the skeleton out step by step; `bind` is in the file's world until the end.
class Builder {
 public:
  Builder(const RawScene& scene, const std::string& place, IssueSink& issues)
      : scene_(scene),
        place_(place),
        issues_(issues),
        order_(depth_first(scene)),
        world_(default_worlds(scene, order_)),
        chosen_(choose_nodes(scene, order_)) {}

  SceneJoints run() {
    add_root();
    for (const std::int32_t n : order_)
      if (chosen_[n]) add_node(n);
    collect_skin_binds();
    fill_missing_binds();
    add_helpers();
    finish();
    return std::move(result_);
  }

 private:
  void add_root() {
    int roots = 0;
    for (const std::int32_t n : order_) roots += chosen_[n] && scene_.nodes[n].parent < 0;
    result_.joint_of_node.resize(scene_.nodes.size());
    result_.root_is_made = roots != 1;
    if (!result_.root_is_made) return;
    if (roots > 1)
      issues_.note("root-added", place_,
                   fmt::format("{} root nodes were put under one joint \"root\"", roots));
    add_joint(names_.unique("root", ""), JointId(), {});
    bind_[0] = Affine3::Identity();
    default_world_.push_back(Affine3::Identity());
  }

  JointId add_joint(const std::string& name, JointId parent, const Transform& default_local) {
    result_.skeleton.joints.push_back({name, parent, default_local, Affine3::Identity()});
    result_.default_pose.push_back(default_local);
    bind_.emplace_back();
    return JointId(result_.skeleton.size() - 1);
  }

  void add_node(std::int32_t n) {
    const RawScene::Node& node = scene_.nodes[n];
    const JointId parent = node.parent >= 0       ? result_.joint_of_node[node.parent]
                           : result_.root_is_made ? JointId(0)
                                                  : JointId();
    Transform local = node.local;
    if (node.matrix) local = decompose(*node.matrix, has_shear_);
    result_.joint_of_node[n] = add_joint(names_.unique(node.name, fmt::format("node{}", n)), parent, local);
    default_world_.push_back(world_[n]);
  }

  // The first skin that binds a joint decides; a skin that differs by one common map is moved, other joints
  // get helpers later.
  void collect_skin_binds() {
    for (std::size_t s = 0; s < scene_.skins.size(); ++s) {
      const RawScene::Skin& skin = scene_.skins[s];
      Affine3 file_from_mesh = file_from_skin_mesh(scene_, s, world_);
      std::optional<Affine3> change;
      for (std::size_t k = 0; k < skin.joints.size() && !change; ++k) {
        const auto& known = bind_[result_.joint_of_node[skin.joints[k]].index()];
        if (known) change = *known * (file_from_mesh * mesh_from_joint(skin, k)).inverse();
      }
      if (change) file_from_mesh = *change * file_from_mesh;
      result_.model_from_skin_mesh.push_back(file_from_mesh);
      auto& joints = result_.skin_joint.emplace_back();
      for (std::size_t k = 0; k < skin.joints.size(); ++k) {
        const JointId joint = result_.joint_of_node[skin.joints[k]];
        auto& known = bind_[joint.index()];
        const Affine3 bind = file_from_mesh * mesh_from_joint(skin, k);
        if (!known) known = bind;
        joints.push_back(joint);
        if (!same_matrix(*known, bind)) helpers_.push_back({s, k, bind});
      }
    }
  }

  static Affine3 mesh_from_joint(const RawScene::Skin& skin, std::size_t k) {
    return skin.inverse_bind.empty() ? Affine3::Identity() : skin.inverse_bind[k].inverse();
  }

  void fill_missing_binds() {
    for (std::size_t j = 0; j < result_.skeleton.size(); ++j) {
      if (bind_[j]) continue;
      const JointId parent = result_.skeleton.joints[j].parent;
      bind_[j] = parent.is_valid() ? *bind_[parent.index()] * default_local(j) : default_local(j);
    }
  }

  Affine3 default_local(std::size_t j) const {
    const JointId parent = result_.skeleton.joints[j].parent;
    return parent.is_valid() ? default_world_[parent.index()].inverse() * default_world_[j]
                             : default_world_[j];
  }

  // A joint that a second skin binds elsewhere gets a child that stays where that skin wants it.
  void add_helpers() {
    std::map<std::pair<JointId, std::size_t>, JointId> made;
    for (const auto& [skin, k, bind] : helpers_) {
      const JointId carrier = result_.skin_joint[skin][k];
      const Transform local = decompose(bind_[carrier.index()]->inverse() * bind, has_shear_);
      const JointId helper =
          add_joint(names_.unique(result_.skeleton[carrier].name + "_bind2", ""), carrier, local);
      bind_[helper.index()] = bind;
      default_world_.push_back(default_world_[carrier.index()] * local.matrix());
      result_.skin_joint[skin][k] = helper;
    }
    if (!helpers_.empty())
      issues_.note("bind-poses-differ", place_,
                   fmt::format("{} joints are bound differently by several skins; helper joints keep both",
                               helpers_.size()));
  }

  // Local transforms of the bind pose, and metres.
  void finish() {
    const Affine3 metres = scene_.metres_from_file.matrix();
    std::size_t differs = 0;
    for (std::size_t j = 0; j < result_.skeleton.size(); ++j) {
      Joint& joint = result_.skeleton.joints[j];
      const Affine3 local =
          joint.parent.is_valid() ? bind_[joint.parent.index()]->inverse() * *bind_[j] : *bind_[j];
      joint.bind = decompose(local, has_shear_);
      if (nearly_equal(joint.bind, result_.default_pose[j]))
        joint.bind = result_.default_pose[j];
      else
        ++differs;
      if (!joint.parent.is_valid()) {
        joint.bind = premultiplied(scene_.metres_from_file, joint.bind);
        result_.default_pose[j] = premultiplied(scene_.metres_from_file, result_.default_pose[j]);
      }
      joint.joint_from_model = (metres * *bind_[j]).inverse();
    }
    for (Affine3& model_from_mesh : result_.model_from_skin_mesh) model_from_mesh = metres * model_from_mesh;
    keep_exact_inverse_binds();
    if (differs > 0)
      issues_.note("bind-pose-restored", place_,
                   fmt::format("{} of {} joints stand differently in the file's default pose than in its "
                               "bind pose; the bind pose is used",
                               differs, result_.skeleton.size()));
    if (has_shear_)
      issues_.warn(
          "shear-dropped", place_,
          "some joints are sheared in the bind pose, which translation, rotation and scale cannot hold");
    if (names_.renamed() > 0)
      issues_.note("joints-renamed", place_,
                   fmt::format("{} joint names were used twice or not printable", names_.renamed()));
  }

  // joint_from_model as the file has it, to the last bit where mesh space is model space.
  void keep_exact_inverse_binds() {
    for (std::size_t s = 0; s < scene_.skins.size(); ++s) {
      const RawScene::Skin& skin = scene_.skins[s];
      if (skin.inverse_bind.empty() ||
          result_.model_from_skin_mesh[s].matrix() != Affine3::Identity().matrix())
        continue;
      for (std::size_t k = 0; k < skin.joints.size(); ++k)
        if (same_matrix(result_.skeleton[result_.skin_joint[s][k]].joint_from_model, skin.inverse_bind[k]))
          result_.skeleton[result_.skin_joint[s][k]].joint_from_model = skin.inverse_bind[k];
    }
  }

  struct Helper {
    std::size_t skin, joint;
    Affine3 bind;
  };

  const RawScene& scene_;
  const std::string& place_;
  IssueSink& issues_;
  std::vector<std::int32_t> order_;
  std::vector<Affine3> world_;
  std::vector<char> chosen_;
  Names names_;
  SceneJoints result_;
  std::vector<std::optional<Affine3>> bind_;  // file_from_joint in the bind pose
  std::vector<Affine3> default_world_;        // file_from_joint in the default pose
  std::vector<Helper> helpers_;
  bool has_shear_ = false;
};

}  // namespace

SceneJoints build_joints(const RawScene& scene, const std::string& place, IssueSink& issues) {
  return Builder(scene, place, issues).run();
}

std::vector<Affine3> bind_matrices(const SceneJoints& joints) {
  return joints.skeleton.model_from_joint();
}

}  // namespace skinforge
