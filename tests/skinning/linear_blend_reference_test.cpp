#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "skinning/linear_blend.h"
#include "testing/assets.h"

namespace skinforge {
namespace {

constexpr double kReference = 1e-12;  // both reference programs agree to it; diagonals lie between 1 and 3

nlohmann::json read_json(const std::string& name) {
  std::ifstream file(testing::shared_file("assignment6/" + name));
  return nlohmann::json::parse(file);
}

// Vertex lines of an OBJ file.
std::vector<Vec3> read_obj_positions(const std::string& name) {
  std::ifstream file(testing::shared_file("assignment6/" + name));
  std::vector<Vec3> positions;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string kind;
    Vec3 p;
    if (words >> kind >> p.x() >> p.y() >> p.z() && kind == "v") positions.push_back(p);
  }
  return positions;
}

Vec3 vec3(const nlohmann::json& j) {
  return {j[0].get<double>(), j[1].get<double>(), j[2].get<double>()};
}

struct ReferenceCase {
  const char* name;
  const char* frame;
};

class LinearBlendReference : public ::testing::TestWithParam<ReferenceCase> {};

// The course's characters, posed by two programs that are not ours (assignment6/README.md): sampled vertices,
// all bones.
TEST_P(LinearBlendReference, PosedVerticesAgree) {
  SKINFORGE_NEEDS_SHARED();
  const std::string folder = std::string("reference/") + GetParam().name;
  const auto given = read_json(folder + "/weights.json");
  const auto frame = read_json(folder + "/" + GetParam().frame);
  const auto rest = read_obj_positions(given["inputs"]["mesh"]);
  std::vector<Affine3> palette;
  for (std::size_t b = 0; b < frame["bone_quat_xyzw"].size(); ++b) {
    const auto& q = frame["bone_quat_xyzw"][b];
    Affine3 bone;
    bone.linear() =
        quaternion_xyzw(q[0].get<double>(), q[1].get<double>(), q[2].get<double>(), q[3].get<double>())
            .toRotationMatrix();
    bone.translation() = vec3(frame["bone_translation"][b]);
    palette.push_back(bone);
  }
  std::vector<Vec3> positions;
  SkinWeights weights;
  for (std::size_t i = 0; i < given["vertex_ids"].size(); ++i) {
    positions.push_back(rest.at(given["vertex_ids"][i].get<std::size_t>()));
    std::vector<Influence> row;
    for (std::size_t b = 0; b < palette.size(); ++b)
      row.push_back({JointId(b), given["weights"][i][b].get<double>()});
    weights.push_row(row);
  }
  ASSERT_EQ(frame["vertex_ids"], given["vertex_ids"]);
  const auto posed = linear_blend(positions, weights, palette);
  double farthest_moved = 0;
  for (std::size_t i = 0; i < posed.size(); ++i) {
    EXPECT_LT((posed[i] - vec3(frame["lbs"][i])).norm(), kReference) << "sampled vertex " << i;
    farthest_moved = std::max(farthest_moved, (posed[i] - positions[i]).norm());
  }
  EXPECT_GT(farthest_moved, 0.01) << "the frame is a pose and not the rest shape";
}

INSTANTIATE_TEST_SUITE_P(Course, LinearBlendReference,
                         ::testing::Values(ReferenceCase{"hand_sequence", "f33.json"},
                                           ReferenceCase{"human", "f34.json"},
                                           ReferenceCase{"arm", "f4.json"},
                                           ReferenceCase{"cylinder_target", "t0.5.json"}),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace skinforge
