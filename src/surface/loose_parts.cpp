#include "surface/loose_parts.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

#include "geometry/edges.h"
#include "geometry/triangle_bvh.h"
#include "surface/triangle_patch.h"

namespace skinforge {
namespace {

constexpr double kMost = 0.5;    // ours: of a joint's weight, or of an island's
constexpr double kHolds = 0.1;   // ours: of a part's weight; a joint with less does not hold it
constexpr double kNearer = 0.5;  // ours: of the distance to its own side

// Faces of the side that hang together.
struct Island {
  std::vector<FaceId> faces;
  bool is_whole = true;              // no face of its component is on the other side
  std::map<JointId, double> weight;  // of its vertices
  double total = 0;
};

std::int32_t root_of(std::vector<std::int32_t>& leader, std::int32_t v) {
  while (leader[v] != v) v = leader[v] = leader[leader[v]];
  return v;
}

std::vector<Island> find_islands(const PolygonMesh& mesh, const SkinWeights& weights, const FaceSet& side) {
  std::vector<std::int32_t> leader(mesh.vertex_count());
  std::iota(leader.begin(), leader.end(), 0);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    if (!side[f]) continue;
    const auto face = mesh.face(FaceId(f));
    for (const VertexId v : face) {
      const std::int32_t a = root_of(leader, face[0].value), b = root_of(leader, v.value);
      leader[std::max(a, b)] = std::min(a, b);
    }
  }
  const Components components = connected_components(mesh);
  std::vector<bool> is_split(static_cast<std::size_t>(components.count), false);
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    if (!side[f]) is_split[components.of_face[f]] = true;
  std::map<std::int32_t, std::size_t> index;
  std::vector<Island> islands;
  std::vector<bool> is_counted(mesh.vertex_count(), false);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    if (!side[f]) continue;
    const auto [found, is_new] =
        index.try_emplace(root_of(leader, mesh.face(FaceId(f))[0].value), islands.size());
    if (is_new) islands.emplace_back();
    Island& island = islands[found->second];
    island.faces.push_back(FaceId(f));
    island.is_whole = !is_split[components.of_face[f]];
    for (const VertexId v : mesh.face(FaceId(f))) {
      if (is_counted[v.index()]) continue;
      is_counted[v.index()] = true;
      for (const Influence& i : weights.of(v)) island.weight[i.joint] += i.weight, island.total += i.weight;
    }
  }
  return islands;
}

std::vector<double> weight_of_joints(const SkinWeights& weights, std::size_t joints) {
  std::vector<double> sums(joints, 0);
  for (const Influence& i : weights.influences) sums[i.joint.index()] += i.weight;
  return sums;
}

std::vector<bool> with_ancestors(const Skeleton& skeleton, std::span<const JointId> joints) {
  std::vector<bool> marked(skeleton.size(), false);
  for (JointId joint : joints)
    for (; joint.is_valid(); joint = skeleton[joint].parent) marked[joint.index()] = true;
  return marked;
}

// Of the joints those without another one above them.
std::vector<JointId> topmost(const Skeleton& skeleton, const std::vector<JointId>& joints) {
  std::vector<JointId> tops;
  for (const JointId joint : joints) {
    const std::vector<JointId> one{skeleton[joint].parent};
    const std::vector<bool> above = with_ancestors(skeleton, one);
    if (std::none_of(joints.begin(), joints.end(), [&](JointId j) { return above[j.index()]; }))
      tops.push_back(joint);
  }
  return tops;
}

class Search {
 public:
  Search(const PolygonMesh& mesh, const SkinWeights& weights, const Skeleton& skeleton, const FaceSet& side,
         std::span<const JointId> cut_at)
      : mesh_(mesh),
        skeleton_(skeleton),
        islands_(find_islands(mesh, weights, side)),
        weight_of_joint_(weight_of_joints(weights, skeleton.size())),
        is_no_holder_(with_ancestors(skeleton, cut_at)),
        state_(islands_.size(), State::Unknown) {
    for (const JointId top : cut_at) {
      const std::vector<bool> below = skeleton.subtree(top);
      for (std::size_t j = 0; j < below.size(); ++j) is_no_holder_[j] = is_no_holder_[j] || below[j];
    }
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
      if (!side[f]) other_side_.push_back(FaceId(f));
  }

  std::vector<LoosePart> run() {
    if (islands_.size() < 2 || other_side_.empty()) return {};
    const auto largest =
        std::max_element(islands_.begin(), islands_.end(),
                         [](const Island& a, const Island& b) { return a.faces.size() < b.faces.size(); });
    state_[static_cast<std::size_t>(largest - islands_.begin())] = State::Held;
    for (std::size_t i = 0; i < islands_.size(); ++i) judge_by_joints(i);
    judge_by_distance();
    return report();
  }

