#include "io/obj_check.h"

#include <gmock/gmock.h>

#include "base/error.h"

namespace skinforge {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

InputFile file_of(const std::string& path, const std::string& text) {
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return {path, Bytes(begin, begin + text.size()), {}};
}

/// "code place: message" of each warning.
std::vector<std::string> warnings(const std::string& obj, const std::string& mtl = "") {
  std::vector<Issue> issues;
  std::vector<InputFile> files = {file_of("a.obj", obj)};
  if (!mtl.empty()) files.push_back(file_of("a.mtl", mtl));
  check_obj(files, issues);
  std::vector<std::string> lines;
  for (const Issue& issue : issues) {
    EXPECT_EQ(issue.severity, Severity::Warning);
    lines.push_back(issue.code + " " + issue.place + ": " + issue.message);
  }
  return lines;
}

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST(ObjCheck, SoundFilesAreQuiet) {
  EXPECT_THAT(warnings(""), IsEmpty());
  EXPECT_THAT(warnings(kTriangle), IsEmpty());
  EXPECT_THAT(warnings("usemtl skin\r\n" + kTriangle, "# library\nnewmtl  skin \nKd 1 0 0\n"), IsEmpty());
}

TEST(ObjCheck, FacesWithoutCorners) {
  EXPECT_THAT(warnings(kTriangle + "f\nf \t\r\nf 3 2 1"),
              ElementsAre("obj-face-empty scene: 2 faces without corners are left out, the first in line 5"));
}

TEST(ObjCheck, MaterialsOfNoLibrary) {
  EXPECT_THAT(warnings("usemtl a\nusemtl b\nusemtl b\n", "newmtl a\n"),
              ElementsAre(HasSubstr("material b: ")));
  EXPECT_THAT(warnings("usemtl a\nusemtl b\n"),
              ElementsAre(HasSubstr("material a"), HasSubstr("material b")));
}

TEST(ObjCheck, LinesThatNobodyMeant) {
  EXPECT_THAT(warnings("#" + std::string(65'535, 'x') + "\n"), IsEmpty());
  EXPECT_THAT(warnings("\n#" + std::string(65'536, 'x')),
              ElementsAre("obj-line-long scene: 1 lines of more than 65536 bytes, the first is line 2"));
}

}  // namespace
}  // namespace skinforge
