#include "texture/junction_texture.h"

#include <gtest/gtest.h>

#include <memory>

#include "base/parallel.h"
#include "texture/color_steps.h"
#include "texture/tube_mesh.h"

namespace skinforge {
namespace {

using testing::tube_mesh;

constexpr double kHalfStep = 0.5 / 255 + 1e-9;  // rounding to 8 bits
constexpr int kAround = 12;

// One source: a tube with its own materials and images.
struct TestSource {
  PolygonMesh mesh;
  Triangulation triangles;
  std::unique_ptr<TriangleBvh> bvh;
  std::vector<Material> materials;
  std::vector<Raster> images;
  std::vector<double> factor;

  TextureSource view() const {
    return {{&mesh, materials, images}, mesh.positions, &triangles, bvh.get(), factor};
  }
};

TestSource source_of(PolygonMesh mesh, const Vec3& color) {
  TestSource source;
  source.mesh = std::move(mesh);
  source.triangles = triangulate(source.mesh);
  std::vector<std::array<std::int32_t, 3>> soup;
  for (const auto& t : source.triangles.triangles) soup.push_back({t[0].value, t[1].value, t[2].value});
  source.bvh = std::make_unique<TriangleBvh>(source.mesh.positions, soup);
  source.materials.resize(1);
  source.materials[0].base_color.head<3>() = color;
  return source;
}

// A result: one tube from x = 0 to x = 12 in rings 1 apart. Faces up to x = 4 are those of source 0, from x =
// 8 on those of source 1, between them lies the junction; shares go linearly from one border to the other.
struct Scene {
  PolygonMesh result;
  std::vector<FaceId> junction;
  std::vector<TestSource> sources;

