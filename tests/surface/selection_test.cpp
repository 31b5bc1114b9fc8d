#include "surface/selection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "surface/junction_scene.h"

namespace skinforge {
namespace {

constexpr int kAround = 8;
constexpr double kRounding = 1e-12;  // sums of a few weights

// An open tube: each ring has that weight on joint 0, the rest on joint 1.
struct Tube {
  PolygonMesh mesh;
  SkinWeights weights;

  explicit Tube(const std::vector<double>& ring_weights, double first = 0)
      : mesh(testing::open_tube(static_cast<int>(ring_weights.size()), kAround, first, 1, 1)) {
    for (const double w : ring_weights)
      for (int a = 0; a < kAround; ++a) weights.push_row(testing::two_joint_row(w));
  }

  void add(const Tube& other) {
    mesh = testing::joined(mesh, other.mesh);
    for (std::size_t v = 0; v < other.mesh.vertex_count(); ++v)
      weights.push_row(other.weights.of(VertexId(v)));
  }
};

const std::vector<bool> kWithoutSecond = {false, true};

std::vector<double> ring_presence(const Tube& tube, const SelectionOptions& options) {
  const auto presence = presence_of_cut(tube.mesh, tube.weights, kWithoutSecond, options);
  std::vector<double> rings;
  for (std::size_t v = 0; v < presence.size(); v += kAround) {
    for (std::size_t a = 1; a < kAround; ++a) EXPECT_NEAR(presence[v + a], presence[v], kRounding);
    rings.push_back(presence[v]);
  }
  return rings;
}

// By hand: the sum of what stays; 0.99 and 0.01 are within 0.02 of the ends.
TEST(PresenceOfCut, WeightsThatStayClamped) {
  const Tube tube({1, 0.99, 0.9, 0.5, 0.03, 0.01, 0});
  EXPECT_THAT(ring_presence(tube, {.smoothing_passes = 0}),
              ::testing::Pointwise(::testing::DoubleNear(kRounding), {1., 1., 0.9, 0.5, 0.03, 0., 0.}));
}

// By hand: a ring vertex has two neighbours of its own ring and one of each next; half its own value, half
// their mean. 0.9 / 2 + (2 * 0.9 + 1 + 0.5) / 8 = 0.8625 and 0.5 / 2 + (2 * 0.5 + 0.9 + 0) / 8 = 0.4875.
TEST(PresenceOfCut, OneSmoothingPassBetween) {
  const Tube tube({1, 0.9, 0.5, 0});
  EXPECT_THAT(ring_presence(tube, {}),
              ::testing::Pointwise(::testing::DoubleNear(kRounding), {1., 0.8625, 0.4875, 0.}));
}

// By hand: p^((1 - h) / (1 + h)): the third power at -0.5, the cube root at 0.5; ends stay ends.
TEST(PresenceOfCut, HardnessBendsBetweenTheEnds) {
  const Tube tube({1, 0.5, 0.125, 0});
  EXPECT_THAT(ring_presence(tube, {.smoothing_passes = 0, .hardness = -0.5}),
              ::testing::Pointwise(::testing::DoubleNear(kRounding), {1., 0.125, 0.001953125, 0.}));
  EXPECT_THAT(ring_presence(tube, {.smoothing_passes = 0, .hardness = 0.5}),
              ::testing::Pointwise(::testing::DoubleNear(kRounding), {1., std::cbrt(0.5), 0.5, 0.}));
}

SourceSelection select(const Tube& tube, const std::vector<Cut>& cuts, IssueSink& issues) {
  return select_faces(tube.mesh, tube.weights, cuts, "input toy", issues);
}

// Rings 0 to 2 are wholly present: the two belts of faces between them stay, the others go to site 7.
TEST(SelectFaces, BeltsOfATube) {
  const Tube tube({1, 1, 1, 0.5, 0, 0});
  IssueSink issues;
  const SourceSelection s = select(tube, {{7, kWithoutSecond, {}}}, issues);
  for (std::size_t f = 0; f < tube.mesh.face_count(); ++f) {
    const bool stays = f < 2 * kAround;
    EXPECT_EQ(s.kept[f] != 0, stays) << f;
    EXPECT_EQ(s.face_site[f], stays ? -1 : 7);
    EXPECT_EQ(s.face_role[f], ComponentRole::Blended);
  }
  EXPECT_THAT(issues.issues(), ::testing::IsEmpty());
}

// Two cuts from either end: the least presence counts, and each face goes to the site that leaves less of it.
TEST(SelectFaces, TwoCuts) {
  const Tube tube({0, 0, 0.5, 1, 1, 1, 1});
  SkinWeights weights;
  for (std::size_t v = 0; v < tube.mesh.vertex_count(); ++v) {
    const double x = tube.mesh.positions[v].x();
    weights.push_row(x < 2   ? std::vector<Influence>{{JointId(0), 1}}
                     : x > 4 ? std::vector<Influence>{{JointId(2), 1}}
                             : std::vector<Influence>{{JointId(1), 1}});
  }
  IssueSink issues;
  const SourceSelection s = select_faces(
      tube.mesh, weights, std::vector<Cut>{{3, {true, false, false}, {}}, {5, {false, false, true}, {}}},
      "input toy", issues);
  const std::vector<int> belt_site = {3, 3, -1, -1, 5, 5};
  for (std::size_t f = 0; f < s.face_site.size(); ++f) EXPECT_EQ(s.face_site[f], belt_site[f / kAround]);
  for (std::size_t v = 0; v < s.presence.size(); ++v)
    EXPECT_EQ(s.presence[v], std::min(s.site_presence[0][v], s.site_presence[1][v]));
}

// Components of even presence (like buttons) stay or go as a whole: above 0.5 they stay. One that is wholly
// present is no news.
TEST(SelectFaces, SecondaryComponentsKeptOrDroppedWhole) {
  Tube tube({1, 1, 1, 0.5, 0, 0, 0});
  tube.add(Tube({0.6, 0.6}, 20));
  tube.add(Tube({0.4, 0.4}, 30));
  tube.add(Tube({1, 1}, 40));
  IssueSink issues;
  const SourceSelection s = select(tube, {{0, kWithoutSecond, {}}}, issues);
  const std::size_t first = 6 * kAround;
  for (std::size_t f = 0; f < kAround; ++f) {
    EXPECT_EQ(s.face_role[first + f], ComponentRole::KeptWhole);
    EXPECT_TRUE(s.kept[first + f]);
    EXPECT_EQ(s.face_role[first + kAround + f], ComponentRole::DroppedWhole);
    EXPECT_FALSE(s.kept[first + kAround + f]);
    EXPECT_EQ(s.face_role[first + 2 * kAround + f], ComponentRole::KeptWhole);
  }
  ASSERT_EQ(issues.issues().size(), 1u);
  EXPECT_EQ(issues.issues()[0].code, "secondary-components");
  EXPECT_EQ(issues.issues()[0].place, "input toy");
  EXPECT_EQ(issues.issues()[0].message, "1 partly present components kept whole, 1 dropped whole");
}

// Each component is judged by the rule of the cut that leaves least of it.
TEST(SelectFaces, EachCutHasItsRule) {
  Tube tube({0.6, 0.6});
  tube.add(Tube({0.4, 0.4}, 20));
  const std::vector<bool> without_first = {true, false};
  IssueSink issues;
  const auto kept = [&](double first_mean, double second_mean) {
    SelectionOptions first, second;
    first.keep_mean = first_mean, second.keep_mean = second_mean;
    const SourceSelection s = select(tube, {{0, kWithoutSecond, first}, {1, without_first, second}}, issues);
    return std::pair(s.kept[0] != 0, s.kept[kAround] != 0);
  };
  // The first tube has 0.6 left by cut 0 and 0.4 by cut 1; the second the other way round.
  EXPECT_EQ(kept(0.5, 0.5), std::pair(false, false));
  EXPECT_EQ(kept(0.5, 0.3), std::pair(true, false));
  EXPECT_EQ(kept(0.3, 0.5), std::pair(false, true));
}

// A small end off a long tube: 2 of 100 rings gone is a variance of 0.02 * 0.98 < 0.04, and still a cut.
TEST(SelectFaces, SmallPartOfALargeComponentIsBlended) {
  std::vector<double> rings(100, 1);
  rings[98] = rings[99] = 0;
  const Tube tube(rings);
  IssueSink issues;
  const SourceSelection s = select(tube, {{0, kWithoutSecond, {}}}, issues);
  EXPECT_EQ(std::count(s.kept.begin(), s.kept.end(), 1), 97 * kAround);
  EXPECT_EQ(s.face_role[0], ComponentRole::Blended);
}

TEST(SelectFaces, WithoutCutsAllStays) {
  const Tube tube({1, 0.5, 0});
  IssueSink issues;
  const SourceSelection s = select(tube, {}, issues);
  EXPECT_THAT(s.kept, ::testing::Each(1));
  EXPECT_THAT(s.presence, ::testing::Each(1));
  EXPECT_THAT(s.face_role, ::testing::Each(ComponentRole::KeptWhole));
}

}  // namespace
}  // namespace skinforge
