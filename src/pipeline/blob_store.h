#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "base/archive.h"
#include "base/file_digest.h"
#include "base/hash.h"

namespace skinforge {

/// Named byte strings in folders, "ac/<name>" and "cas/<name>": what the cache needs of a disk. Nothing here
/// throws: a store that is in trouble reads as empty and refuses writes. Thread-safe.
class BlobStore {
 public:
  struct Entry {
    std::string name;  ///< without the folder
    std::uint64_t size = 0;
    double age_seconds = 0;  ///< since it was written or touched
  };

  virtual ~BlobStore() = default;
  /// The bytes, or none when there is no such entry or it cannot be read.
  virtual std::optional<Bytes> read(const std::string& path) const = 0;
  /// Its size, without reading it.
  virtual std::optional<std::uint64_t> size(const std::string& path) const = 0;
  /// SHA-256 of the bytes, read piece by piece; none where `read` has none.
  virtual std::optional<Digest> digest(const std::string& path) const = 0;
  /// Makes the entry appear whole or not at all, in place of an older one. False when that did not work;
  /// errno then says why.
  virtual bool write(const std::string& path, std::span<const std::byte> bytes) = 0;
  virtual void remove(const std::string& path) = 0;
  /// Whether anything at all has that name: an entry, one that cannot be read, a folder, a link.
  virtual bool is_there(const std::string& path) const = 0;
  /// Notes that the entry was asked for; nothing where that does not work.
  virtual void touch(const std::string& path) = 0;
  /// All entries of a folder by rising name; temporaries are not entries.
  virtual std::vector<Entry> list(const std::string& folder) const = 0;
};

/// In memory, for tests; `entries` is open so that they can do damage.
class MemoryStore final : public BlobStore {
 public:
  std::optional<Bytes> read(const std::string& path) const override;
  std::optional<std::uint64_t> size(const std::string& path) const override;
  std::optional<Digest> digest(const std::string& path) const override;
  bool write(const std::string& path, std::span<const std::byte> bytes) override;
  void remove(const std::string& path) override;
  bool is_there(const std::string& path) const override;
  void touch(const std::string& path) override;
  std::vector<Entry> list(const std::string& folder) const override;

  std::map<std::string, Bytes> entries;
  std::map<std::string, double> ages;  ///< seconds, for tests; 0 where nothing stands
  bool is_read_only = false;

 private:
  mutable std::mutex mutex_;
};

/// A folder on disk. Writes go to a temporary in the same folder, created anew (O_EXCL) as
/// ".skinforge-<process>-<random>", then renamed; no fsync, since readers verify every digest. The folder is
/// made by the first write, which also removes the temporaries of killed processes. Who writes one holds a
/// lock on it (flock).
class DiskStore final : public BlobStore {
 public:
  /// `digests`: of entries that need not be read anew; must outlive the store.
  explicit DiskStore(std::filesystem::path root, FileDigests* digests = nullptr)
      : root_(std::move(root)), digests_(digests) {}

  std::optional<Bytes> read(const std::string& path) const override;
  std::optional<std::uint64_t> size(const std::string& path) const override;
  std::optional<Digest> digest(const std::string& path) const override;
  bool write(const std::string& path, std::span<const std::byte> bytes) override;
  void remove(const std::string& path) override;
  bool is_there(const std::string& path) const override;
  void touch(const std::string& path) override;
  std::vector<Entry> list(const std::string& folder) const override;

  const std::filesystem::path& root() const { return root_; }
  /// Removes the temporaries of one folder that nobody writes any more: their lock is free. Where the file
  /// system knows no locks, those older than `age_seconds` by the file's own time stamp.
  void remove_stale_temporaries(const std::string& folder, double age_seconds = 3600) const;

 private:
  void tidy_once(const std::string& folder);

  std::filesystem::path root_;
  FileDigests* digests_;
  std::mutex mutex_;
  std::set<std::string> tidied_;  ///< folders
};

/// Writes a file so that it appears whole or not at all: temporary in the same folder, then rename. False
/// when any step fails; the temporary is removed then, and errno says why.
bool write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// The same so that a power cut cannot take it back or leave a part of it: the bytes are on the disk before
/// the rename. False also when the disk reports that they are not; what was there before stays. The folder's
/// own entry is for `sync_folder` to bring to disk, once for all files in it.
bool write_file_durably(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// Brings the names in a folder to disk; true also where the file system knows no such thing. False: errno
/// says why.
bool sync_folder(const std::filesystem::path& folder);

}  // namespace skinforge
