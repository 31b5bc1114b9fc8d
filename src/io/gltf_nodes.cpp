#include "io/gltf_nodes.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.h"
#include "base/limits.h"
#include "io/trs.h"

namespace skinforge {
namespace {

constexpr double kUnitQuaternion =
    5e-3;                            // what rounding to 8 bits leaves; the Khronos validator allows as much
constexpr double kAffineRow = 1e-6;  // last row of a float matrix that went through a few products
constexpr double kShear = 1e-4;      // what a chain of products of float matrices leaves

Quat rotation(const JsonPlace& place, const std::string& where, IssueSink& issues) {
  const auto q = place.numbers(4);
  const Quat quaternion = quaternion_xyzw(q[0], q[1], q[2], q[3]);
  const double length = quaternion.norm();
  if (std::abs(length - 1) <= kUnitQuaternion) return quaternion;
  if (!(length > 0) || !std::isfinite(length)) place.fail("the quaternion has no direction");
  issues.warn("rotation-normalised", where, fmt::format("the rotation had length {:.4g}", length));
  return quaternion.normalized();
}

Affine3 affine(const double* column_major, const JsonPlace& place, const std::string& which) {
  const Eigen::Map<const Eigen::Matrix4d> m(column_major);
  const Eigen::RowVector4d row = m.row(3) - Eigen::RowVector4d(0, 0, 0, 1);
  if (row.cwiseAbs().maxCoeff() > kAffineRow) place.fail(which + " does not end in the row 0 0 0 1");
  Affine3 result;
  result.matrix() = m.topRows<3>();
  return result;
}

/// The node tree in preorder, so that every subtree is one range.
struct NodeTree {
  std::vector<std::size_t> order;  ///< nodes in preorder
  std::vector<std::size_t> first;  ///< per node, its place in `order`
  std::vector<std::size_t> last;   ///< per node, the place behind its subtree
  std::vector<std::size_t> top;    ///< per node, its root

  bool is_above(std::size_t ancestor, std::size_t node) const {
    return first[ancestor] <= first[node] && first[node] < last[ancestor];
  }
};

class NodeReader {
 public:
  NodeReader(const GltfDocument& document, RawScene& scene, IssueSink& issues)
      : document_(document), scene_(scene), issues_(issues), places_(document.root.objects("nodes")) {}

  void read() {
    if (places_.size() > limits().nodes)
      document_.root.get("nodes").fail(fmt::format("{} nodes, {}", places_.size(), limit_hint("nodes")));
    mesh_count_ = document_.root.objects("meshes").size();
    skin_places_ = document_.root.objects("skins");
    for (const JsonPlace& place : places_) scene_.nodes.push_back(read_node(place));
    children_.resize(places_.size());
    for (std::size_t i = 0; i < places_.size(); ++i) link_children(i);
    walk_tree();
    for (const JsonPlace& place : skin_places_) read_skin(place);
    leave_out_other_scenes();
    check_skinned_nodes();
  }

 private:
  RawScene::Node read_node(const JsonPlace& place) {
    RawScene::Node node;
    node.name = place.text_or("name", "");
    if (const auto mesh = place.find("mesh"))
      node.mesh = static_cast<std::int32_t>(mesh->index(mesh_count_, "mesh"));
    if (const auto skin = place.find("skin"))
      node.skin = static_cast<std::int32_t>(skin->index(skin_places_.size(), "skin"));
    if (node.skin >= 0 && node.mesh < 0) place.fail("a skin without a mesh");
    if (const auto t = place.find("translation")) node.local.translation = Vec3(t->numbers(3).data());
    if (const auto r = place.find("rotation"))
      node.local.rotation = rotation(*r, document_.at(place), issues_);
    if (const auto s = place.find("scale")) node.local.scale = Vec3(s->numbers(3).data());
    if (const auto m = place.find("matrix")) read_matrix(*m, node);
    return node;
  }

  /// glTF 2.0, section 3.5.3: a node matrix must be a product of translation, rotation and scale.
  static void read_matrix(const JsonPlace& place, RawScene::Node& node) {
    const auto numbers = place.numbers(16);
    const Affine3 matrix = affine(numbers.data(), place, "the matrix");
    const TrsForm form = to_trs(matrix);
    if (form.error > kShear) place.fail("the matrix has no form translation * rotation * scale");
    node.local = form.transform;
  }

