#include "surface/preserved.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "surface/fusion_solid.h"
#include "surface/shapes.h"

namespace skinforge {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

// A source with those faces kept; the others belong to `site`.
PreservedSource source_with(const PolygonMesh& mesh, const FaceSet& kept, std::int32_t site) {
  PreservedSource source{&mesh, {}};
  source.selection.kept = kept;
  for (const char k : kept) source.selection.face_site.push_back(k ? -1 : site);
  return source;
}

FaceSet all_but(std::size_t faces, std::size_t hole) {
  FaceSet kept(faces, 1);
  kept[hole] = 0;
  return kept;
}

// One face is thinner than any opening leaves alone; as it is all there is, it stays.
TEST(CleanBorders, ARaggedRestIsBetterThanNothing) {
  const PolygonMesh grid = testing::quad_grid(3, 3);
  FaceSet kept(9, 0);
  kept[4] = 1;
  PreservedSource source = source_with(grid, kept, 2);
  clean_borders(source, {});
  EXPECT_EQ(source.selection.kept, kept);
}

// A rest of two faces that touch in a vertex is not left pinched.
TEST(CleanBorders, ARaggedRestWithoutPinches) {
  const PolygonMesh grid = testing::quad_grid(2, 2);
  PreservedSource source = source_with(grid, {1, 0, 0, 1}, 0);
  clean_borders(source, {});
  EXPECT_THAT(source.selection.kept, ElementsAre(1, 0, 0, 0));
}

// The spike (2, 2) of the lower rows goes to the site beside it.
TEST(CleanBorders, WhatGoesBelongsToTheSiteBeside) {
  const PolygonMesh grid = testing::quad_grid(5, 4);
  FaceSet kept(20, 0), wanted;
  std::fill(kept.begin(), kept.begin() + 10, 1);
  wanted = kept;
  kept[12] = 1;
  PreservedSource source = source_with(grid, kept, 6);
  clean_borders(source, {});
  EXPECT_EQ(source.selection.kept, wanted);
  EXPECT_EQ(source.selection.face_site[12], 6);
  EXPECT_EQ(source.selection.face_site[0], -1);
}

TEST(CleanBorders, WholeSourceStaysWhole) {
  const PolygonMesh cube = testing::quad_cube();
  PreservedSource source = source_with(cube, FaceSet(6, 1), 0);
  clean_borders(source, {});
  EXPECT_THAT(source.selection.kept, ::testing::Each(1));
}

// Of four faces asked for, face 1 is not fused, face 2 is gone already, and one is of another source.
TEST(DiscardFaces, OnlyFusedOnesAndOnce) {
  const PolygonMesh grid = testing::quad_grid(4, 1);
  std::vector<PreservedSource> sources = {source_with(grid, {1, 1, 0, 1}, 3),
                                          source_with(grid, {1, 1, 1, 1}, 3)};
  const std::vector<SiteParticipant> participants = {{SourceId(0), true, false, {}, {1, 0, 1, 1}}};
  const std::vector<std::pair<SourceId, FaceId>> cut = {{SourceId(0), FaceId(0)},
                                                        {SourceId(0), FaceId(0)},
                                                        {SourceId(0), FaceId(1)},
                                                        {SourceId(0), FaceId(2)},
                                                        {SourceId(1), FaceId(3)}};
  EXPECT_EQ(discard_faces(sources, participants, cut, 5), 1u);
  EXPECT_THAT(sources[0].selection.kept, ElementsAre(0, 1, 0, 1));
  EXPECT_THAT(sources[0].selection.face_site, ElementsAre(5, -1, 3, -1));
  EXPECT_THAT(sources[1].selection.kept, ::testing::Each(1));
}

// A hole of one face in a 5 x 5 grid: its loop, and at each corner the two neighbours that lie further out.
TEST(LoopsOfSites, LoopWithItsInwardNeighbours) {
  const PolygonMesh grid = testing::quad_grid(5, 5);
  const PreservedSource source = source_with(grid, all_but(25, 12), 4);
  std::vector<JunctionLoop> arcs;
  const auto loops = loops_of_sites(source, SourceId(1), std::vector<std::size_t>{4}, true, arcs);
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_TRUE(arcs.empty());
  EXPECT_EQ(loops[0].source, SourceId(1));
  EXPECT_TRUE(loops[0].is_host);
  EXPECT_THAT(loops[0].vertices, ElementsAre(VertexId(14), VertexId(15), VertexId(21), VertexId(20)));
  EXPECT_THAT(loops[0].positions, ElementsAre(Vec3(2, 2, 0), Vec3(3, 2, 0), Vec3(3, 3, 0), Vec3(2, 3, 0)));
  EXPECT_THAT(loops[0].inward[0], UnorderedElementsAre(Vec3(1, 2, 0), Vec3(2, 1, 0)));
  EXPECT_THAT(loops[0].inward[2], UnorderedElementsAre(Vec3(4, 3, 0), Vec3(3, 4, 0)));
  EXPECT_THAT(loops_of_sites(source, SourceId(1), std::vector<std::size_t>{0, 5}, true, arcs), IsEmpty());
}

// A gap from hem to hem has two arcs and no loop.
TEST(LoopsOfSites, ArcsAreCounted) {
  const PolygonMesh grid = testing::quad_grid(3, 1);
  std::vector<JunctionLoop> arcs;
  EXPECT_THAT(
      loops_of_sites(source_with(grid, {1, 0, 1}, 0), SourceId(0), std::vector<std::size_t>{0}, true, arcs),
      IsEmpty());
  EXPECT_EQ(arcs.size(), 2u);
}

// Where two solids are united, kept faces of the host that lie inside the added part go.
TEST(DiscardMovedFaces, FacesInsideTheOtherPartGo) {
  const PolygonMesh box = testing::quad_box(8, 2), post = testing::quad_box(4, 1);
  std::vector<PolygonMesh> meshes = {box, post};
  for (Vec3& p : meshes[1].positions) p.x() += 2;
  std::vector<PreservedSource> sources;
  std::vector<SiteParticipant> participants;
  std::vector<FusionSolid> solids;
  for (std::size_t s = 0; s < 2; ++s) {
    sources.push_back(source_with(meshes[s], FaceSet(meshes[s].face_count(), 1), -1));
    participants.push_back({SourceId(s), s == 0, s == 1, std::vector<double>(meshes[s].vertex_count(), 1),
                            FaceSet(meshes[s].face_count(), 1)});
    solids.push_back(fusion_solid(meshes[s], participants.back()));
  }
  SiteField field;
  field.distance.lattice = {.origin = Vec3(-5, -5, -5), .voxel = 0.5, .size = {21, 21, 21}};
  field.distance.values.assign(field.distance.lattice.count(), 0);  // asked only whether it is there
  field.band = 10;
  field.blend = site_blend(solids, {BlendOperator::Paper, 0}, 0);
  const std::vector<PreservedSource> whole = sources;
  discard_moved_faces(sources, participants, solids, field, 9, {.added_rings = 0});
  const auto is_inside = [](const PolygonMesh& mesh, std::size_t f, const auto& holds) {
    const auto face = mesh.face(FaceId(f));
    return std::any_of(face.begin(), face.end(),
                       [&](VertexId v) { return holds(mesh.positions[v.index()]); });
  };
  for (std::size_t f = 0; f < box.face_count(); ++f) {
    const bool goes = is_inside(meshes[0], f, [](const Vec3& p) {
      return p.x() > 1.9 && std::abs(p.y()) < 0.9 && std::abs(p.z()) < 0.9;
    });
    EXPECT_EQ(sources[0].selection.kept[f] == 0, goes) << f;
    EXPECT_EQ(sources[0].selection.face_site[f], goes ? 9 : -1);
  }
  for (std::size_t f = 0; f < post.face_count(); ++f)
    EXPECT_EQ(sources[1].selection.kept[f] == 0,
              is_inside(meshes[1], f, [](const Vec3& p) { return p.x() < 1.9; }));
  // One more ring of the host, whose faces are 1/2 wide, and none of the added part.
  std::vector<PreservedSource> wider = whole;
  discard_moved_faces(wider, participants, solids, field, 9, {.added_rings = 1});
  for (std::size_t f = 0; f < box.face_count(); ++f)
    EXPECT_EQ(wider[0].selection.kept[f] == 0, is_inside(meshes[0], f,
                                                         [](const Vec3& p) {
                                                           return p.x() > 1.9 && std::abs(p.y()) < 1.4 &&
                                                                  std::abs(p.z()) < 1.4;
                                                         }))
        << f;
  EXPECT_EQ(wider[1].selection.kept, sources[1].selection.kept);
}

}  // namespace
}  // namespace skinforge
