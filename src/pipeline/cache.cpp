#include "pipeline/cache.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

namespace skinforge {
using nlohmann::json;

namespace {
constexpr const char* kManifests = "ac";
constexpr const char* kBlobs = "cas";
constexpr const char* kRuns = "runs";

std::string path_of(const char* folder, const Digest& digest) {
  return std::string(folder) + "/" + digest.hex();
}

std::string_view text_of(const Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text));
}

std::string run_path(const std::string& session) {
  return path_of(kRuns, sha256(bytes_of(session)));
}

struct DigestEntry {
  std::string path;
  Digest digest;
  std::uint64_t size = 0;
};

// Entries of a folder that are named by a digest: the others are not ours.
std::vector<DigestEntry> entries(const BlobStore& store, const char* folder) {
  std::vector<DigestEntry> found;
  for (const BlobStore::Entry& entry : store.list(folder))
    if (const auto digest = digest_from_hex(entry.name))
      found.push_back({path_of(folder, *digest), *digest, entry.size});
  return found;
}
}  // namespace

std::optional<Manifest> Cache::peek(const Digest& key) {
  const std::optional<Bytes> bytes = store_.read(path_of(kManifests, key));
  return bytes ? parse_manifest(text_of(*bytes), key) : std::nullopt;
}

std::optional<Manifest> Cache::find(const Digest& key) {
  const std::string path = path_of(kManifests, key);
  const std::optional<Bytes> bytes = store_.read(path);
  if (!bytes) return std::nullopt;
  std::optional<Manifest> manifest = parse_manifest(text_of(*bytes), key);
  if (!manifest) {
    warn("cache-entry-damaged", path, "a damaged cache entry was set aside; its stage runs again");
    store_.remove(path);
    return std::nullopt;
  }
  for (const Manifest::Output& output : manifest->outputs) {
    const std::string blob_path = path_of(kBlobs, output.digest);
    const auto size = store_.size(blob_path);
    if (size == output.size) continue;
    warn("cache-blob-missing", blob_path,
         fmt::format("a result in the cache {}; stage {} runs again",
                     size ? "has the wrong length" : "is missing", manifest->stage));
    if (size) store_.remove(blob_path);
    return std::nullopt;
  }
  return manifest;
}

std::optional<Bytes> Cache::blob(const Digest& digest) {
  const std::string path = path_of(kBlobs, digest);
  std::optional<Bytes> bytes = store_.read(path);
  if (!bytes) {
    warn("cache-blob-missing", path, "a result in the cache is missing; its stage runs again");
  } else if (sha256(*bytes) != digest) {
    warn("cache-blob-damaged", path, "a damaged result in the cache was set aside; its stage runs again");
    store_.remove(path);
    bytes.reset();
  }
  return bytes;
}

bool Cache::has_blob(const Digest& digest, std::uint64_t size) const {
  return store_.size(path_of(kBlobs, digest)) == size;
}

bool Cache::put_blob(const Digest& digest, std::span<const std::byte> bytes) {
  const std::string path = path_of(kBlobs, digest);
  if (has_blob(digest, bytes.size())) return true;
  if (store_.write(path, bytes)) return true;
  warn("cache-not-writable", path, "the cache cannot be written; results are not kept");
  return false;
}

void Cache::put(const Manifest& manifest) {
  const std::string path = path_of(kManifests, manifest.key);
  const std::string text = manifest_text(manifest);
  if (!store_.write(path, bytes_of(text)))
    warn("cache-not-writable", path, "the cache cannot be written; results are not kept");
}

std::map<std::string, Digest> Cache::last_keys(const std::string& session) {
  std::map<std::string, Digest> keys;
  const std::optional<Bytes> bytes = store_.read(run_path(session));
  if (!bytes) return keys;
  const json run = json::parse(text_of(*bytes), nullptr, false);
  if (!run.is_object()) return keys;  // a damaged record only costs the reasons
  for (const auto& [label, hex] : run.items())
    if (const auto key = digest_from_hex(hex.is_string() ? hex.get<std::string>() : "")) keys[label] = *key;
  return keys;
}

void Cache::put_last_keys(const std::string& session, const std::map<std::string, Digest>& keys) {
  json run = json::object();
  for (const auto& [label, key] : keys) run[label] = key.hex();
  const std::string text = run.dump(1, ' ', false, json::error_handler_t::replace);
  store_.write(run_path(session), bytes_of(text));
}

Cache::Stats Cache::stats() {
  Stats stats;
  std::set<Digest> referenced;
  for (const DigestEntry& entry : entries(store_, kManifests)) {
    ++stats.manifests;
    stats.bytes += entry.size;
    const auto manifest = peek(entry.digest);
    if (!manifest) continue;
    StageStats& stage = stats.stages[manifest->stage];
    ++stage.entries;
    stage.seconds += manifest->cost.wall_seconds;
    for (const Manifest::Output& output : manifest->outputs) referenced.insert(output.digest);
  }
  for (const DigestEntry& entry : entries(store_, kBlobs)) {
    ++stats.blobs;
    stats.bytes += entry.size;
    if (!referenced.contains(entry.digest)) ++stats.unreferenced_blobs;
  }
  return stats;
}

bool Cache::has_blobs(const Manifest& manifest) const {
  return std::all_of(manifest.outputs.begin(), manifest.outputs.end(),
                     [&](const Manifest::Output& o) { return has_blob(o.digest, o.size); });
}

std::vector<std::string> Cache::verify() {
  std::vector<std::string> found;
  const auto set_aside = [&](const std::string& path, const char* what) {
    found.push_back(path + ": " + what + "; removed");
    store_.remove(path);
  };
  for (const DigestEntry& entry : entries(store_, kBlobs)) {
    const auto bytes = store_.read(entry.path);
    if (!bytes || sha256(*bytes) != entry.digest) set_aside(entry.path, "content does not match its name");
  }
  for (const DigestEntry& entry : entries(store_, kManifests)) {
    const auto manifest = peek(entry.digest);
    if (!manifest)
      set_aside(entry.path, "not a sound manifest");
    else if (!has_blobs(*manifest))
      set_aside(entry.path, "names a result that is missing");
  }
  return found;
}

std::uint64_t Cache::clear() {
  std::uint64_t removed = 0;
  for (const char* folder : {kManifests, kRuns, kBlobs}) {
    for (const DigestEntry& entry : entries(store_, folder)) {
      store_.remove(entry.path);
      ++removed;
    }
  }
  return removed;
}

std::vector<Issue> Cache::take_warnings() {
  const std::lock_guard lock(mutex_);
  return std::exchange(warnings_, {});
}

void Cache::warn(const std::string& code, const std::string& place, const std::string& message) {
  const std::lock_guard lock(mutex_);
  const bool is_new_kind = warned_.insert(code).second, is_new_place = warned_.insert(place).second;
  if (is_new_kind && is_new_place) warnings_.push_back({code, Severity::Warning, place, message});
}

}  // namespace skinforge
