#include <gmock/gmock.h>

#include <cstring>
#include <limits>

#include "base/error.h"
#include "io/number_table.h"
#include "io/plain_mesh.h"
#include "io/tgf_reader.h"
#include "testing/assets.h"

namespace skinforge {
namespace {

InputFile file_of(const std::string& name, const std::string& text) {
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return {name, Bytes(begin, begin + text.size()), {}};
}

template <class Read>
std::string refusal(Read read, const std::string& name, const std::string& text) {
  try {
    read(file_of(name, text));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::BadInput);
    return error.what();
  }
  return "nothing was refused";
}

// Columns come first, and the values run down the columns.
TEST(NumberTable, TextByColumns) {
  const Eigen::MatrixXd table = read_dmat(file_of("a.dmat", "2 3\n1 2\r\n-0\n0. 5e0\n 6"));
  EXPECT_EQ(table, (Eigen::MatrixXd(3, 2) << 1, 0, 2, 5, 0, 6).finished());
}

TEST(NumberTable, BinaryForm) {
  const double values[] = {1.5, -2, 3, 4};
  std::string text = "0 0\n2 2\n";
  text.append(reinterpret_cast<const char*>(values), sizeof values);
  EXPECT_EQ(read_dmat(file_of("a.dmat", text)), (Eigen::MatrixXd(2, 2) << 1.5, 3, -2, 4).finished());
  text.pop_back();
  EXPECT_EQ(refusal(read_dmat, "a.dmat", text),
            "a.dmat: line 2: 2 columns of 2 rows take 32 bytes, the file has 31");
}

TEST(NumberTable, RoundTripToTheBit) {
  const Eigen::MatrixXd table =
      (Eigen::MatrixXd(2, 2) << 0.1, 1.0 / 3, -1e-300, 12345678901234567.0).finished();
  EXPECT_EQ(read_dmat(file_of("a.dmat", write_dmat(table))), table);
}

TEST(NumberTable, RefusesWhatIsBroken) {
  EXPECT_EQ(refusal(read_dmat, "a.dmat", "2 2\n1 2 3"), "a.dmat: line 2: the file ends too early");
  EXPECT_EQ(refusal(read_dmat, "a.dmat", "1 2\n1 2 3"),
            "a.dmat: line 2: more values than 1 columns of 2 rows");
  EXPECT_EQ(refusal(read_dmat, "a.dmat", "1 2\n1 nan"), "a.dmat: line 2: a value is not finite");
  EXPECT_EQ(refusal(read_dmat, "a.dmat", "1 2\n1 two"), "a.dmat: line 2: a value is missing, found \"two\"");
  EXPECT_EQ(refusal(read_dmat, "a.dmat", "2000000000 2000000000\n1"),
            "a.dmat: line 1: 2000000000 columns of 2000000000 rows are more than the file holds");
  EXPECT_EQ(refusal(read_dmat, "a.dmat", ""), "a.dmat: line 0: the file ends too early");
}

// Joints in any order, garbage behind, sections of other tools.
TEST(TgfReader, JointsAndBones) {
  const BoneGraph graph =
      read_tgf(file_of("a.tgf", "2 0 1 0 2.798e+199 1e-322\n1 0 0 0\n 3 1 1 0 x\n#\n1 2 0 1\n2 3\n#\n1 1\n"));
  ASSERT_EQ(graph.joints.size(), 3u);
  EXPECT_EQ(graph.joints[1], Vec3(0, 1, 0));
  EXPECT_THAT(graph.bones, ::testing::ElementsAre(std::array{0, 1}, std::array{1, 2}));
}

TEST(TgfReader, RefusesWhatIsBroken) {
  EXPECT_EQ(refusal(read_tgf, "a.tgf", "1 0 0 0\n3 0 0 1\n#\n1 3\n"), "a.tgf: line 4: joint 2 is missing");
  EXPECT_EQ(refusal(read_tgf, "a.tgf", "1 0 0 0\n1 0 0 1\n"), "a.tgf: line 2: joint 1 is given twice");
  EXPECT_EQ(refusal(read_tgf, "a.tgf", "1 0 0\n"), "a.tgf: line 1: a coordinate is missing, found \"\"");
  EXPECT_EQ(refusal(read_tgf, "a.tgf", "1 0 0 inf\n"), "a.tgf: line 1: a coordinate is not finite");
  EXPECT_EQ(refusal(read_tgf, "a.tgf", "1 0 0 0\n2 0 1 0\n#\n1 5\n"), "a.tgf: line 4: there is no joint 5");
  EXPECT_EQ(refusal(read_tgf, "a.tgf", "1 0 0 0\n#\n1 1\n"), "a.tgf: line 3: a bone from joint 1 to itself");
  EXPECT_EQ(refusal(read_tgf, "a.tgf", "1 0 0 0\n2 0 1 0\n#\n"), "a.tgf: line 3: a skeleton without bones");
}

TEST(PlainMesh, ObjAsTheFileCounts) {
  const PolygonMesh mesh = read_plain_mesh(file_of(
      "a.obj",
      "mtllib x\nv 0 0 0\nv 1 0 0 1 1 1\nvt 0 0\nv 1 1 0\nv 0 0 0\nf 1/1 2//3 3/1/1 # quad\nf -1 -3 -2\n"));
  EXPECT_EQ(mesh.vertex_count(), 4u);  // the two equal positions stay two
  EXPECT_THAT(mesh.corners, ::testing::ElementsAre(VertexId(0), VertexId(1), VertexId(2), VertexId(3),
                                                   VertexId(1), VertexId(2)));
}

TEST(PlainMesh, RefusesWhatIsBroken) {
  EXPECT_EQ(refusal(read_plain_mesh, "a.obj", "v 0 0 0\nf 1 2 3\n"), "a.obj: line 2: vertex 2 of 1");
  EXPECT_EQ(refusal(read_plain_mesh, "a.obj", "v 0 0 0\nf 0 1 1\n"), "a.obj: line 2: vertex 0 of 1");
  EXPECT_EQ(refusal(read_plain_mesh, "a.obj", "v 0 0 0\nf 1 1\n"), "a.obj: line 2: a face of 2 corners");
  EXPECT_EQ(refusal(read_plain_mesh, "a.obj", "v 0 nan 0\n"), "a.obj: line 1: a coordinate is not finite");
}

// Numbers of the README beside the data.
TEST(RigFiles, ReadTheCourse) {
  SKINFORGE_NEEDS_SHARED();
  const auto file = [](const char* name) {
    return read_input_file(testing::shared_file(std::string("assignment6/") + name));
  };
  const BoneGraph hand = read_tgf(file("hand/skeleton.tgf"));
  EXPECT_EQ(hand.joints.size(), 21u);
  EXPECT_EQ(hand.bones[10], (std::array{0, 1}));
  EXPECT_EQ(read_dmat(file("context-aware/pose.dmat")).rows(), 11032);
  const PolygonMesh human = read_plain_mesh(file("context-aware/rest.obj"));
  EXPECT_EQ(human.vertex_count(), 18453u);
  EXPECT_EQ(human.face_count(), 36902u);
  EXPECT_EQ(read_plain_mesh(file("hand/hand.off")).corners, read_plain_mesh(file("hand/rest.obj")).corners);
}

}  // namespace
}  // namespace skinforge
