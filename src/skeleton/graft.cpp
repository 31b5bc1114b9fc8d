#include "skeleton/graft.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "base/expect.h"
#include "base/issue.h"
#include "base/text.h"
#include "skeleton/pose.h"

namespace skinforge {
namespace {

constexpr double kUniform = 1e-4;  // ours: relative; float files carry 1e-6, a real stretch is above 1e-2

struct NearestSimilarity {
  Similarity similarity;
  double error = 0;  ///< relative, Frobenius norm of what is lost
};

// The similarity nearest to an affine map (polar decomposition); a mirroring map gets a negative scale.
NearestSimilarity nearest_similarity(const Affine3& map) {
  const Mat3 linear = map.linear();
  const double sign = linear.determinant() < 0 ? -1 : 1;
  const Eigen::JacobiSVD<Mat3> svd(sign * linear, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Mat3 rotation = svd.matrixU() * svd.matrixV().transpose();
  const double scale = sign * svd.singularValues().mean();
  const double norm = linear.norm();
  const double error = norm > 0 ? (linear - scale * rotation).norm() / norm : 0;
  return {{scale, Quat(rotation).normalized(), map.translation()}, error};
}

std::vector<bool> all_but(std::vector<bool> marked) {
  marked.flip();
  return marked;
}

// The character as it stands between operations.
class GraftBuilder {
 public:
  GraftBuilder(std::span<const Skeleton* const> skeletons, std::span<const std::string> input_names,
               IssueSink& issues)
      : skeletons_(skeletons), input_names_(input_names), issues_(issues) {}

  void start(std::size_t base);
  void run(const GraftOperation& operation);
  Graft finish();

 private:
  JointId joint_of_result(const std::string& name) const;
  JointId joint_of_input(std::size_t input, const std::string& name) const;
  std::vector<JointId> target_joints(const GraftOperation& operation) const;
  void refuse_root(std::span<const JointId> at, const char* verb) const;
  JointId common_parent(std::span<const JointId> at) const;
  std::vector<bool> below_any(std::span<const JointId> tops) const;
  GraftSite open_site(const GraftOperation& operation, std::span<const JointId> at) const;
  std::vector<JointId> cut(const std::vector<bool>& goes, GraftSite& site);
  void make_root(JointId top);
  void graft(const GraftOperation& operation, JointId parent, GraftSite& site);
  Similarity change_of_top(const GraftOperation& operation, JointId top, JointId parent) const;
  Similarity similarity_or_warning(const Affine3& map, const std::string& joint) const;
  std::string free_name(const std::string& name, std::size_t input) const;

  std::span<const Skeleton* const> skeletons_;
  std::span<const std::string> input_names_;
  IssueSink& issues_;
  Graft result_;
};

void GraftBuilder::start(std::size_t base) {
  result_.skeleton = *skeletons_[base];
  for (std::size_t j = 0; j < result_.skeleton.size(); ++j)
    result_.origins.push_back({SourceId(0), JointId(j), {}});
  result_.sources.push_back({base, {}, {}});
}

void GraftBuilder::run(const GraftOperation& operation) {
  const std::vector<JointId> at = target_joints(operation);
  GraftSite site = open_site(operation, at);
  switch (operation.kind) {
    case GraftKind::Attach:
      graft(operation, at.front(), site);
      break;
    case GraftKind::Replace: {
      refuse_root(at, "replace");
      const JointId parent = common_parent(at);
      graft(operation, cut(below_any(at), site)[parent.index()], site);
      break;
    }
    case GraftKind::Remove:
      refuse_root(at, "remove");
      cut(below_any(at), site);
      break;
    case GraftKind::Detach:
      make_root(at.front());
      site.fused = cut(all_but(below_any(at)), site)[at.front().index()];
      break;
  }
  result_.sites.push_back(std::move(site));
}

std::vector<JointId> GraftBuilder::target_joints(const GraftOperation& operation) const {
  std::vector<JointId> at;
  for (const std::string& name : operation.at) {
    const JointId joint = joint_of_result(name);
    if (std::find(at.begin(), at.end(), joint) == at.end()) at.push_back(joint);
  }
  if (at.empty()) throw Error(ExitCode::Usage, "no joint to operate at");
  const bool one_only = operation.kind == GraftKind::Detach || operation.kind == GraftKind::Attach;
  if (one_only && at.size() > 1)
    throw Error(ExitCode::Usage,
                fmt::format("{} takes one joint, not {}",
                            operation.kind == GraftKind::Detach ? "detach" : "attach", at.size()));
  return at;
}

JointId GraftBuilder::joint_of_result(const std::string& name) const {
  if (const auto joint = result_.skeleton.find(name)) return *joint;
  const bool was_there =
      std::any_of(result_.sources.begin(), result_.sources.end(),
                  [&](const GraftSource& s) { return skeletons_[s.input]->find(name).has_value(); });
  throw Error(ExitCode::Usage,
              fmt::format("no joint \"{}\" {}{}", name,
                          was_there ? "left in the character at this point" : "in the character",
                          nearest_hint(name, result_.skeleton.names())));
}

JointId GraftBuilder::joint_of_input(std::size_t input, const std::string& name) const {
  SF_EXPECT(input < skeletons_.size());
  if (const auto joint = skeletons_[input]->find(name)) return *joint;
  throw Error(ExitCode::Usage, fmt::format("no joint \"{}\" in input \"{}\"{}", name, input_names_[input],
                                           nearest_hint(name, skeletons_[input]->names())));
}

void GraftBuilder::refuse_root(std::span<const JointId> at, const char* verb) const {
  for (const JointId joint : at)
    if (!result_.skeleton[joint].parent.is_valid())
      throw Error(ExitCode::Usage, fmt::format("cannot {} the root joint \"{}\": nothing would be left", verb,
                                               result_.skeleton[joint].name));
}

JointId GraftBuilder::common_parent(std::span<const JointId> at) const {
  const Skeleton& s = result_.skeleton;
  JointId common = s[at.front()].parent;
  for (JointId other : at) {
    other = s[other].parent;
    while (common != other) {
      JointId& later = common > other ? common : other;  // parents stand before their children
      later = s[later].parent;
    }
  }
  return common;
}

std::vector<bool> GraftBuilder::below_any(std::span<const JointId> tops) const {
  std::vector<bool> inside(result_.skeleton.size(), false);
  for (const JointId top : tops) {
    const std::vector<bool> one = result_.skeleton.subtree(top);
    for (std::size_t j = 0; j < inside.size(); ++j) inside[j] = inside[j] || one[j];
  }
  return inside;
}

GraftSite GraftBuilder::open_site(const GraftOperation& operation, std::span<const JointId> at) const {
  GraftSite site;
  site.kind = operation.kind;
  site.host = result_.origins[at.front().index()].source;
  for (const JointId joint : at) {
    const JointOrigin& origin = result_.origins[joint.index()];
    site.at.push_back({origin.source, origin.joint});
    const JointId parent = result_.skeleton[joint].parent;
    if (!parent.is_valid()) continue;
    const std::pair above{result_.origins[parent.index()].source, result_.origins[parent.index()].joint};
    if (std::find(site.parents.begin(), site.parents.end(), above) == site.parents.end())
      site.parents.push_back(above);
  }
  return site;
}

// Takes the marked joints out; the order of the others stays. Returns the new id of each joint; ids kept in
// earlier sites follow.
std::vector<JointId> GraftBuilder::cut(const std::vector<bool>& goes, GraftSite& site) {
  std::vector<JointId> now(goes.size());
  std::vector<Joint> joints;
  std::vector<JointOrigin> origins;
  for (std::size_t j = 0; j < goes.size(); ++j) {
    const JointOrigin& origin = result_.origins[j];
    if (goes[j]) {
      site.removed.push_back({origin.source, origin.joint});
      continue;
    }
    now[j] = JointId(joints.size());
    joints.push_back(result_.skeleton.joints[j]);
    origins.push_back(origin);
    JointId& parent = joints.back().parent;
    if (parent.is_valid()) parent = now[parent.index()];
  }
  result_.skeleton.joints = std::move(joints);
  result_.origins = std::move(origins);
  for (GraftSite& earlier : result_.sites)
    if (earlier.fused.is_valid()) earlier.fused = now[earlier.fused.index()];
  return now;
}

// The joint keeps its place in the model without its parent.
void GraftBuilder::make_root(JointId top) {
  Joint& joint = result_.skeleton[top];
  if (!joint.parent.is_valid()) return;
  const auto placed = model_from_joint(result_.skeleton, bind_pose(result_.skeleton));
  const Affine3 model_from_parent = placed[joint.parent.index()];
  JointOrigin& origin = result_.origins[top.index()];
  origin.change = similarity_or_warning(model_from_parent * origin.change.matrix(), joint.name);
  joint.bind = premultiplied(
      origin.change,
      skeletons_[result_.sources[origin.source.index()].input]->joints[origin.joint.index()].bind);
  joint.parent = JointId();
}

// Hangs the placed sub-tree of the operation's input under `parent`, as a source of its own.
void GraftBuilder::graft(const GraftOperation& operation, JointId parent, GraftSite& site) {
  const JointId top = joint_of_input(operation.input, operation.joint);
  const Skeleton& donor = *skeletons_[operation.input];
  const Similarity change = change_of_top(operation, top, parent);
  const Affine3 input_from_model = operation.model_from_input.matrix().inverse();
  const std::vector<bool> comes = donor.subtree(top);
  site.donor = SourceId(result_.sources.size());
  result_.sources.push_back({operation.input, operation.model_from_input, {}});

  std::vector<JointId> copy(donor.size());
  for (std::size_t j = top.index(); j < donor.size(); ++j) {
    if (!comes[j]) continue;
    const bool is_top = j == top.index();
    copy[j] = JointId(result_.skeleton.size());
    Joint joint = donor.joints[j];
    joint.name = free_name(joint.name, operation.input);
    joint.parent = is_top ? parent : copy[joint.parent.index()];
    if (is_top) joint.bind = premultiplied(change, joint.bind);
    joint.joint_from_model = joint.joint_from_model * input_from_model;
    result_.skeleton.joints.push_back(std::move(joint));
    result_.origins.push_back({site.donor, JointId(j), is_top ? change : Similarity{}});
  }
  site.fused = copy[top.index()];
}

// change = B'(parent)^-1 * P * B(parent of the top in its input), graft.h.
Similarity GraftBuilder::change_of_top(const GraftOperation& operation, JointId top, JointId parent) const {
  const Skeleton& donor = *skeletons_[operation.input];
  const Affine3 model_from_parent =
      model_from_joint(result_.skeleton, bind_pose(result_.skeleton))[parent.index()];
  Affine3 map = model_from_parent.inverse() * operation.model_from_input.matrix();
  const JointId donor_parent = donor[top].parent;
  if (donor_parent.is_valid()) map = map * model_from_joint(donor, bind_pose(donor))[donor_parent.index()];
  return similarity_or_warning(map, operation.joint);
}

Similarity GraftBuilder::similarity_or_warning(const Affine3& map, const std::string& joint) const {
  const NearestSimilarity nearest = nearest_similarity(map);
  if (nearest.error > kUniform)
    issues_.warn(
        "graft-scale-not-uniform", fmt::format("joint {}", joint),
        fmt::format("a parent of this joint is stretched; its placement is the nearest one without shear "
                    "(relative error {:.3g})",
                    nearest.error));
  return nearest.similarity;
}

std::string GraftBuilder::free_name(const std::string& name, std::size_t input) const {
  const Skeleton& taken = result_.skeleton;
  if (!taken.find(name)) return name;
  const std::string prefixed = input_names_[input] + "_" + name;
  std::string candidate = prefixed;
  for (int n = 2; taken.find(candidate); ++n) candidate = fmt::format("{}_{}", prefixed, n);
  return candidate;
}

Graft GraftBuilder::finish() {
  for (GraftSource& source : result_.sources)
    source.result_joint.assign(skeletons_[source.input]->size(), JointId());
  for (std::size_t j = 0; j < result_.origins.size(); ++j) {
    const JointOrigin& origin = result_.origins[j];
    result_.sources[origin.source.index()].result_joint[origin.joint.index()] = JointId(j);
  }
  return std::move(result_);
}

}  // namespace

Graft graft_skeletons(std::span<const Skeleton* const> skeletons, std::span<const std::string> input_names,
                      std::size_t base, std::span<const GraftOperation> operations, IssueSink& issues) {
  SF_EXPECT(skeletons.size() == input_names.size() && base < skeletons.size());
  GraftBuilder builder(skeletons, input_names, issues);
  builder.start(base);
  for (std::size_t k = 0; k < operations.size(); ++k)
    with_context(fmt::format("op {}", k + 1), [&] { builder.run(operations[k]); });
  return builder.finish();
}

}  // namespace skinforge
