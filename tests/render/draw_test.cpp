#include "render/draw.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "base/parallel.h"
#include "render/color.h"
#include "render/shapes.h"

namespace skinforge {
namespace {

using testing::add_face;
using testing::add_square;
using ::testing::Each;
using testing::empty_mesh;
using testing::pixel;
using testing::torus;
using testing::unlit;

const Vec4 kRed(1, 0, 0, 1), kGreen(0, 1, 0, 1), kBlue(0, 0, 1, 1);
constexpr std::array<int, 3> kRedPixel{255, 0, 0}, kGreenPixel{0, 255, 0}, kBluePixel{0, 0, 255};

View front_view() {
  return fit_view(Vec3::Zero(), 2, {});
}

Raster draw_small(const PolygonMesh& mesh, std::span<const Material> materials, DrawOptions options = {},
                  std::span<const Raster> images = {}) {
  options.width = options.height = 64;
  return draw(Subject(mesh, materials, images), {}, front_view(), options);
}

bool has_pixel(const Raster& raster, const std::array<int, 3>& wanted) {
  for (int y = 0; y < raster.height; ++y)
    for (int x = 0; x < raster.width; ++x)
      if (pixel(raster, x, y) == wanted) return true;
  return false;
}

TEST(Draw, EmptyMeshGivesTheBackdrop) {
  const Raster raster = draw_small(PolygonMesh{}, {});
  EXPECT_EQ(raster.rgba.size(), 4U * 64 * 64);
  EXPECT_GT(pixel(raster, 32, 0)[0], 230);
  EXPECT_EQ(pixel(raster, 0, 40), pixel(raster, 63, 40));  // a vertical gradient
}

TEST(Draw, UnlitColorComesOutExactly) {
  PolygonMesh mesh = empty_mesh();
  add_square(mesh, 1, 0);
  const std::vector<Material> materials{unlit(kGreen)};
  EXPECT_EQ(pixel(draw_small(mesh, materials), 32, 32), kGreenPixel);
}

TEST(Draw, NearerSquareHidesTheOther) {
  PolygonMesh mesh = empty_mesh();
  add_square(mesh, 1, 0, MaterialId(0));
  add_square(mesh, 0.3, 0.5, MaterialId(1));
  const std::vector<Material> materials{unlit(kRed), unlit(kBlue)};
  const Raster raster = draw_small(mesh, materials);
  EXPECT_EQ(pixel(raster, 32, 32), kBluePixel);
  EXPECT_EQ(pixel(raster, 32, 22), kRedPixel);
}

TEST(Draw, BackFacesOnlyWhereWanted) {
  PolygonMesh mesh = empty_mesh();
  const std::array<Vec3, 3> away{Vec3(-1, -1, 0), Vec3(0, 1, 0), Vec3(1, -1, 0)};  // faces -z
  add_face(mesh, away);
  std::vector<Material> materials{unlit(kRed)};
  EXPECT_FALSE(has_pixel(draw_small(mesh, materials), kRedPixel));
  const auto plain = pixel(draw_small(mesh, materials), 32, 32);
  const auto marked = pixel(draw_small(mesh, materials, {.back_face_color = Vec3(0, 0, 1)}), 32, 32);
  EXPECT_NE(plain, marked);
  EXPECT_GT(marked[2], marked[0]);  // lit, so not pure blue
  materials[0].double_sided = true;
  EXPECT_EQ(pixel(draw_small(mesh, materials), 32, 32), kRedPixel);
}

// Left half of the picture black, right half white, over the square from u = 0 to 1.
TEST(Draw, TextureByHand) {
  PolygonMesh mesh = empty_mesh();
  add_square(mesh, 1, 0);
  std::vector<Material> materials{unlit(Vec4::Ones())};
  materials[0].base_color_texture = TextureRef{.image = ImageId(0), .nearest = true};
  const Raster image{2, 1, {0, 0, 0, 255, 255, 255, 255, 255}};
  const Raster raster = draw_small(mesh, materials, {}, std::span(&image, 1));
  EXPECT_EQ(pixel(raster, 24, 32), (std::array<int, 3>{0, 0, 0}));
  EXPECT_EQ(pixel(raster, 40, 32), (std::array<int, 3>{255, 255, 255}));
}

TEST(Draw, AlphaCutsAndBlends) {
  PolygonMesh mesh = empty_mesh();
  add_square(mesh, 1, 0, MaterialId(1));
  add_square(mesh, 0.9, 0.1, MaterialId(0));
  std::vector<Material> materials{unlit(Vec4(1, 0, 0, 0.25)), unlit(kGreen)};
  EXPECT_EQ(pixel(draw_small(mesh, materials), 32, 32), kRedPixel);  // opaque: alpha is ignored
  materials[0].alpha_mode = AlphaMode::Mask;
  EXPECT_EQ(pixel(draw_small(mesh, materials), 32, 32), kGreenPixel);  // 0.25 < cutoff 0.5
  materials[0].alpha_mode = AlphaMode::Blend;                          // 4 of 16 samples
  EXPECT_EQ(pixel(draw_small(mesh, materials), 32, 32),
            (std::array<int, 3>{srgb_from_linear(0.25F), srgb_from_linear(0.75F), 0}));
}

TEST(Draw, VertexColorsReplaceMaterials) {
  PolygonMesh mesh = empty_mesh();
  add_square(mesh, 1, 0);
  const std::vector<Material> materials{unlit(kRed)};
  const std::vector<Vec3> blue(4, Vec3(0, 0, 0.8));
  const auto middle = pixel(draw_small(mesh, materials, {.vertex_colors = blue}), 32, 32);
  EXPECT_GT(middle[2], 4 * middle[0]);
}

TEST(Draw, HighlightTintsItsFacesOnly) {
  PolygonMesh mesh = empty_mesh();
  add_square(mesh, 0.4, 0);
  for (Vec3& p : mesh.positions) p.x() -= 0.6;
  add_square(mesh, 0.4, 0);
  for (std::size_t i = 4; i < 8; ++i) mesh.positions[i].x() += 0.6;
  const std::vector<Material> materials{unlit(kBlue)};
  const std::vector<FaceId> faces{FaceId(1)};
  const Raster raster = draw_small(mesh, materials, {.highlight = faces, .highlight_color = Vec3(1, 0, 0)});
  EXPECT_EQ(pixel(raster, 22, 32), kBluePixel);
  EXPECT_GT(pixel(raster, 41, 32)[0], 150);
}

// Lines run along the square's rim; its diagonal from corner to corner is not drawn.
TEST(Draw, WireframeShowsEdgesWithoutDiagonals) {
  PolygonMesh mesh = empty_mesh();
  add_square(mesh, 1, 0);
  const std::vector<Material> materials{unlit(Vec4::Ones())};
  const Raster raster = draw_small(mesh, materials, {.wireframe = true});
  int first = 0;
  while (pixel(raster, first, 32) == pixel(raster, 0, 32)) ++first;
  const auto rim = std::min(pixel(raster, first, 32)[0], pixel(raster, first + 1, 32)[0]);
  EXPECT_LT(rim, 220);  // half a line: the other half would lie on the neighbour
  for (int i = first + 3; i < 64 - first - 3; ++i) {
    EXPECT_EQ(pixel(raster, i, i), (std::array<int, 3>{255, 255, 255}));
    EXPECT_EQ(pixel(raster, i, 63 - i), (std::array<int, 3>{255, 255, 255}));
  }
}

TEST(Draw, AFloorDarkensBelowTheBody) {
  const PolygonMesh mesh = torus();
  const Subject subject(mesh, {});
  const View view = fit_view(mesh.positions, {0.3, radians(25)}, 1, 0.2);
  const auto sum = [](const Raster& r) {
    std::int64_t total = 0;
    for (const auto v : r.rgba) total += v;
    return total;
  };
  DrawOptions options{.width = 96, .height = 96};
  const Raster without = draw(subject, {}, view, options);
  options.floor = -0.3;
  const Raster with = draw(subject, {}, view, options);
  EXPECT_LT(sum(with), sum(without));
  EXPECT_EQ(pixel(with, 48, 1), pixel(without, 48, 1));  // above the horizon nothing changes
}

// The light comes from the camera's upper left: a lone plate is brighter when it faces up than down.
TEST(Draw, LightComesFromAbove) {
  const auto brightness = [](double tilt) {
    PolygonMesh mesh = empty_mesh();
    add_square(mesh, 1, 0);
    for (Vec3& p : mesh.positions) p = Eigen::AngleAxisd(tilt, Vec3::UnitX()) * p;
    for (Vec3& n : mesh.normals) n = Eigen::AngleAxisd(tilt, Vec3::UnitX()) * n;
    return pixel(draw_small(mesh, {}), 32, 32)[1];
  };
  EXPECT_GT(brightness(-0.8), brightness(0.8) + 20);
}

TEST(Draw, SameBytesForAnyNumberOfThreads) {
  const PolygonMesh mesh = torus(40, 20);
  const Subject subject(mesh, {});
  const View view = fit_view(mesh.positions, {0.4, 0.3});
  DrawOptions options{.width = 150, .height = 130, .wireframe = true, .floor = -0.3};
  set_thread_limit(1);
  const Raster one = draw(subject, {}, view, options);
  set_thread_limit(4);
  const Raster four = draw(subject, {}, view, options);
  EXPECT_EQ(one.rgba, four.rgba);
}

// A uniform scale of 128 (a power of two, so without rounding) of mesh, floor and view leaves the picture as
// it is.
TEST(Draw, NoAbsoluteLength) {
  const PolygonMesh mesh = torus();
  PolygonMesh large = mesh;
  for (Vec3& p : large.positions) p *= 128;
  DrawOptions options{.width = 80, .height = 80, .floor = -0.3};
  const Raster a = draw(Subject(mesh, {}), {}, fit_view(mesh.positions, {0.4, 0.3}), options);
  options.floor = -0.3 * 128;
  const Raster b = draw(Subject(large, {}), {}, fit_view(large.positions, {0.4, 0.3}), options);
  EXPECT_EQ(a.rgba, b.rgba);
}

TEST(Draw, PostureMovesTheShape) {
  PolygonMesh mesh = empty_mesh();
  add_square(mesh, 0.4, 0);
  const std::vector<Material> materials{unlit(kRed)};
  std::vector<Vec3> moved = mesh.positions;
  for (Vec3& p : moved) p.x() += 1;
  const Raster raster =
      draw(Subject(mesh, materials), {.positions = moved}, front_view(), {.width = 64, .height = 64});
  EXPECT_NE(pixel(raster, 32, 32), kRedPixel);
  EXPECT_EQ(pixel(raster, 46, 32), kRedPixel);
}

TEST(Draw, NonFinitePositionsCostOnlyTheirTriangles) {
  PolygonMesh mesh = empty_mesh();
  add_square(mesh, 0.4, 0);
  add_square(mesh, 0.4, 0.5);
  mesh.positions[4].x() = std::nan("");
  mesh.positions[6].y() = std::numeric_limits<double>::infinity();
  const std::vector<Material> materials{unlit(kRed)};
  EXPECT_EQ(pixel(draw_small(mesh, materials), 32, 32), kRedPixel);
}

// Of two parallel squares only the front one is in sight; from behind neither is a front face.
TEST(Draw, VisibleAreaCountsFrontFacesInSight) {
  PolygonMesh mesh = empty_mesh();
  add_square(mesh, 0.5, 0);
  add_square(mesh, 1, 1);
  const Subject subject(mesh, {});
  const std::vector<FaceId> hidden{FaceId(0)}, shown{FaceId(1)};
  EXPECT_EQ(visible_area(subject, {}, {}, front_view()), 0);
  EXPECT_EQ(visible_area(subject, {}, hidden, front_view()), 0);
  EXPECT_GT(visible_area(subject, {}, shown, front_view()), 0.2);
  EXPECT_EQ(visible_area(subject, {}, shown, fit_view(Vec3::Zero(), 2, {radians(180), 0})), 0);
}

}  // namespace
}  // namespace skinforge