  JunctionTexture bake(const JunctionTextureOptions& options = {}) const {
    std::vector<TextureSource> views;
    for (const TestSource& s : sources) views.push_back(s.view());
    return bake_junction_texture({&result, junction}, views, options);
  }
};

Scene two_tubes(const Vec3& first, const Vec3& second) {
  Scene scene;
  scene.result = tube_mesh(13, kAround, 0, 1, 2);
  for (int f = 4 * kAround; f < 8 * kAround; ++f) scene.junction.push_back(FaceId(f));
  scene.sources.push_back(source_of(tube_mesh(9, kAround, 0, 1, 2), first));
  scene.sources.push_back(source_of(tube_mesh(9, kAround, 4, 1, 2), second));
  for (const Vec3& p : scene.result.positions) {
    const double t = std::clamp((p.x() - 4) / 4, 0.0, 1.0);
    scene.sources[0].factor.push_back(1 - t);
    scene.sources[1].factor.push_back(t);
  }
  return scene;
}

// Gives a tube UVs (u along x, v around) and a texture.
void paint(TestSource& source, const Raster& image) {
  source.mesh.parts[0].uv_sets = 1;
  source.mesh.uvs.assign(1, {});
  for (std::size_t f = 0; f < source.mesh.face_count(); ++f)
    for (int k = 0; k < 4; ++k) {
      const double x = source.mesh.positions[source.mesh.corners[4 * f + k].index()].x() / 12;
      const double around = (static_cast<double>(f % kAround) + (k == 1 || k == 2 ? 1 : 0)) / kAround;
      source.mesh.uvs[0].emplace_back(x, around);
    }
  source.images = {image};
  source.materials[0].base_color = Vec4::Ones();
  source.materials[0].base_color_texture = TextureRef{};
  source.materials[0].base_color_texture->image = ImageId(0);
}

Raster gradient(int width, int height) {
  Raster image{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (const int value : {255 * x / width, (y * 512 / height) % 256 / 2 + 64, 128, 255})
        image.rgba.push_back(static_cast<std::uint8_t>(value));
  return image;
}

// Result tube with the sources' materials on the preserved faces and the baked one on the junction.
struct Assembled {
  PolygonMesh mesh;
  std::vector<Material> materials;
  std::vector<Raster> images;
  ColoredMesh view() const { return {&mesh, materials, images}; }
};

Assembled assemble(const Scene& scene, const JunctionTexture& texture) {
  Assembled result{scene.result, {}, {}};
  result.mesh.uvs.assign(1, std::vector<Vec2>(result.mesh.corner_count(), Vec2::Zero()));
  for (int k = 0; k < 2; ++k) {
    const TestSource& source = scene.sources[k];
    Material material = source.materials[0];
    if (material.base_color_texture) {
      material.base_color_texture->image = ImageId(result.images.size());
      result.images.push_back(source.images[0]);
    }
    result.materials.push_back(material);
    for (int f = k == 0 ? 0 : 8 * kAround; f < (k == 0 ? 4 : 12) * kAround; ++f) {
      result.mesh.face_material[f] = MaterialId(k);
      for (int c = 0; c < 4 && !source.mesh.uvs.empty(); ++c)
        result.mesh.uvs[0][4 * f + c] = source.mesh.uvs[0][4 * (f - 4 * kAround * k) + c];
    }
  }
  result.materials.push_back(texture.material);
  if (texture.base_color.width > 0) {
    result.materials.back().base_color_texture->image = ImageId(result.images.size());
    result.images.push_back(texture.base_color);
  }
  for (std::size_t i = 0; i < scene.junction.size(); ++i) {
    result.mesh.face_material[scene.junction[i].index()] = MaterialId(2);
    for (int c = 0; c < 4 && !texture.uv.empty(); ++c)
      result.mesh.uvs[0][4 * scene.junction[i].index() + c] = texture.uv[4 * i + c];
  }
  return result;
}

Vec3 color_at_corner(const Assembled& result, FaceId face, int corner) {
  const auto c = static_cast<std::int32_t>(result.mesh.first_corner(face)) + corner;
  return base_color_at(result.view(), face, {{c, c, c}, Vec3(1, 0, 0)});
}

// By hand: red and blue; at the borders pure red and pure blue, half way half the light of each.
TEST(JunctionTexture, TwoColoursBlendInLinearLight) {
  const Scene scene = two_tubes(Vec3(1, 0, 0), Vec3(0, 0, 1));
  const auto texture = scene.bake();
  ASSERT_GT(texture.base_color.width, 0);
  const Assembled result = assemble(scene, texture);
  EXPECT_EQ(color_at_corner(result, scene.junction.front(), 0), Vec3(1, 0, 0));
  EXPECT_EQ(color_at_corner(result, scene.junction.back(), 2), Vec3(0, 0, 1));
  const Vec3 middle = color_at_corner(result, FaceId(6 * kAround), 0);  // x = 6
  EXPECT_NEAR(middle[0], 0.5, 0.05);  // one texel off the middle moves the share by so much
  EXPECT_NEAR(middle[2], 0.5, 0.05);
  EXPECT_EQ(middle[1], 0);
}

TEST(JunctionTexture, UvsLieInsideAndRasterIsComplete) {
  const Scene scene = two_tubes(Vec3(1, 0, 0), Vec3(0, 0, 1));
  const auto texture = scene.bake();
  ASSERT_EQ(texture.uv.size(), 4 * scene.junction.size());
  for (const Vec2& uv : texture.uv) {
    EXPECT_GT(uv.minCoeff(), 0);
    EXPECT_LT(uv.maxCoeff(), 1);
  }
  EXPECT_EQ(texture.base_color.rgba.size(), 4u * texture.base_color.width * texture.base_color.height);
}

// No texel is wanted by two faces: every face, drawn alone into the image, covers texel centres of its own.
TEST(JunctionTexture, FacesDoNotShareTexels) {
  const Scene scene = two_tubes(Vec3(1, 0, 0), Vec3(0, 0, 1));
  const auto texture = scene.bake();
  std::vector<int> owner(static_cast<std::size_t>(texture.base_color.width) * texture.base_color.height, -1);
  std::size_t covered = 0;
  for (std::size_t f = 0; f < scene.junction.size(); ++f) {
    std::array<Vec2, 4> p;
    for (int c = 0; c < 4; ++c)
      p[c] = texture.uv[4 * f + c].cwiseProduct(Vec2(texture.base_color.width, texture.base_color.height));
    for (int y = 0; y < texture.base_color.height; ++y)
      for (int x = 0; x < texture.base_color.width; ++x) {
        const Vec2 center(x + 0.5, y + 0.5);
        bool inside = true;
        for (int c = 0; c < 4; ++c) {
          const Vec2 edge = p[(c + 1) % 4] - p[c], to = center - p[c];
          inside = inside && edge.x() * to.y() - edge.y() * to.x() > 1e-6;
        }
        if (!inside) continue;
        int& at = owner[static_cast<std::size_t>(y) * texture.base_color.width + x];
        EXPECT_EQ(at, -1);
        at = static_cast<int>(f);
        ++covered;
      }
  }
  EXPECT_GT(covered, 4 * scene.junction.size());  // and the faces are there at all, facing the right way
}

// The law of the borders: flat palettes show no step.
TEST(JunctionTexture, FlatColoursShowNoStepAtTheBorders) {
  const Scene scene = two_tubes(Vec3(0.8, 0.3, 0.05), Vec3(0.1, 0.1, 0.6));
  const Assembled result = assemble(scene, scene.bake());
  const ColorSteps steps = color_steps(result.view(), scene.junction);
  EXPECT_EQ(steps.edges, 2u * kAround);
  EXPECT_LE(steps.largest, 2);
}

// Smooth textures on both sides: the step stays within what one texel of the gradient changes.
TEST(JunctionTexture, TexturesContinueAcrossTheBorders) {
  Scene scene = two_tubes(Vec3::Ones(), Vec3::Ones());
  paint(scene.sources[0], gradient(128, 128));
  paint(scene.sources[1], gradient(64, 64));
  const auto texture = scene.bake();
  const ColorSteps steps = color_steps(assemble(scene, texture).view(), scene.junction);
  EXPECT_LE(steps.mean, 2);
  EXPECT_LE(steps.p95, 8);
  EXPECT_GE(texture.texels_per_metre, 0.85 * texture.neighbours_density);
  // By hand: 128 texels along 12 m and 128 around 2 pi 2 m (12 chords of 1.0353 m), density sqrt(128 / 12 *
  // 128 / 12.42), and half of that on the other side; the median is one of the two.
  const double fine = 128 / std::sqrt(12 * 12 * 2 * 2 * std::sin(std::numbers::pi / 12));
  EXPECT_TRUE(std::abs(texture.neighbours_density - fine) < 1e-6 ||
              std::abs(texture.neighbours_density - fine / 2) < 1e-6);
}

// One colour needs no image; the colour comes out in the factor.
TEST(JunctionTexture, OneColourNeedsNoTexture) {
  const Vec3 color(0.2, 0.4, 0.6);
  const auto texture = two_tubes(color, color).bake();
  EXPECT_EQ(texture.base_color.width, 0);
  EXPECT_TRUE(texture.uv.empty());
  EXPECT_FALSE(texture.material.base_color_texture.has_value());
  EXPECT_LT((texture.material.base_color.head<3>() - color).norm(), kHalfStep);
}

// By hand: the shares are symmetric, so roughness is the mean of 0.2 and 0.6; double-sided from one is
// enough.
TEST(JunctionTexture, OtherPropertiesAreMeans) {
  Scene scene = two_tubes(Vec3(1, 0, 0), Vec3(0, 0, 1));
  scene.sources[0].materials[0].roughness = 0.2;
  scene.sources[1].materials[0].roughness = 0.6;
  scene.sources[0].materials[0].metallic = scene.sources[1].materials[0].metallic = 0;
  scene.sources[1].materials[0].double_sided = true;
  scene.sources[0].materials[0].unlit = true;
  const Material material = scene.bake().material;
  EXPECT_NEAR(material.roughness, 0.4, 1e-9);
  EXPECT_EQ(material.metallic, 0);
  EXPECT_TRUE(material.double_sided);
  EXPECT_FALSE(material.unlit);
}

// A thin wall: the nearest surface of source 0 is its inner side, which faces the other way; the outer side's
// colour is taken. By hand: the junction at radius 2 lies between an inner shell at 1.9 (turned inwards,
// green) and an outer at 2.15.
TEST(JunctionTexture, SkipsSurfacesThatFaceAway) {
  Scene scene = two_tubes(Vec3(1, 0, 0), Vec3(1, 0, 0));
  PolygonMesh shells = tube_mesh(13, kAround, 0, 1, 2.15);
  PolygonMesh inner = tube_mesh(13, kAround, 0, 1, 1.9);
  const auto offset = static_cast<int>(shells.positions.size());
  for (std::size_t f = 0; f < inner.face_count(); ++f) {
    const auto c = inner.face(FaceId(f));
    testing::add_quad(shells, c[3].value + offset, c[2].value + offset, c[1].value + offset,
                      c[0].value + offset);
    shells.face_material.back() = MaterialId(1);
  }
  shells.positions.insert(shells.positions.end(), inner.positions.begin(), inner.positions.end());
  for (auto& source : scene.sources) {
    const auto factor = source.factor;
    source = source_of(shells, Vec3(1, 0, 0));
    source.factor = factor;
    source.materials.resize(2);
    source.materials[1].base_color = Vec4(0, 1, 0, 1);
  }
  const auto texture = scene.bake();
  EXPECT_EQ(texture.base_color.width, 0);
  EXPECT_EQ(texture.material.base_color, Vec4(1, 0, 0, 1));
}

TEST(JunctionTexture, SameBytesForAnyNumberOfThreads) {
  Scene scene = two_tubes(Vec3::Ones(), Vec3::Ones());
  paint(scene.sources[0], gradient(64, 64));
  set_thread_limit(1);
  const auto alone = scene.bake();
  set_thread_limit(4);
  EXPECT_EQ(alone.base_color.rgba, scene.bake().base_color.rgba);
}

TEST(JunctionTexture, ScaleFree) {
  Scene scene = two_tubes(Vec3(1, 0, 0), Vec3(0, 0, 1)), large = two_tubes(Vec3(1, 0, 0), Vec3(0, 0, 1));
  for (Vec3& p : large.result.positions) p *= 1024;  // a power of two: the same bits but for the exponent
  for (auto& source : large.sources) {
    for (Vec3& p : source.mesh.positions) p *= 1024;
    std::vector<std::array<std::int32_t, 3>> soup;
    for (const auto& t : source.triangles.triangles) soup.push_back({t[0].value, t[1].value, t[2].value});
    source.bvh = std::make_unique<TriangleBvh>(source.mesh.positions, soup);
  }
  EXPECT_EQ(scene.bake().base_color.rgba, large.bake().base_color.rgba);
}

TEST(JunctionTexture, NoFacesNoTexture) {
  Scene scene = two_tubes(Vec3(1, 0, 0), Vec3(0, 0, 1));
  scene.junction.clear();
  const auto texture = scene.bake();
  EXPECT_EQ(texture.base_color.width, 0);
  EXPECT_TRUE(texture.uv.empty());
}

// By hand: two squares side by side, one black, one at linear 1: the step across their edge is 255.
TEST(ColorSteps, MeasuresTheEdgeBetween) {
  const PolygonMesh mesh = [] {
    PolygonMesh grid = testing::flat_grid(1, 2);
    grid.face_material = {MaterialId(0), MaterialId(1)};
    return grid;
  }();
  std::vector<Material> materials(2);
  materials[0].base_color = Vec4(0, 0, 0, 1);
  const ColorSteps steps = color_steps({&mesh, materials, {}}, std::vector{FaceId(1)});
  EXPECT_EQ(steps.edges, 1u);
  EXPECT_EQ(steps.largest, 255);
  EXPECT_EQ(steps.mean, 255);
  EXPECT_EQ(color_steps({&mesh, materials, {}}, {}).edges, 0u);
}

}  // namespace
}  // namespace skinforge
