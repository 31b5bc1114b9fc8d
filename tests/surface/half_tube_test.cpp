#include "surface/half_tube.h"

#include <gtest/gtest.h>

#include "surface/ring_zip.h"
#include "surface/shapes.h"
#include "surface/tube.h"

namespace skinforge {
namespace {

// A sheet of 8 by 4 in the plane z = 0, symmetric across x = 0, with a round hole of 8 vertices on either
// side; nothing of it but its borders is fixed. Its border has a vertex in the middle of both long sides.
struct Sheet {
  TrianglePatch patch;
  std::vector<JunctionLoop> loops;
  PatchMirror borders{{Vec3::UnitX(), 0}, {}};

  Sheet() {
    std::vector<Vec3> right, seam;  // of the border, from below the plane's end to above
    for (int x = 0; x <= 4; ++x) right.emplace_back(x, -2, 0);
    for (int y = -1; y <= 1; ++y) right.emplace_back(4, y, 0);
    for (int x = 4; x >= 0; --x) right.emplace_back(x, 2, 0);
    for (const double y : {1.2, 0.4, -0.4, -1.2}) seam.emplace_back(0, y, 0);
    std::vector<Vec3> hole;
    for (const Vec3& p : testing::ring(8)) hole.emplace_back(2 + p.x(), p.z(), 0);
    std::reverse(hole.begin(), hole.end());  // as the border: anticlockwise

    const auto n = static_cast<std::int32_t>(right.size()), h = static_cast<std::int32_t>(hole.size());
    std::vector<Vec3> border = right;  // once around: the right half, then the left one back
    for (std::int32_t k = n - 2; k > 0; --k) border.push_back(borders.plane.mirrored(right[k]));
    const std::int32_t whole = 2 * n - 2;
    const auto image_on_border = [&](std::int32_t k) { return (whole - k) % whole; };
    for (std::int32_t k = 0; k < whole; ++k) borders.image.push_back(image_on_border(k));
    for (std::int32_t k = 0; k < h; ++k) borders.image.push_back(whole + h + h - 1 - k);
    for (std::int32_t k = 0; k < h; ++k) borders.image.push_back(whole + h - 1 - k);

    patch.positions = border;
    std::vector<Vec3> inner(hole.rbegin(), hole.rend()), other;  // new faces run clockwise along holes
    for (const Vec3& p : hole) other.push_back(borders.plane.mirrored(p));
    patch.positions.insert(patch.positions.end(), inner.begin(), inner.end());
    patch.positions.insert(patch.positions.end(), other.begin(), other.end());
    patch.fixed = patch.positions.size();
    patch.positions.insert(patch.positions.end(), seam.begin(), seam.end());

    std::vector<Vec3> ring = right;
    ring.insert(ring.end(), seam.begin(), seam.end());
    const auto m = static_cast<std::int32_t>(ring.size()), fixed = static_cast<std::int32_t>(patch.fixed);
    const auto name = [&](std::int32_t v) {
      if (v < n) return v;
      return v < m ? fixed + v - n : whole + h - 1 - (v - m);
    };
    const auto image = [&](std::int32_t v) { return v < fixed ? borders.image[v] : v; };
    for (const Triangle& t : zip_rings(ring, hole, nullptr)) {
      const std::int32_t a = name(t[0]), b = name(t[1]), c = name(t[2]);
      patch.triangles.push_back({a, b, c});
      patch.triangles.push_back({image(a), image(c), image(b)});
    }
    const auto loop = [](const std::vector<Vec3>& p, bool is_host) {
      return JunctionLoop{
          SourceId(is_host ? 0 : 1), is_host, {}, p, std::vector<std::vector<Vec3>>(p.size())};
    };
    loops = {loop(border, true), loop(inner, false), loop(other, false)};
  }
};

TEST(HalfDomains, TheSheetItselfIsSound) {
  const Sheet sheet;
  for (std::size_t v = 0; v < sheet.patch.fixed; ++v)
    EXPECT_LT((sheet.borders.plane.mirrored(sheet.patch.positions[v]) -
               sheet.patch.positions[static_cast<std::size_t>(sheet.borders.image[v])])
                  .norm(),
              1e-12);
  EXPECT_EQ(boundary_loops(sheet.patch.triangles).size(), 3u);
}

// By hand: the half's outer border has 12 edges (4 + 4 + 4) and a seam of length 4 in edges of 1: even with
// the 8 of the hole, so 4 pieces, 3 vertices; or two pieces less or more.
TEST(HalfDomains, ASeamOnThePlane) {
  const Sheet sheet;
  const auto domains = half_domains(sheet.patch, sheet.loops, sheet.borders);
  ASSERT_EQ(domains.size(), 3u);
  EXPECT_EQ(domains[0].a.points.size(), 8u);
  EXPECT_EQ(domains[0].b.points.size(), 12u + 4);
  EXPECT_EQ(domains[0].seams.size(), 3u);
  EXPECT_EQ(domains[1].seams.size(), 1u);
  EXPECT_EQ(domains[2].seams.size(), 5u);
  for (const Vec3& p : domains[0].seams) EXPECT_EQ(p.x(), 0);
}

// Law: the unfolded tube is watertight, and its faces are the images that it says.
TEST(HalfDomains, UnfoldedFacesAreImages) {
  const Sheet sheet;
  for (const TubeDomain& domain : half_domains(sheet.patch, sheet.loops, sheet.borders)) {
    std::string fault;
    const auto tube = QuadTube::make(domain, fault);
    ASSERT_TRUE(tube) << fault;
    const auto table = tube->table(tube->wanted_rows() + 2, {});
    ASSERT_TRUE(table);
    const Unfolded whole =
        unfolded(tube->laid(*table, tube->wanted_rows() + 2), domain.seams.size(), sheet.borders);
    const auto mirror = mirror_of(whole.patch, sheet.borders);
    ASSERT_TRUE(mirror);
    EXPECT_EQ(mirror->image, whole.mirror.image);
    EXPECT_TRUE(whole.patch.triangles.empty());
    const auto uses = testing::half_edge_uses(halved(whole.patch).triangles);
    for (const auto& [edge, number] : uses) EXPECT_EQ(number, 1);
    const auto loops = boundary_loops(halved(whole.patch).triangles);
    ASSERT_EQ(loops.size(), 3u);
    EXPECT_EQ(loops[0].size(), 24u);
    EXPECT_EQ(loops[1].size(), 8u);
  }
}

}  // namespace
}  // namespace skinforge
