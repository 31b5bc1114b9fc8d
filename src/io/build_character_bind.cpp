#include "io/build_character_bind.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/text.h"

namespace skinforge {
namespace {

/// Two binds of one joint count as one when they differ by no more, of the matrix and of the mesh's size:
/// what float matrices lose in a chain of products.
constexpr double kSameBind = 1e-5;
/// A pose stands for the bind pose when it is this near: exporters write both with rounding, some after a
/// detour through Euler angles.
constexpr double kSamePlace = 1e-3;

/// `size` of the skinned mesh, in the space that the maps lead to.
bool same(const Affine3& a, const Affine3& b, double size, double tolerance) {
  const double far = std::max(a.translation().norm(), b.translation().norm());
  return (a.linear() - b.linear()).norm() <= tolerance * a.linear().norm() &&
         (a.translation() - b.translation()).norm() <= tolerance * std::max(far, size);
}

bool is_regular(const Affine3& m) {
  const double volume = m.linear().determinant();
  return std::isfinite(volume) && volume != 0;
}

/// Angle between the rotations of two maps, in radians; scale does not count.
double turn_between(const Affine3& a, const Affine3& b) {
  const Mat3 turn = (a.linear().inverse() * b.linear());
  const double cosine = (turn.trace() / std::cbrt(std::abs(turn.determinant())) - 1) / 2;
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

class Binder {
 public:
  Binder(const RawScene& scene, const std::string& place, IssueSink& issues)
      : scene_(scene), place_(place), issues_(issues) {
    result_.nodes = scene.nodes;
    result_.node_from_file.resize(scene.nodes.size());
    result_.skin_place.assign(scene.skins.size(), Affine3::Identity());
    result_.skin_nodes.resize(scene.skins.size());
  }

  BoundScene run() {
    sort_nodes();
    world_ = chain({});
    for (const std::size_t skin : skins_by_use()) bind_skin(skin);
    sort_nodes();  // helpers have come
    result_.bind = chain(bind_);
    return std::move(result_);
  }

 private:
  void sort_nodes() {
    const std::size_t count = result_.nodes.size();
    std::vector<std::vector<std::size_t>> children(count);
    std::vector<std::size_t> open;
    for (std::size_t n = count; n-- > 0;) {
      const std::int32_t parent = result_.nodes[n].parent;
      if (parent < 0)
        open.push_back(n);
      else
        children[static_cast<std::size_t>(parent)].push_back(n);
    }
    result_.order.clear();
    while (!open.empty()) {
      const std::size_t node = open.back();
      open.pop_back();
      result_.order.push_back(node);
      open.insert(open.end(), children[node].begin(), children[node].end());
    }
  }

  /// file_from_node of all nodes: what `fixed` says, else the parent's times the default pose.
  std::vector<Affine3> chain(const std::vector<std::optional<Affine3>>& fixed) const {
    std::vector<Affine3> world(result_.nodes.size(), Affine3::Identity());
    for (const std::size_t n : result_.order) {
      const RawScene::Node& node = result_.nodes[n];
      const Affine3 local = node.matrix.value_or(node.local.matrix());
      world[n] = node.parent < 0 ? local : world[static_cast<std::size_t>(node.parent)] * local;
      if (n < fixed.size() && fixed[n]) world[n] = *fixed[n];
    }
    return world;
  }

  /// Skins in the order of the first node that shows them, then those that nothing shows.
  std::vector<std::size_t> skins_by_use() {
    user_.assign(scene_.skins.size(), -1);
    std::vector<std::size_t> order;
    for (std::size_t n = 0; n < scene_.nodes.size(); ++n) {
      const RawScene::Node& node = scene_.nodes[n];
      if (node.mesh < 0 || node.skin < 0 || user_[static_cast<std::size_t>(node.skin)] >= 0) continue;
      user_[static_cast<std::size_t>(node.skin)] = static_cast<std::int32_t>(n);
      order.push_back(static_cast<std::size_t>(node.skin));
    }
    for (std::size_t s = 0; s < user_.size(); ++s)
      if (user_[s] < 0) order.push_back(s);
    return order;
  }

  Affine3 inverse_bind(const RawScene::Skin& skin, std::size_t k) const {
    return skin.inverse_bind.empty() ? Affine3::Identity() : skin.inverse_bind[k];
  }

  void bind_skin(std::size_t s) {
    const RawScene::Skin& skin = scene_.skins[s];
    bind_.resize(result_.nodes.size());
    reach_ = reach_of(s);
    const Affine3 place = place_of(s);
    size_ = size_under(place);
    const bool is_identity = place.isApprox(Affine3::Identity(), 0);
    result_.skin_place[s] = place;
    for (std::size_t k = 0; k < skin.joints.size(); ++k) {
      const Affine3 inverse = is_identity ? inverse_bind(skin, k) : inverse_bind(skin, k) * place.inverse();
      result_.skin_nodes[s].push_back(bind_joint(skin.joints[k], inverse));
    }
  }

  /// Diagonal of the box around all vertices of a skin, as its meshes have them.
  double reach_of(std::size_t s) const {
    Eigen::AlignedBox3d box;
    for (const RawScene::Node& node : scene_.nodes) {
      if (node.mesh < 0 || node.skin != static_cast<std::int32_t>(s)) continue;
      for (const auto& primitive : scene_.meshes[static_cast<std::size_t>(node.mesh)].primitives)
        for (const Vec3& p : primitive.positions) box.extend(p);
    }
    return box.isEmpty() ? 0 : box.diagonal().norm();
  }

  double size_under(const Affine3& file_from_mesh) const { return reach_ * file_from_mesh.linear().norm(); }

  /// The node that carries this bind of a joint: the joint itself, or a helper that moves with it.
  std::int32_t bind_joint(std::int32_t joint, const Affine3& node_from_file) {
    const Affine3 bind = node_from_file.inverse();
    for (std::int32_t node : carriers_of(joint)) {
      auto& known = bind_[static_cast<std::size_t>(node)];
      if (known && !same(*known, bind, size_, kSameBind)) continue;
      if (!known) {
        known = bind;
        result_.node_from_file[static_cast<std::size_t>(node)] = node_from_file;
      }
      return node;
    }
    return add_helper(joint, bind, node_from_file);
  }

  std::vector<std::int32_t> carriers_of(std::int32_t joint) const {
    std::vector<std::int32_t> carriers = {joint};
    for (const auto& [owner, helper] : helpers_)
      if (owner == joint) carriers.push_back(helper);
    return carriers;
  }

  /// In the file's pose the helper lies on its joint, so it moves as the joint does; only its bind differs.
  std::int32_t add_helper(std::int32_t joint, const Affine3& bind, const Affine3& node_from_file) {
    const auto helper = static_cast<std::int32_t>(result_.nodes.size());
    const std::size_t number = carriers_of(joint).size() + 1;
    const std::string& name = result_.nodes[static_cast<std::size_t>(joint)].name;
    RawScene::Node node;
    node.name = fmt::format("{}_bind{}", name.empty() ? fmt::format("node{}", joint) : name, number);
    node.parent = joint;
    issues_.note("second-bind", place_,
                 fmt::format("skins bind joint \"{}\" differently; joint \"{}\" carries the other bind",
                             printable(name), printable(node.name)));
    result_.nodes.push_back(std::move(node));
    result_.node_from_file.emplace_back(node_from_file);
    bind_.emplace_back(bind);
    helpers_.emplace_back(joint, helper);
    return helper;
  }

  /// file_from_mesh of the vertices of a skin. Any invertible choice plays the same; this one decides where
  /// the bind pose stands.
  Affine3 place_of(std::size_t s) const {
    const RawScene::Skin& skin = scene_.skins[s];
    const Affine3 node =
        user_[s] >= 0 ? world_[static_cast<std::size_t>(user_[s])] : Affine3(Affine3::Identity());
    if (const auto shared = shared_place(skin, node)) return *shared;
    if (!scene_.skin_ignores_mesh_node && user_[s] >= 0 && is_regular(node)) return node;
    return place_by_pose(skin, node, user_[s] >= 0 && is_regular(node));
  }

  /// The map under which most joints that an earlier skin bound keep their bind.
  std::optional<Affine3> shared_place(const RawScene::Skin& skin, const Affine3& node) const {
    std::vector<Affine3> votes;
    for (std::size_t k = 0; k < skin.joints.size(); ++k)
      if (const auto& bind = bind_[static_cast<std::size_t>(skin.joints[k])])
        votes.push_back(*bind * inverse_bind(skin, k));
    if (votes.empty()) return std::nullopt;
    const auto support = [&](const Affine3& map) {
      return std::count_if(votes.begin(), votes.end(),
                           [&](const Affine3& vote) { return same(map, vote, size_under(map), kSameBind); });
    };
    if (support(node) == static_cast<std::ptrdiff_t>(votes.size())) return node;
    return *std::max_element(votes.begin(), votes.end(),
                             [&](const Affine3& a, const Affine3& b) { return support(a) < support(b); });
  }

  /// glTF says that the mesh node does not count, and its own pose of the joints need not be the bind pose.
  /// Best evidence first: a joint that stands in its bind pose if the mesh stands where its node is; all
  /// joints in the bind pose; else whichever turns the joints less on the way to their pose.
  Affine3 place_by_pose(const RawScene::Skin& skin, const Affine3& node, bool has_node) const {
    std::vector<Affine3> poses;
    for (std::size_t k = 0; k < skin.joints.size(); ++k)
      poses.push_back(world_[static_cast<std::size_t>(skin.joints[k])] * inverse_bind(skin, k));
    std::erase_if(poses, [](const Affine3& pose) { return !is_regular(pose); });
    if (poses.empty()) return has_node ? node : Affine3(Affine3::Identity());
    const auto agrees = [this](const Affine3& map) {
      return [&, size = size_under(map)](const Affine3& pose) { return same(map, pose, size, kSamePlace); };
    };
    if (has_node && std::any_of(poses.begin(), poses.end(), agrees(node))) return node;
    const Affine3& root = poses.front();
    if (!has_node || std::all_of(poses.begin(), poses.end(), agrees(root))) return root;
    const auto mean_turn = [&](const Affine3& map) {
      double sum = 0;
      for (const Affine3& pose : poses) sum += turn_between(map, pose);
      return sum / static_cast<double>(poses.size());
    };
    constexpr double kPlain = std::numbers::pi / 4;  // ours: between a posed limb and a turned character
    return mean_turn(node) > kPlain && mean_turn(root) < kPlain ? root : node;
  }

  const RawScene& scene_;
  const std::string& place_;
  IssueSink& issues_;
  BoundScene result_;
  std::vector<Affine3> world_;  ///< the file's default pose
  double reach_ = 0;            ///< of the skin at work, in mesh space
  double size_ = 0;             ///< the same in the space of the file
  std::vector<std::optional<Affine3>> bind_;
  std::vector<std::int32_t> user_;                              ///< per skin, the first node that shows it
  std::vector<std::pair<std::int32_t, std::int32_t>> helpers_;  ///< joint, helper
};

}  // namespace

BoundScene bind_scene(const RawScene& scene, const std::string& place, IssueSink& issues) {
  return Binder(scene, place, issues).run();
}

}  // namespace skinforge
