#include "surface/border.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "surface/shapes.h"

namespace skinforge {
namespace {

using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using ::testing::IsEmpty;
using testing::quad_grid;

// A quad grid with those faces kept: '#' in a row per y, lowest first.
struct Picture {
  PolygonMesh mesh;
  EdgeList edges;
  FaceSet kept;

  explicit Picture(const std::vector<std::string>& rows)
      : mesh(quad_grid(static_cast<int>(rows[0].size()), static_cast<int>(rows.size()))),
        edges(build_edges(mesh)) {
    for (const std::string& row : rows)
      for (const char c : row) kept.push_back(c == '#');
  }

  std::vector<std::string> rows() const {
    const std::size_t width = static_cast<std::size_t>(mesh.positions.back().x());
    std::vector<std::string> all;
    for (std::size_t f = 0; f < kept.size(); ++f) {
      if (f % width == 0) all.emplace_back();
      all.back() += kept[f] ? '#' : '.';
    }
    return all;
  }
};

std::vector<int> values(const BorderChain& chain) {
  std::vector<int> list;
  for (const VertexId v : chain.vertices) list.push_back(v.value);
  return list;
}

// A new face in the hole would run 5, 6, 10, 9, counter-clockwise like its neighbours.
TEST(BorderChains, HoleInAGrid) {
  const Picture p({"###", "#.#", "###"});
  const auto chains = border_chains(p.mesh, p.edges, p.kept);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_TRUE(chains[0].is_closed);
  EXPECT_THAT(values(chains[0]), ElementsAre(5, 6, 10, 9));
}

// The kept face is an island: new faces run round it the other way.
TEST(BorderChains, Island) {
  const Picture p({"...", ".#.", "..."});
  const auto chains = border_chains(p.mesh, p.edges, p.kept);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_THAT(values(chains[0]), ElementsAre(5, 9, 10, 6));
}

// A gap from hem to hem: two arcs, each along the gap's own direction; the open hem is no border.
TEST(BorderChains, ArcsEndOnOpenHems) {
  const Picture p({"#.#"});
  const auto chains = border_chains(p.mesh, p.edges, p.kept);
  ASSERT_EQ(chains.size(), 2u);
  EXPECT_FALSE(chains[0].is_closed || chains[1].is_closed);
  EXPECT_THAT(values(chains[0]), ElementsAre(2, 6));
  EXPECT_THAT(values(chains[1]), ElementsAre(5, 1));
}

TEST(BorderChains, NoneWhereAllOrNothingIsKept) {
  for (const char c : {'#', '.'}) {
    const Picture p(std::vector<std::string>(3, std::string(3, c)));
    EXPECT_THAT(border_chains(p.mesh, p.edges, p.kept), IsEmpty());
  }
}

// Law: on a closed box with random kept faces and no pinches, chains are loops that use each border half-edge
// once, and no vertex twice.
TEST(BorderChains, CoverTheBorderOnce) {
  std::mt19937 random(5);
  const PolygonMesh mesh = testing::quad_box(6, 1);
  const EdgeList edges = build_edges(mesh);
  for (int round = 0; round < 5; ++round) {
    FaceSet kept;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) kept.push_back(random() % 3 != 0);
    drop_pinches(mesh, edges, kept);
    std::size_t border = 0, walked = 0;
    for (const Edge& e : edges.edges) {
      int at = 0;
      for (const std::int32_t c : e.half_edges) at += kept[edges.face_of_corner[c].index()];
      border += at == 1;
    }
    std::set<VertexId> vertices;
    for (const BorderChain& chain : border_chains(mesh, edges, kept)) {
      EXPECT_TRUE(chain.is_closed);
      walked += chain.vertices.size();
      vertices.insert(chain.vertices.begin(), chain.vertices.end());
    }
    EXPECT_EQ(walked, border);
    EXPECT_EQ(vertices.size(), border);
  }
}

// Two faces touch in the middle vertex; with fans of equal size the later one goes.
TEST(DropPinches, OfTwoDiagonalFaces) {
  Picture p({"#.", ".#"});
  drop_pinches(p.mesh, p.edges, p.kept);
  EXPECT_THAT(p.rows(), ElementsAre("#.", ".."));
}

// Six triangles about vertex 0, kept in fans of two and of one: the larger stays.
TEST(DropPinches, TheLargerFanStays) {
  const PolygonMesh fan = testing::polygon_mesh(
      {{0, 0, 0}, {2, 0, 0}, {1, 2, 0}, {-1, 2, 0}, {-2, 0, 0}, {-1, -2, 0}, {1, -2, 0}},
      {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 6}, {0, 6, 1}});
  FaceSet kept = {1, 0, 0, 1, 1, 0};
  drop_pinches(fan, build_edges(fan), kept);
  EXPECT_THAT(kept, ElementsAre(0, 0, 0, 1, 1, 0));
}

