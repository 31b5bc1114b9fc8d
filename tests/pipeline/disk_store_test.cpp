#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <thread>

#include "pipeline/cache.h"
#include "pipeline/text_stage.h"
#include "testing/temporary_folder.h"

namespace skinforge {
namespace {
namespace fs = std::filesystem;
using testing::bytes_of;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using testing::TemporaryFolder;

std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& item : fs::directory_iterator(folder)) names.push_back(item.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

void write_text(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

TEST(DiskStore, ReadsWhatWasWritten) {
  const TemporaryFolder folder;
  DiskStore store(folder / "cache");
  EXPECT_FALSE(store.read("cas/x"));
  EXPECT_FALSE(store.size("cas/x"));
  EXPECT_TRUE(store.write("cas/x", bytes_of("first")));
  EXPECT_TRUE(store.write("cas/x", bytes_of("second")));
  EXPECT_EQ(store.read("cas/x"), bytes_of("second"));
  EXPECT_EQ(store.size("cas/x"), 6U);
  EXPECT_EQ(store.digest("cas/x"), sha256(bytes_of("second")));
  EXPECT_TRUE(store.write("cas/empty", {}));
  EXPECT_EQ(store.read("cas/empty"), Bytes());
  EXPECT_THAT(files_in(folder / "cache/cas"), ::testing::ElementsAre("empty", "x"));  // no temporary stays
  store.remove("cas/x");
  EXPECT_FALSE(store.read("cas/x"));
}

TEST(DiskStore, ListsEntriesButNoTemporaries) {
  const TemporaryFolder folder;
  DiskStore store(folder.path());
  store.write("ac/b", bytes_of("22"));
  store.write("ac/a", bytes_of("1"));
  write_text(folder / "ac/.skinforge-1-2", "half");
  const auto entries = store.list("ac");
  ASSERT_THAT(entries, SizeIs(2));
  EXPECT_EQ(entries[0].name, "a");
  EXPECT_EQ(entries[1].size, 2U);
  EXPECT_THAT(store.list("cas"), IsEmpty());
}

TEST(DiskStore, FoldersAndLinksAreNotEntries) {
  const TemporaryFolder folder;
  DiskStore store(folder.path());
  fs::create_directories(folder / "cas/folder/inside");
  write_text(folder / "secret", "secret");
  fs::create_symlink(folder / "secret", folder / "cas/link");
  EXPECT_FALSE(store.read("cas/folder"));
  EXPECT_FALSE(store.read("cas/link"));
  EXPECT_FALSE(store.size("cas/link"));
  EXPECT_FALSE(store.digest("cas/link"));
  for (const char* name : {"cas/folder", "cas/link"}) EXPECT_TRUE(store.is_there(name));
  EXPECT_FALSE(store.is_there("cas/nothing"));
  EXPECT_TRUE(store.write("cas/folder", bytes_of("entry")));
  EXPECT_TRUE(store.write("cas/link", bytes_of("entry")));
  EXPECT_EQ(store.read("cas/folder"), bytes_of("entry"));
  EXPECT_EQ(store.read("cas/link"), bytes_of("entry"));
  EXPECT_EQ(DiskStore(folder.path()).read("secret"),
            bytes_of("secret"));  // the link was replaced, not followed
}

// A manifest that became a folder, or a link to another, is no plain miss: it is told and replaced.
TEST(DiskStore, AFolderInPlaceOfAManifestIsDamage) {
  const TemporaryFolder folder;
  DiskStore store(folder.path());
  Manifest manifest;
  manifest.key = sha256(bytes_of("key"));
  const std::string path = "ac/" + manifest.key.hex();
  for (const bool is_link : {false, true}) {
    Cache cache(store);
    if (is_link)
      fs::create_symlink("/etc/hostname", folder / path);
    else
      fs::create_directories(folder / path / "inside");
    EXPECT_FALSE(cache.find(manifest.key));
    ASSERT_THAT(cache.take_warnings(), SizeIs(1));
    EXPECT_FALSE(cache.find(manifest.key));
    EXPECT_THAT(cache.take_warnings(), IsEmpty());
    cache.put(manifest);
    EXPECT_TRUE(cache.find(manifest.key));
    cache.clear();
  }
}

TEST(DiskStore, RefusesQuietlyWhereItCannotWrite) {
  const TemporaryFolder folder;
  write_text(folder / "file", "");
  DiskStore store(folder / "file");  // a folder cannot be made below a file
  EXPECT_FALSE(store.write("cas/x", bytes_of("x")));
  EXPECT_FALSE(store.read("cas/x"));
  EXPECT_THAT(store.list("cas"), IsEmpty());
}

TEST(DiskStore, MakesItsFoldersAgainWhenTheyGo) {
  const TemporaryFolder folder;
  DiskStore store(folder / "cache");
  EXPECT_TRUE(store.write("cas/x", bytes_of("x")));
  fs::remove_all(folder / "cache");
  EXPECT_TRUE(store.write("cas/x", bytes_of("x")));
}

// Sizes that no memory holds: entries with a hole of a terabyte, which read as zeros. Nothing of them is
// read.
TEST(DiskStore, ATerabyteInPlaceOfAnEntryIsDamage) {
  const TemporaryFolder folder;
  DiskStore store(folder.path());
  const Bytes result = bytes_of("result");
  Manifest manifest;
  manifest.key = sha256(bytes_of("key"));
  manifest.outputs = {{"out", sha256(result), result.size()}};
  for (const std::string& entry : {"ac/" + manifest.key.hex(), "cas/" + sha256(result).hex()}) {
    Cache cache(store);
    cache.put_blob(sha256(result), result);
    cache.put(manifest);
    ASSERT_TRUE(cache.find(manifest.key));
    fs::resize_file(folder / entry, std::uintmax_t{1} << 40);
    EXPECT_FALSE(cache.find(manifest.key));
    EXPECT_THAT(cache.take_warnings(), SizeIs(1));
    EXPECT_FALSE(fs::exists(folder / entry));
  }
}

// The lock of a temporary is held by who writes it; that the process number in its name is in use says
// nothing.
TEST(DiskStore, RemovesTemporariesThatNobodyWrites) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "cas");
  const std::string prefix = ".skinforge-" + std::to_string(::getpid());
  for (const std::string& name : {prefix + "-1", prefix + "-2", std::string(".skinforge-1-note")})
    write_text(folder / ("cas/" + name), "half");
  const int written = ::open((folder / ("cas/" + prefix + "-2")).c_str(), O_WRONLY | O_CLOEXEC);
  ASSERT_EQ(::flock(written, LOCK_EX | LOCK_NB), 0);

  DiskStore(folder.path()).write("cas/x", bytes_of("x"));
  EXPECT_THAT(files_in(folder / "cas"), ElementsAre(".skinforge-1-note", prefix + "-2", "x"));
  ::close(written);
  DiskStore(folder.path()).write("cas/x", bytes_of("x"));
  EXPECT_THAT(files_in(folder / "cas"), ElementsAre(".skinforge-1-note", "x"));
}

// Who sweeps all the time takes nothing from who writes all the time.
TEST(DiskStore, SweepingTakesNothingFromWriters) {
  const TemporaryFolder folder;
  std::atomic<bool> is_done = false;
  std::thread sweeper([&] {
    while (!is_done) DiskStore(folder.path()).remove_stale_temporaries("");
  });
  for (int i = 0; i < 500; ++i) ASSERT_TRUE(write_file_atomically(folder / "x", bytes_of("x"))) << i;
  is_done = true;
  sweeper.join();
  EXPECT_THAT(files_in(folder.path()), ElementsAre("x"));
}

// A reader that looks all the time never sees anything but one of the two whole contents.
TEST(DiskStore, WritesAppearWholeOrNotAtAll) {
  const TemporaryFolder folder;
  DiskStore store(folder.path());
  const Bytes one(300000, std::byte{1}), two(200000, std::byte{2});
  store.write("cas/x", one);
  std::atomic<bool> stop = false;
  std::thread writer([&] {
    for (int i = 0; i < 200; ++i) store.write("cas/x", i % 2 ? one : two);
    stop = true;
  });
  int others = 0;
  while (!stop) {
    const auto seen = store.read("cas/x");
    if (seen != one && seen != two) ++others;
  }
  writer.join();
  EXPECT_EQ(others, 0);
}

// A process that dies while it writes leaves the old content, or the new, never a part.
TEST(DiskStore, AKilledWriterLeavesWholeEntries) {
  const TemporaryFolder folder;
  const Bytes one(1 << 20, std::byte{1}), two(1 << 20, std::byte{2});
  DiskStore store(folder.path());
  store.write("cas/x", one);
  for (int round = 0; round < 20; ++round) {
    const pid_t child = ::fork();
    if (child == 0) {
      DiskStore writer(folder.path());
      for (int i = 0;; ++i) writer.write("cas/x", i % 2 ? one : two);
    }
    std::this_thread::sleep_for(std::chrono::microseconds(300 + 517 * round));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    const auto seen = store.read("cas/x");
    EXPECT_TRUE(seen == one || seen == two);
    EXPECT_THAT(store.list("cas"), SizeIs(1));
  }
}

}  // namespace
}  // namespace skinforge