  void link_children(std::size_t parent) {
    const auto children = places_[parent].find("children");
    if (!children) return;
    for (std::size_t i = 0; i < children->size(); ++i) {
      const JsonPlace place = children->at(i);
      const std::size_t child = place.index(places_.size(), "node");
      RawScene::Node& node = scene_.nodes[child];
      if (child == parent) place.fail(fmt::format("node {} is its own child", child));
      if (node.parent >= 0)
        place.fail(fmt::format("node {} has two parents, {} and {}", child, node.parent, parent));
      node.parent = static_cast<std::int32_t>(parent);
      children_[parent].push_back(child);
    }
  }

  /// With one parent each, nodes of a cycle are those that no root reaches.
  void walk_tree() {
    const std::size_t count = places_.size();
    std::vector<std::size_t> depth(count, 0), open;
    tree_.first.resize(count);
    tree_.top.resize(count);
    for (std::size_t i = count; i-- > 0;)
      if (scene_.nodes[i].parent < 0) enter(i, i, 1, depth, open);
    while (!open.empty()) {
      const std::size_t node = open.back();
      open.pop_back();
      if (depth[node] > limits().depth)
        places_[node].fail(
            fmt::format("the node tree is {} levels deep here, {}", depth[node], limit_hint("depth")));
      tree_.first[node] = tree_.order.size();
      tree_.order.push_back(node);
      for (const std::size_t child : children_[node])
        enter(child, tree_.top[node], depth[node] + 1, depth, open);
    }
    const auto lost = std::find(depth.begin(), depth.end(), std::size_t{0});
    if (lost != depth.end())
      places_[static_cast<std::size_t>(lost - depth.begin())].fail("the node is part of a cycle of children");
    find_subtree_ends();
  }

  void enter(std::size_t node, std::size_t top, std::size_t depth, std::vector<std::size_t>& depths,
             std::vector<std::size_t>& open) {
    depths[node] = depth;
    tree_.top[node] = top;
    open.push_back(node);
  }

  void find_subtree_ends() {
    tree_.last.resize(places_.size());
    for (std::size_t i = 0; i < tree_.last.size(); ++i) tree_.last[i] = tree_.first[i] + 1;
    for (auto node = tree_.order.rbegin(); node != tree_.order.rend(); ++node)
      if (const auto parent = scene_.nodes[*node].parent; parent >= 0) {
        auto& end = tree_.last[static_cast<std::size_t>(parent)];
        end = std::max(end, tree_.last[*node]);
      }
  }

  void read_skin(const JsonPlace& place) {
    RawScene::Skin skin;
    skin.name = place.text_or("name", "");
    const JsonPlace joints = place.get("joints");
    if (joints.size() == 0) joints.fail("a skin without joints");
    if (joints.size() > limits().joints)
      joints.fail(fmt::format("{} joints, {}", joints.size(), limit_hint("joints")));
    std::set<std::int32_t> seen;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      skin.joints.push_back(static_cast<std::int32_t>(joints.at(i).index(places_.size(), "node")));
      if (!seen.insert(skin.joints.back()).second)
        joints.at(i).fail(fmt::format("node {} is a joint twice", skin.joints.back()));
    }
    read_inverse_binds(place, skin);
    check_skin_root(place, skin);
    scene_.skins.push_back(std::move(skin));
  }

  void read_inverse_binds(const JsonPlace& place, RawScene::Skin& skin) {
    const auto reference = place.find("inverseBindMatrices");
    if (!reference) return;
    const GltfAccessor& accessor = document_.accessors.find(*reference, {"MAT4"}, {gltf::kFloat});
    if (accessor.count < skin.joints.size())
      reference->fail(
          fmt::format("{} inverse bind matrices for {} joints", accessor.count, skin.joints.size()));
    if (accessor.strided_view)
      issues_.warn("view-stride", document_.at(*reference),
                   "inverse bind matrices lie in a view with a stride");
    const GltfValues values = GltfAccessors::values(accessor);
    for (std::size_t i = 0; i < skin.joints.size(); ++i) {
      const std::string which = fmt::format("inverse bind matrix {}", i);
      skin.inverse_bind.push_back(affine(values[i], *reference, which));
      const double volume = skin.inverse_bind.back().linear().determinant();
      if (!std::isfinite(volume) || volume == 0) reference->fail(which + " cannot be inverted");
    }
  }

