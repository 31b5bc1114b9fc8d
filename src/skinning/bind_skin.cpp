#include "skinning/bind_skin.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/expect.h"
#include "geometry/triangle_bvh.h"
#include "geometry/vertex_sets.h"
#include "skinning/harmonic_weights.h"
#include "skinning/welded_surface.h"

namespace skinforge {
namespace {

constexpr double kOutside = 1e-9;  // ours: rounding stays below

// A list of names that stays one line.
std::string some_names(const Skeleton& skeleton, std::span<const JointId> joints) {
  constexpr std::size_t kMost = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(joints.size(), kMost); ++i)
    text += (i ? ", " : "") + skeleton[joints[i]].name;
  return joints.size() > kMost ? text + ", ..." : text;
}

class Binder {
 public:
  Binder(const PolygonMesh& mesh, const Skeleton& skeleton, const BindOptions& options,
         const std::string& place, IssueSink& issues)
      : skeleton_(skeleton),
        options_(options),
        place_(place),
        issues_(issues),
        segments_(bone_segments(skeleton)),
        surface_(weld_surface(mesh.positions, triangulate(mesh).triangles)) {
    drop_movers();
    if (surface_.triangles.empty())
      throw Error(ExitCode::BadInput, place + ": a mesh without faces cannot be bound");
    if (segments_.empty()) throw Error(ExitCode::BadInput, place + ": a skeleton without bones cannot bind");
  }

  BoundSkin bind() {
    if (options_.method == BindMethod::Heat) {
      skin_.handles.resize(surface_.positions.size());
      skin_.weights = bone_heat_weights(surface_.positions, surface_.triangles, segments_, options_.heat);
    } else {
      bind_by_handles();
    }
    tidy();
    return {surface_.spread(skin_.weights), surface_.spread(skin_.handles)};
  }

 private:
  // A root that stands on the ground below the character places it and is no bone of it: joints from the root
  // on whose segments run outside the surface for more than half of their length hold nothing.
  void drop_movers() {
    std::vector<std::array<std::int32_t, 3>> soup;
    for (const VertexTriangle& t : surface_.triangles) soup.push_back({t[0].value, t[1].value, t[2].value});
    const TriangleBvh bvh(surface_.positions, soup);
    std::vector<JointId> movers;
    for (std::size_t j = 0; j < skeleton_.size(); ++j) {
      const JointId joint(j), parent = skeleton_[joint].parent;
      const bool is_below_mover = parent.is_valid() && has_bone(parent) &&
                                  std::find(movers.begin(), movers.end(), parent) == movers.end();
      if (is_below_mover) break;  // parents come first: everything behind hangs under a bone
      if (has_bone(joint) && is_outside(joint, bvh)) movers.push_back(joint);
    }
    const auto moves = [&](const BoneSegment& s) {
      return std::find(movers.begin(), movers.end(), s.joint) != movers.end();
    };
    if (std::all_of(segments_.begin(), segments_.end(), moves)) return;  // a skeleton beside its mesh
    std::erase_if(segments_, moves);
    if (!movers.empty())
      issues_.note(
          "bind-joints-outside", place_,
          fmt::format("{} joints above the first bone inside the surface only place the character: {}",
                      movers.size(), some_names(skeleton_, movers)));
  }
  bool is_outside(JointId joint, const TriangleBvh& bvh) const {
    constexpr int kSamples = 16;
    int outside = 0, count = 0;
    for (const BoneSegment& s : segments_) {
      if (s.joint != joint) continue;
      for (int i = 0; i < kSamples; ++i, ++count)
        outside += bvh.winding_number(s.a + (s.b - s.a) * (i + 0.5) / kSamples) < 0.5 ? 1 : 0;
    }
    return 2 * outside > count;
  }

