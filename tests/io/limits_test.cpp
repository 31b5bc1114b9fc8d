// Each limit from both sides: what a file has is let through, one less is refused with the number and the
// option.
#include "base/limits.h"

#include <gmock/gmock.h>

#include <cmath>

#include "base/error.h"
#include "io/export.h"
#include "io/fbx_document.h"
#include "io/import.h"
#include "testing/assets.h"

namespace skinforge {
namespace {

using ::testing::HasSubstr;

class LimitsTest : public ::testing::TestWithParam<const char*> {
 protected:
  ~LimitsTest() override { set_limits({}); }

  /// What `work` says with this limit; empty when it is content.
  template <class Work>
  static std::string complaint(const char* name, std::uint64_t value, Work&& work) {
    Limits changed;
    set_limit(changed, std::string(name) + "=" + std::to_string(value));
    set_limits(changed);
    std::string message;
    try {
      work();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::BadInput);
      message = error.what();
    }
    set_limits({});
    return message;
  }

  template <class Work>
  static void expect_both_sides(const char* name, std::uint64_t value, Work&& work) {
    SCOPED_TRACE(name);
    ASSERT_GT(value, 1u);
    EXPECT_EQ(complaint(name, value, work), "");
    const std::string message = complaint(name, value - 1, work);
    EXPECT_THAT(message, HasSubstr("the limit is " + std::to_string(value - 1)));
    EXPECT_THAT(message, HasSubstr("--limit " + std::string(name) + "=N raises it"));
  }
};

std::uint64_t depth_of(const RawScene& scene) {
  std::uint64_t deepest = 0;
  for (std::int32_t node = 0; node < static_cast<std::int32_t>(scene.nodes.size()); ++node) {
    std::uint64_t depth = 0;
    for (auto at = node; at >= 0; at = scene.nodes[static_cast<std::size_t>(at)].parent) ++depth;
    deepest = std::max(deepest, depth);
  }
  return deepest;
}

std::uint64_t vertices_of(const RawScene& scene) {
  std::uint64_t count = 0;
  for (const auto& mesh : scene.meshes)
    for (const auto& p : mesh.primitives) count += p.positions.size() * (1 + p.morph_offsets.size());
  return count;
}

/// Times and values; linear tracks alone.
template <class Value>
std::uint64_t numbers_in(const Track<Value>& track) {
  EXPECT_NE(track.interpolation, Interpolation::CubicSpline);
  constexpr std::size_t kComponents = sizeof(Value) / sizeof(double);
  return track.times.size() + kComponents * track.values.size();
}

std::uint64_t numbers_in_keys(const RawScene& scene) {
  std::uint64_t count = 0;
  for (const auto& animation : scene.animations)
    for (const auto& tracks : animation.nodes)
      count += numbers_in(tracks.translation) + numbers_in(tracks.rotation) + numbers_in(tracks.scale);
  return count;
}

template <class Value>
double latest(const Track<Value>& track) {
  return track.times.empty() ? 0 : track.times.back();
}

double latest_key(const RawScene& scene) {
  double last = 0;
  for (const auto& animation : scene.animations)
    for (const auto& tracks : animation.nodes)
      last = std::max({last, latest(tracks.translation), latest(tracks.rotation), latest(tracks.scale)});
  return last;
}

TEST_P(LimitsTest, OfAScene) {
  const std::string path = testing::repository_file(GetParam());
  const auto read = [&] { return read_scene(read_input_files(path)); };
  const RawScene scene = read();
  expect_both_sides("nodes", scene.nodes.size(), read);
  expect_both_sides("depth", depth_of(scene), read);
  const bool is_glb = path.ends_with(".glb");
  if (is_glb) expect_both_sides("joints", scene.skins.at(0).joints.size(), read);
  if (is_glb) expect_both_sides("vertices", vertices_of(scene), read);
  if (is_glb) expect_both_sides("keys", numbers_in_keys(scene), read);
  expect_both_sides("clip", static_cast<std::uint64_t>(std::ceil(latest_key(scene))), read);
}

INSTANTIATE_TEST_SUITE_P(Files, LimitsTest, ::testing::Values("data/horse.glb", "data/human.fbx"),
                         [](const auto& file) { return std::string(file.param).substr(5, 5); });

/// By hand: three numbers of eight bytes each.
TEST_F(LimitsTest, OfAPackedBlock) {
  const Bytes bytes(24);
  FbxArray array;
  array.count = 3;
  array.data = bytes;
  expect_both_sides("inflate", 24, [&] { numbers(array); });
}

TEST_F(LimitsTest, OfAFile) {
  const std::string path = testing::repository_file("data/human.obj");
  expect_both_sides("file", std::filesystem::file_size(path), [&] { read_input_file(path); });
}

TEST_F(LimitsTest, OfAnImage) {
  const InputFile file = read_input_file(testing::repository_file("data/human.png"));
  const Image image{"human", "image/png", file.bytes};
  const Raster raster = decode_image(image);
  const auto width = static_cast<std::uint64_t>(raster.width),
             height = static_cast<std::uint64_t>(raster.height);
  const auto decode = [&] { decode_image(image); };
  expect_both_sides("image-side", std::max(width, height), decode);
  expect_both_sides("pixels", width * height, decode);
  expect_both_sides("memory", 12 * width * height, decode);
}

/// The child is told, too.
TEST_F(LimitsTest, OfTheImportProcess) {
  const std::string path = testing::repository_file("data/human.fbx");
  const auto read = [&] { read_scene(read_input_files(path)); };
  EXPECT_EQ(complaint("import-memory", 1ull << 30, read), "");
  EXPECT_THAT(complaint("import-memory", 1 << 20, read),
              HasSubstr("importer needs more than 1 MB of memory; --limit import-memory=N gives more"));
  EXPECT_THAT(complaint("vertices", 10, read), HasSubstr("the limit is 10; --limit vertices=N raises it"));
  EXPECT_THAT(complaint("inflate", 10, read), HasSubstr("human.fbx: "));
}

}  // namespace
}  // namespace skinforge