 private:
  enum class State : std::uint8_t { Unknown, Held, Loose };

  // Joints that hold the island, and would have to be named too for it to go with the rest.
  std::vector<JointId> holders(const Island& island) const {
    std::vector<JointId> joints;
    for (const auto& [joint, weight] : island.weight)
      if (weight >= kHolds * island.total && !is_no_holder_[joint.index()]) joints.push_back(joint);
    return joints;
  }

  void judge_by_joints(std::size_t i) {
    const Island& island = islands_[i];
    if (state_[i] != State::Unknown) return;
    double own = 0;
    for (const auto& [joint, weight] : island.weight)
      if (!is_no_holder_[joint.index()] && weight >= kMost * weight_of_joint_[joint.index()]) own += weight;
    if (own < kMost * island.total || holders(island).empty())
      state_[i] = State::Held;
    else if (!island.is_whole)
      state_[i] = State::Loose;
  }

  TriangleBvh bvh_of(const std::vector<FaceId>& faces, std::vector<FaceId>& face_of) const {
    std::vector<Triangle> triangles;
    face_of.clear();
    for (const FaceId f : faces) {
      const auto face = mesh_.face(f);
      for (std::size_t k = 1; k + 1 < face.size(); ++k) {
        triangles.push_back({face[0].value, face[k].value, face[k + 1].value});
        face_of.push_back(f);
      }
    }
    return {mesh_.positions, triangles};
  }

  // Mean distance of the island's corners.
  double mean_distance(const Island& island, const TriangleBvh& bvh) const {
    double sum = 0;
    std::size_t count = 0;
    for (const FaceId f : island.faces)
      for (const VertexId v : mesh_.face(f)) sum += bvh.closest(mesh_.positions[v.index()]).distance, ++count;
    return sum / static_cast<double>(count);
  }

  void judge_by_distance() {
    const auto is_unknown = [](State s) { return s == State::Unknown; };
    if (std::none_of(state_.begin(), state_.end(), is_unknown)) return;
    std::vector<FaceId> face_of;
    const TriangleBvh other = bvh_of(other_side_, face_of);
    std::vector<double> to_other(islands_.size(), 0);
    for (std::size_t i = 0; i < islands_.size(); ++i)
      if (is_unknown(state_[i])) to_other[i] = mean_distance(islands_[i], other);
    for (bool grown = true; grown;) {
      grown = false;
      std::vector<FaceId> held;
      for (std::size_t i = 0; i < islands_.size(); ++i)
        if (state_[i] == State::Held)
          held.insert(held.end(), islands_[i].faces.begin(), islands_[i].faces.end());
      const TriangleBvh bvh = bvh_of(held, face_of);
      for (std::size_t i = 0; i < islands_.size(); ++i)
        if (is_unknown(state_[i]) && to_other[i] >= kNearer * mean_distance(islands_[i], bvh))
          state_[i] = State::Held, grown = true;
    }
    std::replace(state_.begin(), state_.end(), State::Unknown, State::Loose);
  }

  std::vector<LoosePart> report() const {
    std::vector<LoosePart> parts;
    std::vector<FaceId> face_of;
    const TriangleBvh other = bvh_of(other_side_, face_of);
    for (std::size_t i = 0; i < islands_.size(); ++i) {
      if (state_[i] != State::Loose) continue;
      const Vec3& where = mesh_.positions[mesh_.face(islands_[i].faces.front())[0].index()];
      const std::int32_t nearest = other.closest(where).triangle;
      parts.push_back({islands_[i].faces.size(), topmost(skeleton_, holders(islands_[i])),
                       nearest < 0 ? FaceId() : face_of[static_cast<std::size_t>(nearest)]});
    }
    return parts;
  }

  const PolygonMesh& mesh_;
  const Skeleton& skeleton_;
  std::vector<Island> islands_;
  std::vector<double> weight_of_joint_;
  std::vector<bool> is_no_holder_;  // per joint: at the cut, above or below it
  std::vector<FaceId> other_side_;
  std::vector<State> state_;
};

}  // namespace

std::vector<LoosePart> loose_parts(const PolygonMesh& mesh, const SkinWeights& weights,
                                   const Skeleton& skeleton, const FaceSet& side,
                                   std::span<const JointId> cut_at) {
  return Search(mesh, weights, skeleton, side, cut_at).run();
}

}  // namespace skinforge
