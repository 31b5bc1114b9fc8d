#include "skeleton/joint_map.h"

#include <algorithm>

#include "base/expect.h"
#include "skeleton/joint_similarity.h"

namespace skinforge {
namespace {

constexpr double kUnusedBonus = 0.5;     // Sec. 5.1: the candidate has not been selected yet
constexpr double kUncertainBonus = 0.1;  // Sec. 5.1: selected, but with confidence below 1
constexpr double kNameBonus = 0.5;       // ours: the same name near the image; joint_map.md
constexpr int kNameHops = 2;

// An unmapped joint beside a mapped one, with its similarity to every result joint.
struct OpenStep {
  MapStep step;
  double mapped_confidence = 0;
  std::vector<double> similarity;  // per result joint
  JointId best;
};

class MapBuilder {
 public:
  MapBuilder(const Skeleton& skeleton, const SkeletonShape& source, const SkeletonShape& result,
             std::span<const std::string> result_names)
      : skeleton_(skeleton),
        source_(source),
        result_(result),
        result_names_(result_names),
        map_(source.size()),
        highest_(result.size(), kUnused) {}

  void assign(JointId joint, JointId image, double confidence);
  JointMap propagate();

 private:
  static constexpr double kUnused = -1;

  std::vector<JointId> neighbours(JointId joint) const;
  void open_around(JointId mapped);
  void choose(OpenStep& open) const;
  double preference(const OpenStep& open, std::size_t candidate) const;
  double confidence(const OpenStep& open) const;

  const Skeleton& skeleton_;
  const SkeletonShape& source_;
  const SkeletonShape& result_;
  std::span<const std::string> result_names_;
  JointMap map_;
  std::vector<double> highest_;  // per result joint: highest confidence it was picked with
  std::vector<OpenStep> open_;
};

void MapBuilder::assign(JointId joint, JointId image, double confidence) {
  map_[joint.index()] = {image, confidence};
  double& highest = highest_[image.index()];
  highest = std::max(highest, confidence);
}

std::vector<JointId> MapBuilder::neighbours(JointId joint) const {
  std::vector<JointId> all;
  if (source_.parent(joint).is_valid()) all.push_back(source_.parent(joint));
  for (std::size_t j = joint.index() + 1; j < source_.size(); ++j)
    if (source_.parent(JointId(j)) == joint) all.push_back(JointId(j));
  return all;
}

double MapBuilder::preference(const OpenStep& open, std::size_t candidate) const {
  double bonus = 0;
  if (highest_[candidate] == kUnused)
    bonus = kUnusedBonus;
  else if (highest_[candidate] < 1)
    bonus = kUncertainBonus;
  const bool near = result_.hops(JointId(candidate), open.step.image) <= kNameHops;
  if (near && skeleton_[open.step.joint].name == result_names_[candidate]) bonus += kNameBonus;
  return open.similarity[candidate] + bonus;
}

void MapBuilder::choose(OpenStep& open) const {
  std::size_t best = 0;
  for (std::size_t c = 1; c < result_.size(); ++c)
    if (preference(open, c) > preference(open, best)) best = c;
  open.best = JointId(best);
}

double MapBuilder::confidence(const OpenStep& open) const {
  return open.mapped_confidence * open.similarity[open.best.index()];  // c * s
}

void MapBuilder::open_around(JointId mapped) {
  for (const JointId joint : neighbours(mapped)) {
    if (map_[joint.index()].image.is_valid()) continue;
    OpenStep open{{joint, mapped, map_[mapped.index()].image}, map_[mapped.index()].confidence, {}, {}};
    for (std::size_t c = 0; c < result_.size(); ++c)
      open.similarity.push_back(joint_similarity(source_, result_, open.step, JointId(c)).score());
    choose(open);
    open_.push_back(std::move(open));
  }
}

JointMap MapBuilder::propagate() {
  for (std::size_t j = 0; j < source_.size(); ++j)
    if (map_[j].image.is_valid()) open_around(JointId(j));
  while (!open_.empty()) {
    std::size_t next = 0;
    for (std::size_t k = 1; k < open_.size(); ++k) {
      const double gain = confidence(open_[k]) - confidence(open_[next]);
      if (gain > 0 || (gain == 0 && open_[k].step.joint < open_[next].step.joint)) next = k;
    }
    const OpenStep step = open_[next];
    const JointId joint = step.step.joint;
    assign(joint, step.best, confidence(step));
    std::erase_if(open_, [&](const OpenStep& open) { return open.step.joint == joint; });
    for (OpenStep& open : open_)
      if (open.best == step.best) choose(open);  // its bonus may be gone
    open_around(joint);
  }
  return std::move(map_);
}

std::vector<std::string> names_in_inputs(std::span<const Skeleton* const> skeletons, const Graft& graft) {
  std::vector<std::string> names;
  for (const JointOrigin& origin : graft.origins)
    names.push_back((*skeletons[graft.sources[origin.source.index()].input])[origin.joint].name);
  return names;
}

}  // namespace

std::vector<JointMap> build_joint_maps(std::span<const Skeleton* const> skeletons, const Graft& graft) {
  const SkeletonShape result(graft.skeleton);
  const std::vector<std::string> result_names = names_in_inputs(skeletons, graft);
  std::vector<JointMap> maps;
  for (std::size_t k = 0; k < graft.sources.size(); ++k) {
    const GraftSource& source = graft.sources[k];
    const Skeleton& skeleton = *skeletons[source.input];
    SF_EXPECT(source.result_joint.size() == skeleton.size());
    const SkeletonShape shape(skeleton, source.model_from_input);
    MapBuilder builder(skeleton, shape, result, result_names);
    bool any = false;
    for (std::size_t j = 0; j < skeleton.size(); ++j)  // Initialization: copies
      if (source.result_joint[j].is_valid()) {
        builder.assign(JointId(j), source.result_joint[j], 1);
        any = true;
      }
    for (const GraftSite& site : graft.sites)  // Initialization: fused pairs
      if (site.kind == GraftKind::Replace && site.fused.is_valid())
        for (const auto& [at_source, joint] : site.at)
          if (at_source == SourceId(k)) {
            builder.assign(joint, site.fused, 1);
            any = true;
          }
    if (!any) builder.assign(shape.root(), result.root(), 0);
    maps.push_back(builder.propagate());
  }
  return maps;
}

}  // namespace skinforge
