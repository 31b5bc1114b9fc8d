#pragma once

#include "base/expect.h"
#include "fuzz/input.h"
#include "pipeline/cache.h"
#include "pipeline/cache_layout.h"
#include "pipeline/cache_usage.h"

namespace skinforge::fuzz {

/// What was read is written and read back.
inline void write_again(Cache& cache, const Digest& key) {
  if (const auto manifest = cache.peek(key)) {
    cache.put(*manifest);
    SF_EXPECT(cache.peek(key).has_value());
  }
  if (const auto failure = cache.failure(key)) {
    cache.put_failure(key, *failure);
    SF_EXPECT(cache.failure(key)->message == failure->message);
    cache.forget_failure(key);
    SF_EXPECT(!cache.failure(key));
  }
  RunRecord run = cache.last_run("session");
  if (!run.stages.empty()) {
    cache.put_past_run("session", run);
    run.note("stage", key, {{"/name", "\"a\""}});
    run.tidy();
    cache.put_last_run("session", run);
    SF_EXPECT(cache.last_run("session").id() == run.id());
    for (const auto& [label, stage] : run.stages) run.settings_of(label);
  }
}

/// A manifest whose results are all there is a hit, kept while it is pinned, and none once a result is
/// damaged.
inline void live_through(Cache& cache, MemoryStore& store, Manifest manifest,
                         std::span<const std::byte> bytes) {
  const Digest blob = sha256(bytes);
  for (Manifest::Output& output : manifest.outputs) output.digest = blob, output.size = bytes.size();
  manifest.outputs.push_back({"result", blob, bytes.size()});
  SF_EXPECT(cache.put_blob(blob, bytes));
  cache.put(manifest);
  SF_EXPECT(cache.find(manifest.key));
  RunRecord run;
  run.note(manifest.stage, manifest.key, {});
  cache.put_last_run("kept", run);
  SF_EXPECT(cache.pin("kept"));
  cache.collect({.max_bytes = 0, .min_blob_age_seconds = 0});
  SF_EXPECT(cache.find(manifest.key) && cache.blob(blob));
  SF_EXPECT(cache.unpin("kept"));
  store.entries[cache_layout::path_of(cache_layout::kBlobs, blob)].push_back(std::byte{});
  SF_EXPECT(!cache.find(manifest.key) && !cache.blob(blob));
  cache.put_blob(blob, bytes);
  store.entries[cache_layout::path_of(cache_layout::kBlobs, blob)].back() ^= std::byte{1};
  SF_EXPECT(!cache.blob(blob));
}

/// The bytes as every kind of entry. The first of them says what is put before the others, so that what is
/// behind it is reached: 'b' the first line of a manifest, 'd' the digest before a failure or before digests.
inline void feed_cache(std::span<const std::byte> bytes) {
  if (bytes.empty()) return;
  const std::span<const std::byte> rest = bytes.subspan(1);
  const std::string text = text_of(rest);
  const Digest key = sha256(rest);
  MemoryStore store;
  const auto put = [&](const std::string& path, std::string_view content) {
    const auto view = cache_layout::bytes_of(content);
    store.entries[path] = Bytes(view.begin(), view.end());
  };
  const bool has_header = bytes[0] == std::byte{'b'}, has_digest = bytes[0] == std::byte{'d'};
  const std::string header =
      "skinforge-manifest 1 " + key.hex() + " " + std::to_string(rest.size()) + " " + key.hex() + "\n";
  put(cache_layout::path_of(cache_layout::kManifests, key), (has_header ? header : "") + text);
  put(cache_layout::path_of(cache_layout::kFailures, key), (has_digest ? key.hex() + "\n" : "") + text);
  put(cache_layout::run_path(cache_layout::kDigests, "session"), (has_digest ? key.hex() + "\n" : "") + text);
  put(cache_layout::path_of(cache_layout::kBlobs, key), text);
  for (const char* folder :
       {cache_layout::kRuns, cache_layout::kPastRuns, cache_layout::kPins, cache_layout::kUsage})
    put(cache_layout::run_path(folder, "session"), text);
  Cache cache(store);
  FileDigests digests;
  cache.recall_digests("session", digests);
  cache.keep_digests("session", digests);
  note_usage(store, "session", {.builds = 1, .hits = 2});
  total_usage(store).hit_rate();
  const auto manifest = cache.peek(key);
  cache.find(key);
  cache.past_runs("session");
  cache.blob(key);
  cache.stats();
  write_again(cache, key);
  cache.collect({.max_bytes = 100, .min_blob_age_seconds = 0});
  cache.verify();
  if (manifest) live_through(cache, store, *manifest, rest);
  cache.clear();
  cache.take_warnings();
}

}  // namespace skinforge::fuzz
