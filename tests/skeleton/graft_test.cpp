#include "skeleton/graft.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/issue.h"
#include "skeletons.h"

namespace skinforge {
namespace {
using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
constexpr double kRounding = 1e-10;  // chains of a dozen random, scaled transforms and one inverse

const std::vector<std::string> kNames = {"horse", "man"};
const Similarity kPlacement{0.5, Quat(Eigen::AngleAxisd(radians(-90), Vec3::UnitY())), Vec3(1, 2, 3)};

GraftOperation operation(GraftKind kind, std::vector<std::string> at, std::string joint = {}) {
  return {kind, std::move(at), 1, std::move(joint), kind == GraftKind::Remove ? Similarity{} : kPlacement};
}

Graft run(const Skeleton& host, const Skeleton& donor, const std::vector<GraftOperation>& operations) {
  IssueSink issues;
  const std::vector<const Skeleton*> skeletons = {&host, &donor};
  Graft graft = graft_skeletons(skeletons, kNames, 0, operations, issues);
  EXPECT_TRUE(issues.issues().empty());
  return graft;
}

std::string error_of(const Skeleton& host, const std::vector<GraftOperation>& operations) {
  try {
    run(host, straight_chain(3), operations);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::Usage);
    return error.what();
  }
  return "no error";
}

// Each joint of the result stands where its source joint stands once placed, and skins the placed mesh
// unchanged.
void expect_placed(const Graft& graft, const std::vector<const Skeleton*>& skeletons) {
  const auto placed = model_from_joint(graft.skeleton, bind_pose(graft.skeleton));
  const auto palette = skinning_palette(graft.skeleton, bind_pose(graft.skeleton));
  for (std::size_t j = 0; j < placed.size(); ++j) {
    const JointOrigin& origin = graft.origins[j];
    const GraftSource& source = graft.sources[origin.source.index()];
    const Skeleton& input = *skeletons[source.input];
    const Affine3 expected =
        source.model_from_input.matrix() * model_from_joint(input, bind_pose(input))[origin.joint.index()];
    EXPECT_LT(difference(placed[j], expected), kRounding) << graft.skeleton.joints[j].name;
    EXPECT_LT(difference(palette[j], Affine3::Identity()), kRounding) << graft.skeleton.joints[j].name;
    EXPECT_EQ(source.result_joint[origin.joint.index()], JointId(j));
    EXPECT_LT(graft.skeleton.joints[j].parent, JointId(j));
  }
}

Skeleton small_host() {
  return make_skeleton({{"Hips"},
                        {"Spine", 0, Vec3(0, 1, 0)},
                        {"Head", 1, Vec3(0, 1, 0)},
                        {"LegL", 0, Vec3(1, -1, 0)},
                        {"LegR", 0, Vec3(-1, -1, 0)}});
}
Skeleton small_donor() {
  return make_skeleton({{"Hips"}, {"Tail", 0, Vec3(0, 0, -1)}, {"Head", 1, Vec3(0, 0, -1)}});
}

TEST(Graft, ReplaceByHand) {
  const Graft graft = run(small_host(), small_donor(), {operation(GraftKind::Replace, {"Spine"}, "Tail")});
  EXPECT_THAT(graft.skeleton.names(), ElementsAre("Hips", "LegL", "LegR", "Tail", "Head"));
  EXPECT_EQ(graft.skeleton.joints[3].parent, JointId(0));
  // P * (0,0,-1): turned by -90 degrees about y it is (1,0,0); halved and moved: (1.5,2,3).
  EXPECT_THAT(graft.skeleton.joints[3].bind.translation, IsNearVec(Vec3(1.5, 2, 3), kRounding));
  EXPECT_NEAR(graft.skeleton.joints[3].bind.scale.x(), 0.5, kRounding);
  ASSERT_EQ(graft.sites.size(), 1u);
  const GraftSite& site = graft.sites[0];
  EXPECT_EQ(site.fused, JointId(3));
  EXPECT_EQ(site.host, SourceId(0));
  EXPECT_EQ(site.donor, SourceId(1));
  using Pair = std::pair<SourceId, JointId>;
  EXPECT_THAT(site.removed, ElementsAre(Pair{SourceId(0), JointId(1)}, Pair{SourceId(0), JointId(2)}));
  EXPECT_THAT(site.at, ElementsAre(Pair{SourceId(0), JointId(1)}));
}

TEST(Graft, SeveralTargetsHangUnderTheirCommonAncestor) {
  const Graft graft =
      run(small_host(), small_donor(), {operation(GraftKind::Replace, {"LegL", "LegR"}, "Tail")});
  EXPECT_THAT(graft.skeleton.names(), ElementsAre("Hips", "Spine", "Head", "Tail", "man_Head"));
  EXPECT_EQ(graft.skeleton.joints[3].parent, JointId(0));
  const Graft deep =
      run(small_host(), small_donor(), {operation(GraftKind::Replace, {"Head", "LegR"}, "Tail")});
  EXPECT_EQ(deep.skeleton[deep.sites[0].fused].parent, JointId(0));
}

TEST(Graft, TakenNamesGetTheInputInFront) {
  const auto attach = operation(GraftKind::Attach, {"Spine"}, "Tail");
  const Graft graft = run(small_host(), small_donor(), {attach, attach});
  EXPECT_THAT(graft.skeleton.names(), ElementsAre("Hips", "Spine", "Head", "LegL", "LegR", "Tail", "man_Head",
                                                  "man_Tail", "man_Head_2"));
  EXPECT_EQ(graft.sources.size(), 3u);  // an input used twice is two sources
}

TEST(Graft, RemoveAndDetach) {
  const Graft removed = run(small_host(), small_donor(), {operation(GraftKind::Remove, {"Spine", "LegL"})});
  EXPECT_THAT(removed.skeleton.names(), ElementsAre("Hips", "LegR"));
  EXPECT_FALSE(removed.sites[0].fused.is_valid());
  const Graft detached = run(small_host(), small_donor(), {operation(GraftKind::Detach, {"Spine"})});
  EXPECT_THAT(detached.skeleton.names(), ElementsAre("Spine", "Head"));
  EXPECT_FALSE(detached.skeleton.joints[0].parent.is_valid());
  EXPECT_EQ(detached.sites[0].fused, JointId(0));
  EXPECT_EQ(detached.sites[0].removed.size(), 3u);
}

TEST(Graft, LaterOperationsSeeWhatEarlierOnesLeft) {
  const Graft graft = run(small_host(), small_donor(),
                          {operation(GraftKind::Replace, {"Spine"}, "Tail"),
                           operation(GraftKind::Remove, {"Head"}), operation(GraftKind::Remove, {"LegL"})});
  EXPECT_THAT(graft.skeleton.names(), ElementsAre("Hips", "LegR", "Tail"));
  EXPECT_EQ(graft.sites[0].fused, JointId(2));  // follows the joint to its new place
  EXPECT_EQ(graft.sites[1].host, SourceId(1));  // the Head that was left is the donor's
  EXPECT_FALSE(graft.sources[1].result_joint[2].is_valid());
}

// Laws on random trees with scaled joints: bind poses are the placed ones, whatever was done.
TEST(Graft, BindPosesStayPlaced) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    const Skeleton host = random_skeleton(14, seed, "h");
    const Skeleton donor = random_skeleton(12, seed + 100, "d");
    const Graft graft =
        run(host, donor,
            {operation(GraftKind::Replace, {"h9", "h7"}, "d3"), operation(GraftKind::Attach, {"h1"}, "d1"),
             operation(GraftKind::Attach, {"h2"}, "d0")});
    expect_placed(graft, {&host, &donor});
    const Graft part =
        run(host, donor, {operation(GraftKind::Attach, {"h4"}, "d2"), operation(GraftKind::Detach, {"h4"})});
    expect_placed(part, {&host, &donor});
    const Graft inner =
        run(host, donor, {operation(GraftKind::Attach, {"h4"}, "d2"), operation(GraftKind::Detach, {"d2"})});
    expect_placed(inner, {&host, &donor});
  }
}

