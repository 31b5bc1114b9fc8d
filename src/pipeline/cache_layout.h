#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/hash.h"
#include "pipeline/blob_store.h"

/// Folders and names inside a cache (pipeline.md, "Store"); shared by the files that make up `Cache`.
namespace skinforge::cache_layout {

constexpr const char* kManifests = "ac";
constexpr const char* kBlobs = "cas";
constexpr const char* kRuns = "runs";
constexpr const char* kPastRuns = "past-runs";
constexpr const char* kFailures = "failures";
constexpr const char* kPins = "pins";
constexpr const char* kDigests = "digests";
constexpr const char* kUsage = "usage";

/// All of them; what names others stands before what is named.
inline constexpr std::array kFolders = {kManifests, kFailures, kRuns,  kPastRuns,
                                        kPins,      kDigests,  kBlobs, kUsage};

struct DigestEntry {
  std::string path;
  Digest digest;
  std::uint64_t size = 0;
  double age_seconds = 0;
};

inline std::string path_of(const char* folder, const Digest& digest) {
  return std::string(folder) + "/" + digest.hex();
}

inline std::string_view text_of(const Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

inline std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text));
}

/// A manifest or another record: all of them are small. None when there is no such entry, it cannot be read,
/// or a damaged disk gives it a size that no record has.
inline std::optional<Bytes> read_record(const BlobStore& store, const std::string& path) {
  constexpr std::uint64_t kMaxRecordBytes = std::uint64_t{64}
                                            << 20;  // ours: a thousand times the largest seen
  const auto size = store.size(path);
  return size && *size <= kMaxRecordBytes ? store.read(path) : std::nullopt;
}

/// Where something about a session is kept.
inline std::string run_path(const char* folder, const std::string& session) {
  return path_of(folder, sha256(bytes_of(session)));
}

/// Entries of a folder that are named by a digest: the others are not ours.
inline std::vector<DigestEntry> entries(const BlobStore& store, const char* folder) {
  std::vector<DigestEntry> found;
  for (const BlobStore::Entry& entry : store.list(folder))
    if (const auto digest = digest_from_hex(entry.name))
      found.push_back({path_of(folder, *digest), *digest, entry.size, entry.age_seconds});
  return found;
}

}  // namespace skinforge::cache_layout
