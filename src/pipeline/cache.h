#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/hash.h"
#include "base/issue.h"
#include "pipeline/blob_store.h"
#include "pipeline/run_record.h"

namespace skinforge {

/// What a stage run cost. Information only: never part of a key or an artifact.
struct StageCost {
  double wall_seconds = 0;
  double cpu_seconds = 0;        ///< of the whole process with one job, else of the stage's own thread
  std::uint64_t peak_bytes = 0;  ///< largest resident size of the process up to the end of the stage
};

/// The record of one stage run: what went in, what came out.
struct Manifest {
  struct Output {
    std::string name;
    Digest digest;
    std::uint64_t size = 0;
  };
  Digest key;
  std::string build;  ///< id of the tool
  std::string stage;
  std::string instance;
  int version = 0;
  std::vector<HashedField> parameters;  ///< in the order of `add_to_key`
  std::vector<HashedField> inputs;      ///< artifact name and digest, in the order of `reads`
  std::vector<Output> outputs;          ///< in the order of `writes`
  std::vector<Issue> issues;
  StageCost cost;
};

/// Manifest as stored: one line "skinforge-manifest <format> <key> <length> <sha256 of the rest>", then JSON.
std::string manifest_text(const Manifest& manifest);
/// Reads it back; none when anything is off: header, length, digest, JSON, or another key than `key`.
std::optional<Manifest> parse_manifest(std::string_view text, const Digest& key);

/// A failure that would come again: of the stage with that key.
struct StoredFailure {
  ExitCode code = ExitCode::StageFailed;
  std::string message;
};

/// Results of stages by content: `ac/<key>` holds manifests, `cas/<sha256>` the blobs they name. Blobs are
/// written before the manifest, everything that is read is verified, and no trouble here fails a build: it is
/// a miss and one warning. Thread-safe; several processes may share one folder.
class Cache {
 public:
  /// `store` must outlive the cache.
  explicit Cache(BlobStore& store) : store_(store) {}

  /// The manifest of a key, if it is sound and every blob it names is there with the right bytes: by the
  /// store's `digest`, which need not read a file that did not change. What is loaded is read and verified.
  std::optional<Manifest> find(const Digest& key);
  /// A manifest read for information only (the blobs may be gone).
  std::optional<Manifest> peek(const Digest& key);
  /// The blob of that digest; a damaged one is removed and counts as missing.
  std::optional<Bytes> blob(const Digest& digest);
  /// Whether there is a blob of that digest with the right bytes.
  bool has_blob(const Digest& digest, std::uint64_t size) const;
  /// Stores a blob unless it is there. False when the store refuses.
  bool put_blob(const Digest& digest, std::span<const std::byte> bytes);
  /// Stores a manifest; its blobs must be stored.
  void put(const Manifest& manifest);

  /// The failure of a key, if it was stored and is sound.
  std::optional<StoredFailure> failure(const Digest& key);
  void put_failure(const Digest& key, const StoredFailure& failure);
  void forget_failure(const Digest& key);

  /// The last run of a session: for "why did it run?". Empty when there is none.
  RunRecord last_run(const std::string& session);
  void put_last_run(const std::string& session, const RunRecord& run);
  /// Those before it, newest first, at most `kMaxPastRuns`.
  std::vector<RunRecord> past_runs(const std::string& session);
  void put_past_run(const std::string& session, const RunRecord& run);
  static constexpr std::size_t kMaxPastRuns = 16;  // ours: two weeks of nights

  /// Digests of files that the session before took, and those to keep for the next one.
  void recall_digests(const std::string& session, FileDigests& digests);
  void keep_digests(const std::string& session, const FileDigests& digests);

  struct StageStats {
    std::uint64_t entries = 0;
    double seconds = 0;  ///< wall time that a hit of each entry saves, summed
  };
  struct Stats {
    std::uint64_t manifests = 0;
    std::uint64_t blobs = 0;
    std::uint64_t bytes = 0;
    std::uint64_t unreferenced_blobs = 0;
    std::map<std::string, StageStats> stages;
  };
  Stats stats();
  /// Reads everything; removes what is damaged and manifests whose blobs are gone. One sentence for each.
  std::vector<std::string> verify();
  /// Removes every entry, manifests first. Returns how many.
  std::uint64_t clear();

  struct CollectOptions {
    std::uint64_t max_bytes = std::numeric_limits<std::uint64_t>::max();  ///< of entries with their results
    double max_age_seconds = std::numeric_limits<double>::infinity();  ///< since an entry was last asked for
    double min_blob_age_seconds = 3600;  ///< ours: younger results may belong to a build that runs now
  };
  struct Collected {
    std::uint64_t entries = 0, blobs = 0, bytes = 0;
    std::uint64_t bytes_left = 0;  ///< of entries with their results
  };
  /// Removes entries that are too old, then those that were not asked for longest until the rest fits, but
  /// none that is pinned; then the results that no entry names. Manifests go before blobs, so nothing names
  /// what is not there; a build that runs now makes anew what it misses.
  Collected collect(const CollectOptions& options);
  /// Keeps the entries of the last run of a session from `collect`, as they are now. False when it never ran,
  /// or the store refuses.
  bool pin(const std::string& session);
  /// False when it was not pinned.
  bool unpin(const std::string& session);

  /// Warnings since the last call, at most one of each kind and one of each entry in a session.
  std::vector<Issue> take_warnings();

 private:
  bool has_blobs(const Manifest& manifest) const;
  bool check_blob(const Manifest& manifest, const Manifest::Output& output);
  std::set<Digest> pinned_keys();
  /// Keeps an entry; warns when that does not work.
  bool keep(const std::string& path, std::span<const std::byte> bytes);
  void warn(const std::string& code, const std::string& place, const std::string& message);

  BlobStore& store_;
  std::mutex mutex_;
  std::vector<Issue> warnings_;
  std::set<std::string> warned_;  ///< kinds and entries
};

}  // namespace skinforge
