#include "base/file_digest.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "testing/temporary_folder.h"

namespace skinforge {
namespace {
namespace fs = std::filesystem;
using testing::TemporaryFolder;

constexpr std::int64_t kNoTick = 0;

Digest digest_of(std::string_view text) {
  return sha256(std::as_bytes(std::span(text)));
}

// Sizes around the pieces it is read in: the same digest as of the bytes in hand.
TEST(FileDigest, IsThatOfTheBytes) {
  const TemporaryFolder folder;
  for (const std::size_t size : {0U, 1U, 65535U, 65536U, 65537U, 200000U}) {
    std::string text(size, 'x');
    for (std::size_t i = 0; i < size; i += 7) text[i] = static_cast<char>(i);
    std::ofstream(folder / "file", std::ios::binary) << text;
    EXPECT_EQ(sha256_of_file(folder / "file"), sha256(std::as_bytes(std::span(text)))) << size;
  }
}

TEST(FileDigest, NoneOfWhatCannotBeRead) {
  const TemporaryFolder folder;
  EXPECT_FALSE(sha256_of_file(folder / "none"));
  EXPECT_FALSE(sha256_of_file(folder.path()));
}

// Bytes are believed to be those of the stamp, so that a file need not be hashed: what comes back shows it.
TEST(FileDigests, RemembersFromProcessToProcess) {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "abc";
  FileDigests first(kNoTick);
  EXPECT_EQ(first.of(folder / "file"), digest_of("abc"));
  const std::string text = first.news();

  FileDigests next(kNoTick);
  next.recall(text);
  EXPECT_EQ(next.of(std::as_bytes(std::span("not read")), *stamp_of(folder / "file")), digest_of("abc"));
  EXPECT_EQ(next.news(), "");
  EXPECT_EQ(FileDigests(kNoTick).news(), "");

  std::string damaged = text;
  damaged[damaged.size() - 5] ^= 1;
  FileDigests careful(kNoTick);
  careful.recall(damaged);
  EXPECT_EQ(careful.of(folder / "file"), digest_of("abc"));
}

// Of the same size, and with its old time: the time of change tells.
TEST(FileDigests, SeesAChangeThatHidesItself) {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "abc";
  FileDigests digests(kNoTick);
  EXPECT_EQ(digests.of(folder / "file"), digest_of("abc"));
  const auto time = fs::last_write_time(folder / "file");
  std::fstream(folder / "file", std::ios::in | std::ios::out) << "abd";
  fs::last_write_time(folder / "file", time);
  EXPECT_EQ(digests.of(folder / "file"), digest_of("abd"));
}

TEST(FileDigests, ForgetsWhatWasNotAskedForAndWhatIsYoung) {
  const TemporaryFolder folder;
  for (const char* name : {"a", "b"}) std::ofstream(folder / name) << name;
  FileDigests both(kNoTick), one(kNoTick), young;
  for (const char* name : {"a", "b"}) both.of(folder / name);
  one.recall(both.news());
  one.of(folder / "b");
  EXPECT_LT(one.news().size(), both.news().size());
  young.of(folder / "a");
  EXPECT_EQ(young.news(), "");
}

TEST(FileDigests, NoneOfWhatIsNoFile) {
  const TemporaryFolder folder;
  FileDigests digests;
  EXPECT_FALSE(digests.of(folder / "none"));
  EXPECT_FALSE(digests.of(folder.path()));
}

}  // namespace
}  // namespace skinforge
