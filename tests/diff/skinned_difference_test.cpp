#include "diff/skinned_difference.h"

#include <gtest/gtest.h>

#include <random>

#include "diff/character_diff.h"
#include "skinning/linear_blend.h"
#include "testing/toy_character.h"

namespace skinforge {
namespace {
constexpr double kRounding = 1e-12;  // some hundred products in double

// A cloud of points on a chain of joints, two influences each; seeded.
Character cloud(std::size_t vertices, std::size_t joints, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0, 1);
  Character c;
  for (std::size_t j = 0; j < joints; ++j) {
    Joint joint;
    joint.name = "j" + std::to_string(j);
    if (j > 0) joint.parent = JointId(j - 1);
    c.skeleton.joints.push_back(joint);
  }
  for (std::size_t v = 0; v < vertices; ++v) {
    c.mesh.positions.push_back({share(random), share(random), share(random)});
    const auto first = static_cast<std::size_t>(share(random) * double(joints - 1));
    const double weight = share(random);
    if (v % 50 == 0)
      c.weights.push_row(std::vector<Influence>{});
    else
      c.weights.push_row(std::vector<Influence>{{JointId(first), weight}, {JointId(first + 1), 1 - weight}});
  }
  return c;
}

std::vector<Affine3> palette(std::size_t joints, std::mt19937& random, double size) {
  std::uniform_real_distribution<double> part(-size, size);
  std::vector<Affine3> maps;
  for (std::size_t j = 0; j < joints; ++j) {
    Affine3 m = Affine3::Identity();
    m.translate(Vec3(part(random), part(random), part(random)));
    m.rotate(Eigen::AngleAxisd(part(random), Vec3(part(random), 1, part(random)).normalized()));
    maps.push_back(m);
  }
  return maps;
}

struct Plain {
  double sum = 0, largest = 0;
  VertexId vertex;
};

// Every vertex, posed on both sides.
Plain plain(const Character& a, const Character& b, const Correspondence& same,
            const std::vector<Affine3>& of_a, const std::vector<Affine3>& of_b) {
  const auto at_a = linear_blend(a.mesh.positions, a.weights, of_a);
  const auto at_b = linear_blend(b.mesh.positions, b.weights, of_b);
  Plain found;
  for (std::size_t v = 0; v < same.vertices.size(); ++v) {
    if (!same.vertices[v].is_valid()) continue;
    const double square = (at_a[v] - at_b[same.vertices[v].index()]).squaredNorm();
    found.sum += square;
    if (square <= found.largest) continue;
    found.largest = square;
    found.vertex = VertexId(v);
  }
  return found;
}

// By hand: one vertex at (1, 0, 0) on one joint that B moves by 0.5: 0.25, and 0.25 is not above 0.25.
TEST(SkinnedDifference, OfOneVertex) {
  Character a;
  Joint root;
  root.name = "root";
  a.skeleton.joints = {root};
  a.mesh.positions = {Vec3(1, 0, 0)};
  a.weights.push_row(std::vector<Influence>{{JointId(0), 1}});
  const Correspondence same{{JointId(0)}, {VertexId(0)}};
  const SkinnedDifference difference(a, a, same);
  const std::vector<Affine3> rest{Affine3::Identity()}, moved{Affine3(Eigen::Translation3d(0, 0.5, 0))};
  const SkinnedDifference::Frame frame(difference, rest, moved);
  EXPECT_NEAR(frame.sum_of_squares(), 0.25, kRounding);
  ASSERT_TRUE(frame.largest_above(0));
  EXPECT_EQ(frame.largest_above(0)->square, 0.25);
  EXPECT_FALSE(frame.largest_above(0.25));
  EXPECT_FALSE(SkinnedDifference::Frame(difference, moved, moved).largest_above(0));
}

// Law: the same vertex and the same bits as posing all, whatever moves: whole poses, one joint, weights,
// places, joints that only one side has.
TEST(SkinnedDifference, IsThatOfPosingEveryVertex) {
  constexpr std::size_t kVertices = 3000, kJoints = 12;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(-1e-4, 1e-4);
  for (const bool is_changed : {false, true}) {
    const Character a = cloud(kVertices, kJoints, 1);
    Character b = a;
    Correspondence same;
    for (std::size_t j = 0; j < kJoints; ++j) same.joints.push_back(JointId(j));
    for (std::size_t v = 0; v < kVertices; ++v) same.vertices.push_back(VertexId(v));
    if (is_changed) {
      for (Vec3& p : b.mesh.positions) p += Vec3(share(random), share(random), share(random));
      for (Influence& i : b.weights.influences) i.weight += share(random);
      same.joints[3] = JointId();
      same.vertices[5] = same.vertices[77] = VertexId();
    }
    const SkinnedDifference difference(a, b, same);
    for (const double size : {1.0, 1e-3, 0.0}) {
      const auto of_a = palette(kJoints, random, 1);
      auto of_b = of_a;
      const auto change = palette(kJoints, random, size);
      for (std::size_t j = 0; j < kJoints; ++j) of_b[j] = change[j] * of_b[j];
      const SkinnedDifference::Frame frame(difference, of_a, of_b);
      const Plain wanted = plain(a, b, same, of_a, of_b);
      EXPECT_NEAR(frame.sum_of_squares(), wanted.sum, kRounding * (1 + wanted.sum));
      if (wanted.largest < 1e-28) continue;  // rounding of the same pose
      for (const double least : {0.0, wanted.largest / 2}) {
        const auto found = frame.largest_above(least);
        ASSERT_TRUE(found) << size;
        EXPECT_EQ(found->square, wanted.largest) << size;
        EXPECT_EQ(found->vertex, wanted.vertex) << size;
      }
      EXPECT_FALSE(frame.largest_above(wanted.largest));
    }
  }
}

// Law: asking for every vertex changes nothing else. The toy has morph targets and is posed vertex by vertex.
TEST(SkinnedDifference, VerticesAreExtra) {
  Character a = testing::ToyCharacter::make();
  for (const bool has_morphs : {true, false}) {
    if (!has_morphs) {
      a.morphs.clear();
      for (Clip& clip : a.clips) clip.morphs.clear();
    }
    Character b = a;
    for (Clip& clip : b.clips)
      for (JointTracks& tracks : clip.joints)
        for (Quat& q : tracks.rotation.values) q = q * Quat(Eigen::AngleAxisd(0.01, Vec3::UnitX()));
    const CharacterDiff without = compare_characters(a, b),
                        with = compare_characters(a, b, {.wants_vertices = true});
    ASSERT_EQ(without.clips.size(), 3U);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(without.clips[c].max, with.clips[c].max);
      EXPECT_EQ(without.clips[c].rms, with.clips[c].rms);
      EXPECT_EQ(without.clips[c].time, with.clips[c].time);
      const auto& all = with.clips[c].vertex_max;
      ASSERT_FALSE(all.empty());
      EXPECT_FLOAT_EQ(*std::max_element(all.begin(), all.end()), static_cast<float>(with.clips[c].max));
      EXPECT_EQ(without.clips[c].vertex_max.empty(), !has_morphs);
    }
  }
}
}  // namespace
}  // namespace skinforge
