#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/hash.h"

namespace skinforge {

/// SHA-256 of a file's bytes, read piece by piece; none when it cannot be read. Links are followed.
std::optional<Digest> sha256_of_file(const std::filesystem::path& path);

/// What the file system says of a file; another one after every write to it, since nobody can set the time of
/// change.
struct FileStamp {
  std::uint64_t device = 0;
  std::uint64_t inode = 0;
  std::uint64_t size = 0;
  std::int64_t modified_ns = 0;  ///< since 1970
  std::int64_t changed_ns = 0;   ///< bytes or attributes

  bool operator==(const FileStamp&) const = default;
};

/// The stamp of a regular file, by name or open; none for anything else. Links are followed.
std::optional<FileStamp> stamp_of(const std::filesystem::path& path);
std::optional<FileStamp> stamp_of(int descriptor);

/// Digests of files, remembered with the stamp under which they were taken, from one process to the next: a
/// file whose stamp is the same is not read again. As in git's index, a file that changed just now is not
/// remembered, since a further change could fall on the same tick of the clock. Thread-safe.
class FileDigests {
 public:
  /// `tick_ns`: how long after a change a file is not remembered.
  explicit FileDigests(std::int64_t tick_ns = 2'000'000'000)
      : tick_ns_(tick_ns) {}  // FAT's; others are finer

  /// SHA-256 of a regular file; none when it cannot be read.
  std::optional<Digest> of(const std::filesystem::path& path);
  /// SHA-256 of `bytes`, which were read from a file while it had this stamp.
  Digest of(std::span<const std::byte> bytes, const FileStamp& stamp);

  /// What a process before this one remembered, as `text` gave it; damaged text counts as none.
  void recall(std::string text);
  /// The entries that were asked for, one a line; empty when they are those that were recalled.
  std::string news() const;

 private:
  struct Entry {
    FileStamp stamp;
    Digest digest;
    bool is_used = false;
  };
  std::optional<Digest> remembered(const FileStamp& stamp);
  void remember(const FileStamp& stamp, const Digest& digest);

  std::int64_t tick_ns_;
  mutable std::mutex mutex_;
  std::map<std::pair<std::uint64_t, std::uint64_t>, Entry> entries_;  // by device and inode
  std::string recalled_;
};

}  // namespace skinforge