// Law: what the operations do not touch keeps every bit.
TEST(Graft, UntouchedJointsKeepEveryBit) {
  const Skeleton host = random_skeleton(14, 5, "h");
  const Skeleton donor = random_skeleton(12, 6, "d");
  const Graft graft = run(host, donor, {operation(GraftKind::Replace, {"h9"}, "d3")});
  for (std::size_t j = 0; j < graft.skeleton.size(); ++j) {
    const JointOrigin& origin = graft.origins[j];
    const Joint& joint = graft.skeleton.joints[j];
    const Joint& source = (origin.source == SourceId(0) ? host : donor)[origin.joint];
    if (JointId(j) == graft.sites[0].fused) continue;
    EXPECT_EQ(joint.bind.translation, source.bind.translation);
    EXPECT_EQ(joint.bind.rotation.coeffs(), source.bind.rotation.coeffs());
    EXPECT_EQ(joint.bind.scale, source.bind.scale);
    EXPECT_TRUE(origin.change.is_identity());
    if (origin.source == SourceId(0)) {
      EXPECT_EQ(joint.joint_from_model.matrix(), source.joint_from_model.matrix());
    }
  }
}

// Law: parent_from_joint(result) = change * parent_from_joint(source), also for a mirrored parent.
TEST(Graft, ChangeGivesTheBindTransform) {
  Skeleton donor =
      make_skeleton({{"root", -1, Vec3(1, 0, 0), Quat::Identity(), -1}, {"wing", 0, Vec3(0, 2, 0)}});
  const Skeleton host = small_host();
  const Graft graft = run(host, donor, {operation(GraftKind::Attach, {"Spine"}, "wing")});
  const JointId fused = graft.sites[0].fused;
  const Similarity& change = graft.origins[fused.index()].change;
  EXPECT_LT(change.scale, 0);
  EXPECT_LT(difference(graft.skeleton[fused].bind.matrix(), change.matrix() * donor.joints[1].bind.matrix()),
            kRounding);
  expect_placed(graft, {&host, &donor});
}

