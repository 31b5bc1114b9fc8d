#include "base/file_digest.h"

#include <gtest/gtest.h>

#include <fstream>

#include "testing/temporary_folder.h"

namespace skinforge {
namespace {

// Sizes around the pieces it is read in: the same digest as of the bytes in hand.
TEST(FileDigest, IsThatOfTheBytes) {
  const testing::TemporaryFolder folder;
  for (const std::size_t size : {0U, 1U, 65535U, 65536U, 65537U, 200000U}) {
    std::string text(size, 'x');
    for (std::size_t i = 0; i < size; i += 7) text[i] = static_cast<char>(i);
    std::ofstream(folder / "file", std::ios::binary) << text;
    EXPECT_EQ(sha256_of_file(folder / "file"), sha256(std::as_bytes(std::span(text)))) << size;
  }
}

TEST(FileDigest, NoneOfWhatCannotBeRead) {
  const testing::TemporaryFolder folder;
  EXPECT_FALSE(sha256_of_file(folder / "none"));
  EXPECT_FALSE(sha256_of_file(folder.path()));
}

}  // namespace
}  // namespace skinforge
