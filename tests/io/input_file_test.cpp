#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>

#include "base/error.h"
#include "io/import.h"
#include "testing/assets.h"
#include "testing/temporary_folder.h"

namespace skinforge {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class InputFileTest : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }
  /// A .gltf whose one buffer and one image are named as given.
  std::string write_gltf(const std::string& buffer, const std::string& image) const {
    return write("asset/m.gltf", R"({"asset":{"version":"2.0"},"images":[{"uri":")" + image +
                                     R"("}],"buffers":[{"byteLength":1,"uri":")" + buffer + R"("}]})");
  }
  std::vector<std::string> names(const std::string& path) const {
    std::vector<std::string> list;
    for (const InputFile& file : read_input_files(path))
      list.push_back(std::filesystem::path(file.path).lexically_relative(folder_.path()).string());
    return list;
  }
  static std::string message(const std::string& path) {
    try {
      read_input_files(path);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::BadInput);
      return error.what();
    }
    return "no error";
  }

  testing::TemporaryFolder folder_;
};

TEST_F(InputFileTest, ReadsBytesAndDigest) {
  const InputFile file = read_input_file(write("a.bin", "abc"));
  EXPECT_EQ(file.bytes.size(), 3u);
  // FIPS 180-2, appendix B.1.
  EXPECT_EQ(file.digest.hex(), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_TRUE(read_input_file(write("empty", "")).bytes.empty());
}

TEST_F(InputFileTest, SaysWhyAFileCannotBeRead) {
  const std::string absent = (folder_ / "absent.glb").string();
  EXPECT_EQ(message(absent), absent + ": no such file");
  EXPECT_EQ(message(folder_.path().string()), folder_.path().string() + ": not a regular file");
  const std::string pipe = (folder_ / "pipe").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(message(pipe), pipe + ": not a regular file");
  const std::string four = write("four", "1234");
  EXPECT_EQ(read_input_file(four, 4).bytes.size(), 4u);
  try {
    read_input_file(four, 3);
    FAIL() << "a file over the limit was read";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()), four + ": 4 bytes, the limit is 3; --limit file=N raises it");
  }
}

TEST_F(InputFileTest, NamesTheNearestFileOfThatKind) {
  write("human.glb", "x");
  write("human.txt", "x");
  const std::string absent = (folder_ / "humon.glb").string();
  try {
    read_input_files(absent);
    FAIL() << "read what is not there";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()), absent + ": no such file (nearest: \"human.glb\")");
  }
}

TEST_F(InputFileTest, FindsBuffersAndImagesOfAGltf) {
  write("asset/my data.bin", "x");
  write("asset/tex/i.png", "y");
  EXPECT_THAT(names(write_gltf("my%20data.bin", "tex/i.png")),
              ElementsAre("asset/m.gltf", "asset/my data.bin", "asset/tex/i.png"));
  EXPECT_THAT(names(write_gltf("data:;base64,AAAA", "my%20data.bin")),
              ElementsAre("asset/m.gltf", "asset/my data.bin"));
}

TEST_F(InputFileTest, AMissingImageIsNoErrorAMissingBufferIs) {
  write("asset/a.bin", "x");
  EXPECT_THAT(names(write_gltf("a.bin", "absent.png")), ElementsAre("asset/m.gltf", "asset/a.bin"));
  EXPECT_THAT(message(write_gltf("absent.bin", "a.bin")), HasSubstr("asset/absent.bin: no such file"));
}

TEST_F(InputFileTest, StaysInTheFolderOfTheAsset) {
  write("secret.bin", "x");
  write("asset/a.bin", "x");
  for (const char* uri :
       {"../secret.bin", "%2e%2e/secret.bin", "sub/../../secret.bin", "..\\\\secret.bin", "/etc/hostname",
        "file:///etc/hostname", "http://127.0.0.1/a.bin", "a%00.bin", "a%0A.bin", "a%2", ""}) {
    const std::string buffer_error = message(write_gltf(uri, "a.bin"));
    EXPECT_THAT(buffer_error, HasSubstr("/buffers/0/uri: ")) << uri;
    EXPECT_THAT(message(write_gltf("a.bin", uri)), HasSubstr("/images/0/uri: ")) << uri;
    EXPECT_EQ(buffer_error.find('\n'), std::string::npos);
  }
  // Decoded once: the name on disk is literally "%2e.bin".
  write("asset/%2e.bin", "x");
  EXPECT_THAT(names(write_gltf("%252e.bin", "a.bin")),
              ElementsAre("asset/m.gltf", "asset/%2e.bin", "asset/a.bin"));
}

TEST_F(InputFileTest, DoesNotFollowALinkOutOfTheFolder) {
  write("secret.bin", "x");
  write("asset/inside.bin", "x");
  std::filesystem::create_symlink("../secret.bin", folder_ / "asset/out.bin");
  std::filesystem::create_symlink("inside.bin", folder_ / "asset/in.bin");
  EXPECT_THAT(message(write_gltf("out.bin", "inside.bin")),
              HasSubstr("leads out of the folder of the asset"));
  EXPECT_EQ(names(write_gltf("in.bin", "inside.bin")).size(), 3u);
}

TEST_F(InputFileTest, FindsTheMaterialsAndTexturesOfAnObj) {
  write("asset/my lib.mtl", "newmtl a\nmap_Kd -s 1 1 1 tex.png\nbump bump map.png\nmap_Kd absent.png\n");
  write("asset/tex.png", "x");
  write("asset/bump map.png", "x");
  const std::string obj = write("asset/m.obj", "# c\nmtllib my lib.mtl\r\nv 0 0 0\n");
  EXPECT_THAT(names(obj),
              ElementsAre("asset/m.obj", "asset/my lib.mtl", "asset/tex.png", "asset/bump map.png"));
  EXPECT_THAT(message(write("asset/n.obj", "mtllib ../secret.mtl\n")),
              HasSubstr("leaves the folder of the asset"));
}

}  // namespace
}  // namespace skinforge