TEST(Graft, StretchedParentIsWarnedAbout) {
  Skeleton host = small_host();
  host.joints[1].bind.scale = Vec3(1, 2, 1);
  const Skeleton donor = small_donor();
  const std::vector<const Skeleton*> skeletons = {&host, &donor};
  IssueSink issues;
  graft_skeletons(skeletons, kNames, 0, std::vector{operation(GraftKind::Attach, {"Spine"}, "Tail")}, issues);
  ASSERT_EQ(issues.issues().size(), 1u);
  EXPECT_EQ(issues.issues()[0].code, "graft-scale-not-uniform");
}

TEST(Graft, RefusalsNameJointAndOperation) {
  EXPECT_THAT(error_of(small_host(), {operation(GraftKind::Replace, {"Spin"}, "j1")}),
              ::testing::AllOf(HasSubstr("op 1"), HasSubstr("\"Spin\""), HasSubstr("\"Spine\"")));
  EXPECT_THAT(error_of(small_host(), {operation(GraftKind::Replace, {"Spine"}, "j9")}),
              HasSubstr("input \"man\""));
  EXPECT_THAT(error_of(small_host(), {operation(GraftKind::Replace, {"Hips"}, "j1")}), HasSubstr("root"));
  EXPECT_THAT(error_of(small_host(), {operation(GraftKind::Remove, {"Hips"})}), HasSubstr("root"));
  EXPECT_THAT(error_of(small_host(), {operation(GraftKind::Detach, {"LegL", "LegR"})}),
              HasSubstr("one joint"));
  EXPECT_THAT(error_of(small_host(),
                       {operation(GraftKind::Remove, {"Spine"}), operation(GraftKind::Remove, {"Head"})}),
              ::testing::AllOf(HasSubstr("op 2"), HasSubstr("left")));
}

}  // namespace
}  // namespace skinforge
