#include "skeleton/joint_map.h"

#include <gtest/gtest.h>

#include "base/issue.h"
#include "skeletons.h"

namespace skinforge {
namespace {
using namespace testing;

struct Mixed {
  std::vector<Skeleton> inputs;
  std::vector<GraftOperation> operations;
  Graft graft;
  std::vector<JointMap> maps;

  Mixed(std::vector<Skeleton> skeletons, std::vector<GraftOperation> ops)
      : inputs(std::move(skeletons)), operations(std::move(ops)) {
    IssueSink issues;
    std::vector<const Skeleton*> pointers;
    std::vector<std::string> names;
    for (const Skeleton& s : inputs) {
      pointers.push_back(&s);
      names.push_back("input" + std::to_string(names.size()));
    }
    graft = graft_skeletons(pointers, names, 0, operations, issues);
    maps = build_joint_maps(pointers, graft);
  }

  std::string image(std::size_t source, const std::string& joint) const {
    const Skeleton& s = inputs[graft.sources[source].input];
    return graft.skeleton[maps[source][s.find(joint)->index()].image].name;
  }
  double confidence(std::size_t source, const std::string& joint) const {
    const Skeleton& s = inputs[graft.sources[source].input];
    return maps[source][s.find(joint)->index()].confidence;
  }
};

// A body with two arms and two legs; `prefix` tells two of them apart.
Skeleton body(const std::string& prefix) {
  return make_skeleton({{prefix + "Hips"},
                        {prefix + "Spine", 0, Vec3(0, 1, 0)},
                        {prefix + "Neck", 1, Vec3(0, 1, 0)},
                        {prefix + "Head", 2, Vec3(0, 0.5, 0)},
                        {prefix + "ArmL", 1, Vec3(1, 0.8, 0)},
                        {prefix + "HandL", 4, Vec3(1, 0, 0)},
                        {prefix + "ArmR", 1, Vec3(-1, 0.8, 0)},
                        {prefix + "HandR", 6, Vec3(-1, 0, 0)},
                        {prefix + "LegL", 0, Vec3(0.5, -1, 0)},
                        {prefix + "FootL", 8, Vec3(0, -1, 0.2)},
                        {prefix + "LegR", 0, Vec3(-0.5, -1, 0)},
                        {prefix + "FootR", 10, Vec3(0, -1, 0.2)}});
}

GraftOperation replace(std::vector<std::string> at, std::string joint) {
  return {GraftKind::Replace, std::move(at), 1, std::move(joint), {}};
}

// Initialization (Sec. 5): copies and the fused pair have confidence one.
TEST(JointMap, CopiesAndFusedPairsAreCertain) {
  const Mixed s({body("a"), body("b")}, {replace({"aSpine"}, "bSpine")});
  EXPECT_EQ(s.image(0, "aHips"), "aHips");
  EXPECT_EQ(s.image(0, "aSpine"), "bSpine");
  EXPECT_EQ(s.confidence(0, "aSpine"), 1);
  EXPECT_EQ(s.image(1, "bHandL"), "bHandL");
  EXPECT_EQ(s.confidence(1, "bHandL"), 1);
}

// Law: between equal bodies with different names every joint finds its twin, less surely the further away.
TEST(JointMap, EqualBodiesFindTheirTwins) {
  const Mixed s({body("a"), body("b")}, {replace({"aSpine"}, "bSpine")});
  for (const char* joint : {"Neck", "Head", "ArmL", "HandL", "ArmR", "HandR"})
    EXPECT_EQ(s.image(0, std::string("a") + joint), std::string("b") + joint);
  for (const char* joint : {"Hips", "LegL", "FootL", "LegR", "FootR"})
    EXPECT_EQ(s.image(1, std::string("b") + joint), std::string("a") + joint);
  EXPECT_GT(s.confidence(0, "aNeck"), 0.9);
}

// Law: every joint has an image, of confidence in [0, 1]; where it is below 1, a neighbour is at least as
// sure.
TEST(JointMap, ConfidenceFallsAwayFromTheJunction) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    const Mixed s({random_skeleton(25, seed, "h"), random_skeleton(30, seed + 50, "d")},
                  {replace({"h12"}, "d9"), {GraftKind::Attach, {"h3"}, 1, "d20", {}}});
    for (std::size_t k = 0; k < s.maps.size(); ++k) {
      const Skeleton& skeleton = s.inputs[s.graft.sources[k].input];
      std::vector<double> best_neighbour(skeleton.size(), 0.0);
      for (std::size_t j = 1; j < skeleton.size(); ++j) {
        const std::size_t parent = skeleton.joints[j].parent.index();
        best_neighbour[j] = std::max(best_neighbour[j], s.maps[k][parent].confidence);
        best_neighbour[parent] = std::max(best_neighbour[parent], s.maps[k][j].confidence);
      }
      for (std::size_t j = 0; j < skeleton.size(); ++j) {
        const MappedJoint& m = s.maps[k][j];
        EXPECT_TRUE(m.image.is_valid() && m.image.index() < s.graft.skeleton.size());
        EXPECT_TRUE(m.confidence >= 0 && m.confidence <= 1) << m.confidence;
        if (m.confidence < 1) {
          EXPECT_LE(m.confidence, best_neighbour[j]);
        }
      }
    }
  }
}

// Law: moving and scaling both placed inputs alike changes nothing.
TEST(JointMap, UnchangedByScaleOfEverything) {
  const Skeleton host = random_skeleton(25, 7, "h"), donor = random_skeleton(30, 8, "d");
  Skeleton large_host = host, large_donor = donor;
  for (Skeleton* s : {&large_host, &large_donor}) {
    for (Joint& joint : s->joints) joint.bind.translation *= 100;
    const auto placed = model_from_joint(*s, bind_pose(*s));
    for (std::size_t j = 0; j < s->size(); ++j) s->joints[j].joint_from_model = placed[j].inverse();
  }
  const Mixed small({host, donor}, {replace({"h12"}, "d9")});
  const Mixed large({large_host, large_donor}, {replace({"h12"}, "d9")});
  for (std::size_t k = 0; k < small.maps.size(); ++k)
    for (std::size_t j = 0; j < small.maps[k].size(); ++j)
      EXPECT_EQ(small.maps[k][j].image, large.maps[k][j].image);
}

// A base of which nothing is left still gets a map, of no confidence.
TEST(JointMap, NothingLeftOfASource) {
  const Mixed s({body("a"), body("b")}, {{GraftKind::Attach, {"aSpine"}, 1, "bSpine", {}},
                                         {GraftKind::Detach, {"bSpine"}, 0, "", {}}});
  for (const MappedJoint& m : s.maps[0]) {
    EXPECT_TRUE(m.image.is_valid());
    EXPECT_EQ(m.confidence, 0);
  }
}

}  // namespace
}  // namespace skinforge
