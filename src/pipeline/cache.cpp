#include "pipeline/cache.h"

#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <set>
#include <sstream>

#include "pipeline/cache_layout.h"

namespace skinforge {

using namespace cache_layout;

std::optional<Manifest> Cache::peek(const Digest& key) {
  const std::optional<Bytes> bytes = read_record(store_, path_of(kManifests, key));
  return bytes ? parse_manifest(text_of(*bytes), key) : std::nullopt;
}

std::optional<Manifest> Cache::find(const Digest& key) {
  const std::string path = path_of(kManifests, key);
  const std::optional<Bytes> bytes = read_record(store_, path);
  if (!bytes && !store_.is_there(path)) return std::nullopt;
  std::optional<Manifest> manifest = bytes ? parse_manifest(text_of(*bytes), key) : std::nullopt;
  if (!manifest) {
    warn("cache-entry-damaged", path, "a damaged cache entry was set aside; its stage runs again");
    store_.remove(path);
    return std::nullopt;
  }
  for (const Manifest::Output& output : manifest->outputs)
    if (!check_blob(*manifest, output)) return std::nullopt;
  store_.touch(path);
  return manifest;
}

// False, with a warning, when a result that the manifest names is not there with its bytes.
bool Cache::check_blob(const Manifest& manifest, const Manifest::Output& output) {
  const std::string path = path_of(kBlobs, output.digest);
  const auto size = store_.size(path);
  if (size == output.size && store_.digest(path) == output.digest) return true;
  if (size)
    warn("cache-blob-damaged", path,
         fmt::format("a damaged result in the cache was set aside; stage {} runs again", manifest.stage));
  else
    warn("cache-blob-missing", path,
         fmt::format("a result in the cache is missing; stage {} runs again", manifest.stage));
  store_.remove(path);
  return false;
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
  const std::string path = path_of(kBlobs, digest);
  return store_.size(path) == size && store_.digest(path) == digest;
}

bool Cache::put_blob(const Digest& digest, std::span<const std::byte> bytes) {
  const std::string path = path_of(kBlobs, digest);
  if (has_blob(digest, bytes.size())) return true;
  return keep(path, bytes);
}

bool Cache::keep(const std::string& path, std::span<const std::byte> bytes) {
  if (store_.write(path, bytes)) return true;
  warn("cache-not-writable", path,
       fmt::format("the cache cannot be written ({}); results are not kept", std::strerror(errno)));
  return false;
}

void Cache::put(const Manifest& manifest) {
  const std::string path = path_of(kManifests, manifest.key);
  const std::string text = manifest_text(manifest);
  keep(path, bytes_of(text));
}

std::optional<StoredFailure> Cache::failure(const Digest& key) {
  const std::optional<Bytes> bytes = read_record(store_, path_of(kFailures, key));
  if (!bytes) return std::nullopt;
  // "<sha256 of the rest>\n<exit status>\n<message>"
  const std::string_view text = text_of(*bytes);
  const auto first = text.find('\n'), second = text.find('\n', first + 1);
  if (first == std::string_view::npos || second == std::string_view::npos) return std::nullopt;
  if (sha256(bytes_of(text.substr(first + 1))).hex() != text.substr(0, first)) return std::nullopt;
  int code = 0;
  std::from_chars(text.data() + first + 1, text.data() + second, code);
  return StoredFailure{static_cast<ExitCode>(code), std::string(text.substr(second + 1))};
}

void Cache::put_failure(const Digest& key, const StoredFailure& failure) {
  const std::string rest = std::to_string(static_cast<int>(failure.code)) + "\n" + failure.message;
  store_.write(path_of(kFailures, key), bytes_of(sha256(bytes_of(rest)).hex() + "\n" + rest));
}

void Cache::forget_failure(const Digest& key) {
  const std::string path = path_of(kFailures, key);
  if (store_.size(path)) store_.remove(path);
}

RunRecord Cache::last_run(const std::string& session) {
  const std::optional<Bytes> bytes = read_record(store_, run_path(kRuns, session));
  if (!bytes) return {};
  return parse_run_record(text_of(*bytes)).value_or(RunRecord());  // a damaged record only costs the reasons
}

void Cache::put_last_run(const std::string& session, const RunRecord& run) {
  store_.write(run_path(kRuns, session), bytes_of(run_record_text(run)));
}

std::vector<RunRecord> Cache::past_runs(const std::string& session) {
  std::vector<RunRecord> runs;
  const std::optional<Bytes> bytes = read_record(store_, run_path(kPastRuns, session));
  if (!bytes) return runs;
  std::istringstream lines{std::string(text_of(*bytes))};
  for (std::string line; std::getline(lines, line);)
    if (auto run = parse_run_record(line)) runs.push_back(std::move(*run));
  return runs;
}

void Cache::put_past_run(const std::string& session, const RunRecord& run) {
  std::string text = run_record_text(run) + "\n";
  std::size_t kept = 1;
  for (const RunRecord& old : past_runs(session)) {
    if (old == run || kept == kMaxPastRuns) continue;
    text += run_record_text(old) + "\n";
    ++kept;
  }
  store_.write(run_path(kPastRuns, session), bytes_of(text));
}

void Cache::recall_digests(const std::string& session, FileDigests& digests) {
  if (const std::optional<Bytes> bytes = read_record(store_, run_path(kDigests, session)))
    digests.recall(std::string(text_of(*bytes)));
}

void Cache::keep_digests(const std::string& session, const FileDigests& digests) {
  const std::string text = digests.news();
  if (!text.empty()) store_.write(run_path(kDigests, session), bytes_of(text));
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
    if (store_.digest(entry.path) != entry.digest) set_aside(entry.path, "content does not match its name");
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
  for (const char* folder : kFolders) {
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
