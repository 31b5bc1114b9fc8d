#include "skeleton/bone_forest.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/expect.h"

namespace skinforge {
namespace {

// For each joint the bone that ends in it; -1 where none does.
std::vector<std::int32_t> bones_by_end(const BoneGraph& graph) {
  std::vector<std::int32_t> bone(graph.joints.size(), -1);
  for (std::size_t k = 0; k < graph.bones.size(); ++k) {
    std::int32_t& slot = bone[static_cast<std::size_t>(graph.bones[k][1])];
    if (slot >= 0)
      throw Error(ExitCode::BadInput, fmt::format("joint {} has two parents: bones {} and {} end there",
                                                  graph.bones[k][1] + 1, slot + 1, k + 1));
    slot = static_cast<std::int32_t>(k);
  }
  return bone;
}

// Breadth first from the roots; what is not reached runs in a circle.
std::vector<std::int32_t> parents_first(const BoneForest& forest) {
  std::vector<std::vector<std::int32_t>> children(forest.size());
  for (std::size_t k = 0; k < forest.size(); ++k)
    if (forest.parent[k] >= 0)
      children[static_cast<std::size_t>(forest.parent[k])].push_back(static_cast<std::int32_t>(k));
  std::vector<std::int32_t> order = forest.roots;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto& below = children[static_cast<std::size_t>(order[i])];
    order.insert(order.end(), below.begin(), below.end());
  }
  return order;
}

}  // namespace

BoneForest make_bone_forest(const BoneGraph& graph) {
  const std::vector<std::int32_t> ending = bones_by_end(graph);
  BoneForest forest;
  for (std::size_t k = 0; k < graph.bones.size(); ++k) {
    const auto [source, end] = graph.bones[k];
    forest.source.push_back(graph.joints[static_cast<std::size_t>(source)]);
    forest.end.push_back(graph.joints[static_cast<std::size_t>(end)]);
    forest.parent.push_back(ending[static_cast<std::size_t>(source)]);
    if (forest.parent.back() < 0) forest.roots.push_back(static_cast<std::int32_t>(k));
  }
  forest.order = parents_first(forest);
  if (forest.order.size() != forest.size()) {
    std::vector<bool> reached(forest.size(), false);
    for (const std::int32_t k : forest.order) reached[static_cast<std::size_t>(k)] = true;
    const auto lost = std::find(reached.begin(), reached.end(), false) - reached.begin();
    throw Error(
        ExitCode::BadInput,
        fmt::format("bones form a cycle: bone {} (joint {} to {}) hangs under itself or under such a bone",
                    lost + 1, graph.bones[static_cast<std::size_t>(lost)][0] + 1,
                    graph.bones[static_cast<std::size_t>(lost)][1] + 1));
  }
  return forest;
}

std::vector<RigidMotion> forward_kinematics(const BoneForest& forest, std::span<const Quat> local) {
  SF_EXPECT(local.size() == forest.size());
  std::vector<RigidMotion> motion(forest.size());
  for (const std::int32_t bone : forest.order) {
    const auto k = static_cast<std::size_t>(bone);
    const RigidMotion above =
        forest.parent[k] < 0 ? RigidMotion() : motion[static_cast<std::size_t>(forest.parent[k])];
    motion[k].rotation = above.rotation * local[k];
    motion[k].translation = above * forest.source[k] - motion[k].rotation * forest.source[k];
  }
  return motion;
}

std::vector<Quat> pose_towards(std::span<const Quat> target, double t) {
  std::vector<Quat> pose;
  for (const Quat& q : target) pose.push_back(Quat::Identity().slerp(t, q));
  return pose;
}

}  // namespace skinforge
