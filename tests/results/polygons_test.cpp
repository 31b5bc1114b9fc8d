// Polygons leave the tool as polygons: in the OBJ, by FB_ngon_encoding in the GLB, and in Blender.
#include <algorithm>
#include <sstream>

#include "io/import.h"
#include "results/goal_test.h"

namespace skinforge {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using testing::Program;
using testing::ProgramResult;

using Point = std::array<float, 3>;
using Polygon = std::vector<Point>;  // from its least corner on

Polygon from_least(Polygon polygon) {
  std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
  return polygon;
}

std::vector<Polygon> polygons_of_obj(const fs::path& path) {
  std::ifstream file(path);
  std::vector<Point> points;
  std::vector<Polygon> polygons;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") {
      Point& p = points.emplace_back();
      words >> p[0] >> p[1] >> p[2];
    } else if (word == "f") {
      Polygon polygon;
      while (words >> word) polygon.push_back(points[std::stoul(word) - 1]);
      polygons.push_back(from_least(polygon));
    }
  }
  std::sort(polygons.begin(), polygons.end());
  return polygons;
}

std::vector<Polygon> polygons_of_glb(const fs::path& path) {
  IssueSink issues;
  const PolygonMesh mesh = import_character(path.string(), issues).mesh;
  std::vector<Polygon> polygons;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    Polygon polygon;
    for (const VertexId v : mesh.face(FaceId(f))) {
      const Vec3& p = mesh.positions[v.index()];
      polygon.push_back({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
    }
    polygons.push_back(from_least(polygon));
  }
  std::sort(polygons.begin(), polygons.end());
  return polygons;
}

std::map<std::size_t, std::size_t> count_by_size(const std::vector<Polygon>& polygons) {
  std::map<std::size_t, std::size_t> counts;
  for (const Polygon& p : polygons) ++counts[p.size()];
  return counts;
}

// A recipe built with an OBJ and without clips.
class Polygons : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    fs::path recipe = testing::repository_file(std::string("recipes/") + GetParam());
    if (!fs::exists(recipe)) {
      SKINFORGE_NEEDS_SHARED();
      recipe = testing::shared_file(std::string("recipes/") + GetParam());
    }
    json text = json::parse(std::ifstream(recipe));
    for (json& input : text.at("inputs"))
      input = fs::relative(fs::canonical(recipe.parent_path() / input.get<std::string>()),
                           fs::canonical(folder_.path()))
                  .string();
    text["animation"] = {{"clips", json::array()}};
    text["output"] = {{"glb", "x.glb"}, {"obj", "x.obj"}};
    std::ofstream(folder_ / "x.json") << text.dump();
    const ProgramResult run =
        Program(SKINFORGE_BINARY, {"build", "x.json", "--out", "out", "--cache", "cache", "--report", "json"},
                folder_.path())
            .finish();
    ASSERT_EQ(run.status, 0) << run.err;
  }
  fs::path file(const char* name) const { return folder_ / "out" / name; }

  testing::TemporaryFolder folder_;
};

// A quad that was two triangles of different normals has two vertices at each end of its diagonal in a GLB,
// which FB_ngon_encoding cannot join: it comes back as these two triangles. Characters without such quads
// lose none.
TEST_P(Polygons, ComeBackAsTheSame) {
  const auto obj = polygons_of_obj(file("x.obj")), glb = polygons_of_glb(file("x.glb"));
  const json mesh = json::parse(std::ifstream(file("report.json"))).at("mesh");
  auto counts = count_by_size(obj), back = count_by_size(glb);
  EXPECT_EQ(counts[4], mesh.at("quads"));
  EXPECT_EQ(counts[3], mesh.at("triangles"));
  EXPECT_EQ(obj.size(), mesh.at("faces"));
  EXPECT_EQ(back[3] + 2 * back[4], counts[3] + 2 * counts[4]);
  EXPECT_LE(back[4], counts[4]);
  const bool is_smooth = fs::exists(testing::repository_file(std::string("recipes/") + GetParam()));
  if (is_smooth) {
    EXPECT_EQ(back, counts);
  }
}

TEST_P(Polygons, BlenderShowsTheSame) {
  const ProgramResult run = testing::run_blender("count_polygons.py", {file("x.obj")}, folder_.path());
  if (run.status == 127)
    GTEST_SKIP() << "NO BLENDER: the polygons of the OBJ were not seen by another program";
  ASSERT_EQ(run.status, 0) << run.out << run.err;
  const auto begin = run.out.find("polygons ");
  ASSERT_NE(begin, std::string::npos) << run.out << run.err;
  const json seen = json::parse(run.out.substr(begin + 9, run.out.find('\n', begin) - begin - 9));
  std::map<std::size_t, std::size_t> counts;
  for (const auto& [size, count] : seen.items()) counts[std::stoul(size)] = count;
  EXPECT_EQ(counts, count_by_size(polygons_of_obj(file("x.obj"))));
}

INSTANTIATE_TEST_SUITE_P(Recipes, Polygons,
                         ::testing::Values("centaur.json", "composite.json", "d1_centaur.json",
                                           "d3_dragon_winged_horse.json", "d6_head_swap_woman.json"),
                         [](const auto& recipe) {
                           std::string name = recipe.param;
                           name.resize(name.find('.'));
                           return name;
                         });

}  // namespace
}  // namespace skinforge
