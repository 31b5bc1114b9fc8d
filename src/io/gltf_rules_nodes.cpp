#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/gltf_rule_context.h"

namespace skinforge {

namespace {
constexpr std::size_t kNone = static_cast<std::size_t>(-1);

// Parents of all nodes; a node named by several keeps the first.
class Tree {
 public:
  explicit Tree(GltfRules& rules)
      : nodes_(rules.document.root.objects("nodes")), parents_(nodes_.size(), kNone) {
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      if (const auto children = nodes_[i].find("children"))
        for (std::size_t c = 0; c < children->size(); ++c) {
          const std::size_t child = children->at(c).index(nodes_.size(), "node");
          if (parents_[child] != kNone || child == i)
            rules.error(child == i ? "NODE_LOOP" : "NODE_PARENT_OVERRIDE", children->at(c).place(),
                        fmt::format("node {} has another parent already", child));
          else
            parents_[child] = i;
        }
  }

  const std::vector<JsonPlace>& nodes() const { return nodes_; }
  bool is_root(std::size_t node) const { return parents_[node] == kNone; }
  // From the node to its root, both included; ends where the parents run in a circle.
  std::vector<std::size_t> up_from(std::size_t node) const {
    std::vector<std::size_t> path;
    for (std::size_t at = node; at != kNone && path.size() <= nodes_.size(); at = parents_[at])
      path.push_back(at);
    return path;
  }
  // The nodes at or above all of `joints`, the nearest first; none where they have no common root.
  std::vector<std::size_t> above_all(const std::vector<std::size_t>& joints) const {
    constexpr std::size_t kOpen = kNone - 1;
    const std::vector<std::size_t> path = up_from(joints.front());
    std::vector<std::size_t> meets(parents_.size(), kOpen);  // where the way up from a node meets the path
    for (std::size_t i = path.size(); i-- > 0;) meets[path[i]] = i;
    std::size_t highest = 0;
    for (const std::size_t joint : joints) {
      std::vector<std::size_t> climbed;
      std::size_t at = joint;
      for (; at != kNone && meets[at] == kOpen; at = parents_[at]) {
        meets[at] = kNone;
        climbed.push_back(at);
      }
      const std::size_t meeting = at == kNone ? kNone : meets[at];
      for (const std::size_t node : climbed) meets[node] = meeting;
      if (meeting == kNone) return {};
      highest = std::max(highest, meeting);
    }
    return {path.begin() + static_cast<std::ptrdiff_t>(highest), path.end()};
  }

 private:
  std::vector<JsonPlace> nodes_;
  std::vector<std::size_t> parents_;
};

bool is_identity(const JsonPlace& node) {
  const auto is = [&](const char* key, const std::vector<double>& wanted) {
    const auto value = node.find(key);
    return !value || value->numbers(wanted.size()) == wanted;
  };
  return is("translation", {0, 0, 0}) && is("rotation", {0, 0, 0, 1}) && is("scale", {1, 1, 1}) &&
         is("matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
}

// Whether primitives of a mesh have weights: of some, of all.
std::pair<bool, bool> skinned_primitives(const JsonPlace& mesh) {
  bool some = false, all = true;
  for (const JsonPlace& primitive : mesh.required_objects("primitives")) {
    const JsonPlace attributes = primitive.get("attributes");
    const bool is_skinned = attributes.has("JOINTS_0") && attributes.has("WEIGHTS_0");
    some = some || is_skinned;
    all = all && is_skinned;
  }
  return {some, all};
}

void check_node(const Tree& tree, std::size_t i, const std::vector<JsonPlace>& meshes, GltfRules& rules) {
  const JsonPlace& node = tree.nodes()[i];
  if (const auto rotation = node.find("rotation")) {
    const auto q = rotation->numbers(4);
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(std::abs(length - 1) <= kUnitQuaternion))
      rules.error("ROTATION_NON_UNIT", rotation->place(),
                  fmt::format("the quaternion has length {:.6g}", length));
  }
  const auto mesh = node.find("mesh");
  if (!mesh) return;
  const auto [some, all] = skinned_primitives(meshes[mesh->index(meshes.size(), "mesh")]);
  if (!node.has("skin")) {
    if (some)
      rules.warning("NODE_SKINNED_MESH_WITHOUT_SKIN", node.place(), "the mesh has weights, the node no skin");
    return;
  }
  if (!all)
    rules.error("NODE_SKIN_WITH_NON_SKINNED_MESH", node.place(), "the node has a skin, its mesh no weights");
  if (!tree.is_root(i))
    rules.warning("NODE_SKINNED_MESH_NON_ROOT", node.place(),
                  "a skinned mesh below another node, whose transform does not move it");
  if (!is_identity(node))
    rules.warning("NODE_SKINNED_MESH_LOCAL_TRANSFORMS", node.place(),
                  "a skinned mesh with a transform of its own, which does not move it");
}

void check_skin(const Tree& tree, const JsonPlace& skin, GltfRules& rules) {
  const JsonPlace joints = skin.get("joints");
  std::vector<std::size_t> nodes;
  for (std::size_t j = 0; j < joints.size(); ++j)
    nodes.push_back(joints.at(j).index(tree.nodes().size(), "node"));
  const std::vector<std::size_t> common = nodes.empty() ? nodes : tree.above_all(nodes);
  if (common.empty())
    rules.error("SKIN_NO_COMMON_ROOT", joints.place(), "the joints have no common root");
  else if (const auto root = skin.find("skeleton");
           root &&
           std::find(common.begin(), common.end(), root->index(tree.nodes().size(), "node")) == common.end())
    rules.error("SKIN_SKELETON_INVALID", root->place(), "this node is not above all joints");
  if (const auto matrices = skin.find("inverseBindMatrices")) {
    const auto& accessor =
        rules.document.accessors[matrices->index(rules.document.accessors.size(), "accessor")];
    if (accessor.count < joints.size())
      rules.error("INVALID_IBM_ACCESSOR_COUNT", matrices->place(),
                  fmt::format("{} matrices for {} joints", accessor.count, joints.size()));
  }
}
}  // namespace

void check_nodes_and_skins(GltfRules& rules) {
  const Tree tree(rules);
  const auto meshes = rules.document.root.objects("meshes");
  for (std::size_t i = 0; i < tree.nodes().size(); ++i) check_node(tree, i, meshes, rules);
  for (const JsonPlace& skin : rules.document.root.objects("skins")) check_skin(tree, skin, rules);
}

}  // namespace skinforge
