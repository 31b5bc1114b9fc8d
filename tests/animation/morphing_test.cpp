#include "animation/morphing.h"

#include <gtest/gtest.h>

namespace skinforge {
namespace {

// Two triangles, one a part, with vertex 1 in both. Each part has a target along z and one along y; the clip
// drives those of part 0 only. At half time z = 0.5 of part 0; part 1 stands at its defaults, 0 and 3.
TEST(MorphedPositions, WeightsOfTheClipOrDefaults) {
  Character character;
  PolygonMesh& mesh = character.mesh;
  mesh.positions.assign(5, Vec3::Zero());
  for (const int v : {0, 1, 2, 1, 3, 4}) mesh.corners.emplace_back(v);
  mesh.face_begin = {0, 3, 6};
  mesh.face_part = {PartId(0), PartId(1)};
  for (const int part : {0, 1}) {
    const VertexId own(part == 0 ? 0 : 3);
    const std::vector<VertexId> vertices{std::min(own, VertexId(1)), std::max(own, VertexId(1))};
    character.morphs.push_back({"up", PartId(part), 0, vertices, {Vec3::UnitZ(), Vec3::UnitZ()}});
    character.morphs.push_back({"side", PartId(part), 3, vertices, {Vec3::UnitY(), Vec3::UnitY()}});
  }
  Clip clip;
  clip.duration = 1;
  clip.morphs.push_back({PartId(0), {.times = {0, 1}, .values = {{0, 0}, {1, 0}}}});
  const auto positions = morphed_positions(character, clip, 0.5);
  EXPECT_EQ(positions[0], Vec3(0, 0, 0.5));
  EXPECT_EQ(positions[1], Vec3(0, 0, 0.5));  // in both parts: as in the first
  EXPECT_EQ(positions[2], Vec3::Zero());
  EXPECT_EQ(positions[3], Vec3(0, 3, 0));
}

}  // namespace
}  // namespace skinforge