  void bind_by_handles() {
    SF_EXPECT(options_.handles.empty() || options_.handles.size() == surface_.welded.size());
    skin_.handles = options_.handles.empty()
                        ? handles_by_distance(surface_.positions, segments_, options_.rule)
                        : surface_.weld(options_.handles);
    report_coverage();
    HarmonicWeights harmonic = harmonic_weights(surface_.positions, surface_.triangles, skin_.handles);
    if (harmonic.degenerate > 0)
      issues_.warn("triangles-without-area", place_,
                   fmt::format("{} triangles have no area and count as equilateral", harmonic.degenerate));
    if (harmonic.least < -kOutside || harmonic.largest > 1 + kOutside)
      issues_.warn(
          "bind-weights-clamped", place_,
          fmt::format("weights between {:.3g} and {:.3g} (negative cotangents): clamped to [0, 1] and scaled",
                      harmonic.least, harmonic.largest));
    skin_.weights = std::move(harmonic.weights);
    if (!harmonic.unreached.empty()) go_rigidly(harmonic.unreached);
  }

  void report_coverage() {
    std::vector<JointId> bare;
    for (const HandleCount& count : count_handles(skin_.handles, skeleton_.size()))
      if (count.vertices == 0 && has_bone(count.joint)) bare.push_back(count.joint);
    const bool is_empty =
        std::none_of(skin_.handles.begin(), skin_.handles.end(), [](JointId j) { return j.is_valid(); });
    if (is_empty) throw Error(ExitCode::BadInput, place_ + ": no vertex is held by any bone");
    if (!bare.empty())
      issues_.note("bind-joints-without-handle", place_,
                   fmt::format("{} joints hold no vertex and get no weight: {}", bare.size(),
                               some_names(skeleton_, bare)));
  }
  bool has_bone(JointId joint) const {
    return std::any_of(segments_.begin(), segments_.end(),
                       [&](const BoneSegment& s) { return s.joint == joint; });
  }

  // Every unreached part follows the bone whose distances to its vertices have the least sum.
  void go_rigidly(std::span<const VertexId> unreached) {
    VertexSets sets(surface_.positions.size());
    for (const VertexTriangle& t : surface_.triangles) {
      sets.join(t[0], t[1]);
      sets.join(t[1], t[2]);
    }
    std::vector<std::vector<double>> sums(surface_.positions.size());  // [lowest vertex of a part][segment]
    for (const VertexId v : unreached) {
      auto& sum = sums[sets.find(v).index()];
      sum.resize(segments_.size(), 0.0);
      for (std::size_t k = 0; k < segments_.size(); ++k)
        sum[k] += segments_[k].distance(surface_.positions[v.index()]);
    }
    SkinWeights filled;
    std::size_t parts = 0;
    for (std::size_t v = 0; v < surface_.positions.size(); ++v) {
      const auto row = skin_.weights.of(VertexId(v));
      parts += sums[v].empty() ? 0 : 1;
      if (!row.empty()) {
        filled.push_row(row);
        continue;
      }
      const auto& sum = sums[sets.find(VertexId(v)).index()];
      const auto best = static_cast<std::size_t>(std::min_element(sum.begin(), sum.end()) - sum.begin());
      filled.push_row(std::vector<Influence>{{segments_[best].joint, 1.0}});
    }
    skin_.weights = std::move(filled);
    issues_.warn(
        "bind-parts-rigid", place_,
        fmt::format(
            "{} parts of the surface ({} vertices) have no handle: each follows its nearest bone rigidly",
            parts, unreached.size()));
  }

  void tidy() {
    SkinWeights rows;
    for (std::size_t v = 0; v < skin_.weights.vertex_count(); ++v) {
      std::vector<Influence> row;
      for (Influence influence : skin_.weights.of(VertexId(v))) {
        influence.weight = std::clamp(influence.weight, 0.0, 1.0);
        row.push_back(influence);
      }
      rows.push_row(normalised_row(std::move(row), options_.influences));
    }
    skin_.weights = std::move(rows);
  }

  const Skeleton& skeleton_;
  const BindOptions& options_;
  const std::string& place_;
  IssueSink& issues_;
  std::vector<BoneSegment> segments_;
  WeldedSurface surface_;
  BoundSkin skin_;  ///< by vertex of the surface
};

}  // namespace

BoundSkin bind_skin(const PolygonMesh& mesh, const Skeleton& skeleton, const BindOptions& options,
                    const std::string& place, IssueSink& issues) {
  return Binder(mesh, skeleton, options, place, issues).bind();
}

}  // namespace skinforge