  bool is_above_all(std::size_t ancestor, const RawScene::Skin& skin) const {
    return std::all_of(skin.joints.begin(), skin.joints.end(), [&](std::int32_t joint) {
      return tree_.is_above(ancestor, static_cast<std::size_t>(joint));
    });
  }
  void check_skin_root(const JsonPlace& place, const RawScene::Skin& skin) {
    if (!is_above_all(tree_.top[static_cast<std::size_t>(skin.joints.front())], skin))
      issues_.warn("skin-without-common-root", document_.at(place),
                   "the joints of the skin have no common root");
    const auto skeleton = place.find("skeleton");
    if (skeleton && !is_above_all(skeleton->index(places_.size(), "node"), skin))
      issues_.warn("skin-skeleton-ignored", document_.at(place),
                   "\"skeleton\" is not above all joints; it is ignored");
  }

  /// Which nodes belong to the default scene; all when the file has no scenes.
  std::vector<bool> in_scene() const {
    std::vector<bool> inside(places_.size(), true);
    const auto scenes = document_.root.objects("scenes");
    if (const auto chosen = document_.root.find("scene")) chosen->index(scenes.size(), "scene");
    if (scenes.empty()) return inside;
    std::vector<bool> is_root(places_.size(), false);
    for (std::size_t s = 0; s < scenes.size(); ++s) {
      const auto list = scenes[s].find("nodes");
      for (std::size_t i = 0; list && i < list->size(); ++i) {
        const std::size_t node = list->at(i).index(places_.size(), "node");
        if (scene_.nodes[node].parent >= 0)
          list->at(i).fail(fmt::format("node {} of the scene is not a root", node));
        if (s == document_.root.count_or("scene", 0)) is_root[node] = true;
      }
    }
    for (std::size_t i = 0; i < inside.size(); ++i) inside[i] = is_root[tree_.top[i]];
    return inside;
  }

  void leave_out_other_scenes() {
    const std::vector<bool> inside = in_scene();
    for (std::size_t i = 0; i < inside.size(); ++i) {
      RawScene::Node& node = scene_.nodes[i];
      if (!inside[i] && node.mesh >= 0) {
        issues_.warn("mesh-outside-scene", document_.at(places_[i]),
                     "the mesh is in no node of the default scene and left out");
        node.mesh = -1;
      }
      if (node.mesh < 0 || node.skin < 0) continue;
      const RawScene::Skin& skin = scene_.skins[static_cast<std::size_t>(node.skin)];
      if (!std::all_of(skin.joints.begin(), skin.joints.end(),
                       [&](std::int32_t j) { return inside[static_cast<std::size_t>(j)]; }))
        issues_.warn("joints-outside-scene", document_.at(places_[i]),
                     "joints of the skin are in no node of the default scene");
    }
  }

  /// glTF 2.0, section 3.7.4: only the joints place a skinned mesh.
  void check_skinned_nodes() {
    std::vector<bool> below_joint(places_.size(), false);
    for (const RawScene::Skin& skin : scene_.skins)
      for (const std::int32_t joint : skin.joints) below_joint[static_cast<std::size_t>(joint)] = true;
    std::vector<Affine3> world(places_.size());
    for (const std::size_t i : tree_.order) {
      const RawScene::Node& node = scene_.nodes[i];
      const auto parent = static_cast<std::size_t>(std::max(node.parent, 0));
      world[i] = node.parent < 0 ? node.local.matrix() : world[parent] * node.local.matrix();
      if (node.parent >= 0 && below_joint[parent]) below_joint[i] = true;
      if (node.skin >= 0 && node.mesh >= 0 &&
          (below_joint[i] || !world[i].isApprox(Affine3::Identity(), kAffineRow)))
        issues_.warn("skinned-node-transform-ignored", document_.at(places_[i]),
                     "the skinned mesh has a transform of its own, which glTF says to ignore");
    }
  }

  const GltfDocument& document_;
  RawScene& scene_;
  IssueSink& issues_;
  std::vector<JsonPlace> places_;
  std::vector<JsonPlace> skin_places_;
  std::size_t mesh_count_ = 0;
  std::vector<std::vector<std::size_t>> children_;
  NodeTree tree_;
};

}  // namespace

void read_nodes(const GltfDocument& document, RawScene& scene, IssueSink& issues) {
  NodeReader(document, scene, issues).read();
}

}  // namespace skinforge