TEST(OpenFaceSet, SpikeGoesBlockStays) {
  Picture p({"####....", "####....", "######..", "####....", "........"});
  open_face_set(p.mesh, p.edges, p.kept);
  EXPECT_THAT(p.rows(), ElementsAre("####....", "####....", "####....", "####....", "........"));
}

// One face wide all along: nothing survives the erosion.
TEST(OpenFaceSet, StripGoes) {
  Picture p({".....", "#####", "....."});
  open_face_set(p.mesh, p.edges, p.kept);
  EXPECT_THAT(p.rows(), ElementsAre(".....", ".....", "....."));
}

TEST(OpenFaceSet, WithoutBorderNothingChanges) {
  Picture p({"#", "#"});
  open_face_set(p.mesh, p.edges, p.kept);
  EXPECT_THAT(p.rows(), ElementsAre("#", "#"));
}

// The bump has three edges on the border; the straight rows below it have one each.
TEST(StraightenBorder, BumpGoes) {
  Picture p({"######", "######", "..#...", "......"});
  EXPECT_EQ(straighten_border(p.mesh, p.edges, p.kept, 10), 1);
  EXPECT_THAT(p.rows(), ElementsAre("######", "######", "......", "......"));
}

TEST(StraightenBorder, StopsAtTheLimit) {
  Picture p({"######", "#.#.#.", "......"});
  EXPECT_EQ(straighten_border(p.mesh, p.edges, p.kept, 2), 2);
  EXPECT_THAT(p.rows(), ElementsAre("######", "....#.", "......"));
  EXPECT_EQ(straighten_border(p.mesh, p.edges, p.kept, 0), 0);
}

// Two faces alone are fewer than three; the group of four stays, and so does one that touches no border.
TEST(DropCrumbs, SmallGroupsAtTheBorder) {
  Picture p({"##..#", "##..#"});
  drop_crumbs(p.mesh, p.edges, p.kept, 3);
  EXPECT_THAT(p.rows(), ElementsAre("##...", "##..."));
  Picture whole({"#"});  // touches no border
  drop_crumbs(whole.mesh, whole.edges, whole.kept, 3);
  EXPECT_THAT(whole.rows(), ElementsAre("#"));
}

// By hand, without the outer edges of the mesh: the scrap on the right has 2 faces and 2 border edges, the
// wide part 41 faces, then 40.
TEST(DropCrumbs, ScrapsBesideAMuchLargerGroup) {
  const std::string row(20, '#');
  Picture p({row + "#.#", row + "..#"});
  drop_crumbs(p.mesh, p.edges, p.kept, 1);
  EXPECT_THAT(p.rows(), ElementsAre(row + "#..", row + "..."));
  Picture claws({row + "..#", row + "..#"});
  drop_crumbs(claws.mesh, claws.edges, claws.kept, 1);
  EXPECT_THAT(claws.rows(), ElementsAre(row + "..#", row + "..#"));
}

// Opened, two blocks on a bridge would be two parts with a border each.
TEST(RestoreBrokenGroups, BlocksOnABridgeStayOne) {
  const std::vector<std::string> rows = {"...........", ".###...###.", ".#########.", ".###...###.",
                                         "..........."};
  const Picture whole(rows);
  Picture p(rows);
  open_face_set(p.mesh, p.edges, p.kept);
  EXPECT_EQ(border_chains(p.mesh, p.edges, p.kept).size(), 2u);
  restore_broken_groups(p.mesh, p.edges, whole.kept, p.kept);
  EXPECT_THAT(p.rows(), ElementsAreArray(rows));
}

// Two blocks that meet in a vertex share a chain; what the pinch costs one of them is not given back.
TEST(RestoreBrokenGroups, BlocksThatMeetInAVertex) {
  const Picture whole({"......", ".##...", ".##...", "...##.", "...##.", "......"});
  Picture p = whole;
  drop_pinches(p.mesh, p.edges, p.kept);
  const std::vector<std::string> apart = p.rows();
  restore_broken_groups(p.mesh, p.edges, whole.kept, p.kept);
  EXPECT_THAT(p.rows(), ElementsAreArray(apart));
}

TEST(RestoreBrokenGroups, SpikesGo) {
  const Picture whole({".......", ".###...", ".#####.", ".###...", "......."});
  Picture p = whole;
  open_face_set(p.mesh, p.edges, p.kept);
  restore_broken_groups(p.mesh, p.edges, whole.kept, p.kept);
  EXPECT_THAT(p.rows(), ElementsAre(".......", ".###...", ".###...", ".###...", "......."));
}

}  // namespace
}  // namespace skinforge
