#include <algorithm>
#include <set>

#include "pipeline/cache.h"
#include "pipeline/cache_layout.h"

namespace skinforge {

namespace {
// One stage run with what it takes up.
struct StoredRun {
  std::string path;
  double age_seconds = 0;
  std::uint64_t size = 0;  // of the manifest
  bool is_pinned = false;
  std::vector<Manifest::Output> outputs;
};

// Bytes of the blobs that these runs name, each once, and of their manifests.
class Usage {
 public:
  void add(const StoredRun& run) {
    bytes_ += run.size;
    for (const Manifest::Output& output : run.outputs)
      if (references_[output.digest]++ == 0) bytes_ += output.size;
  }
  void remove(const StoredRun& run) {
    bytes_ -= run.size;
    for (const Manifest::Output& output : run.outputs)
      if (--references_[output.digest] == 0) bytes_ -= output.size;
  }
  std::uint64_t bytes() const { return bytes_; }
  bool is_used(const Digest& blob) const {
    const auto found = references_.find(blob);
    return found != references_.end() && found->second > 0;
  }

 private:
  std::map<Digest, std::size_t> references_;
  std::uint64_t bytes_ = 0;
};
}  // namespace

std::set<Digest> Cache::pinned_keys() {
  std::set<Digest> keys;
  for (const auto& entry : cache_layout::entries(store_, cache_layout::kPins)) {
    const auto bytes = cache_layout::read_record(store_, entry.path);
    const auto run = bytes ? parse_run_record(cache_layout::text_of(*bytes)) : std::nullopt;
    if (!run) continue;
    for (const auto& [label, stage] : run->stages) keys.insert(stage.key);
  }
  return keys;
}

bool Cache::pin(const std::string& session) {
  const RunRecord run = last_run(session);
  if (run.stages.empty()) return false;
  return store_.write(cache_layout::run_path(cache_layout::kPins, session),
                      cache_layout::bytes_of(run_record_text(run)));
}

bool Cache::unpin(const std::string& session) {
  const std::string path = cache_layout::run_path(cache_layout::kPins, session);
  if (!store_.size(path)) return false;
  store_.remove(path);
  return true;
}

Cache::Collected Cache::collect(const CollectOptions& options) {
  const std::set<Digest> pinned = pinned_keys();
  std::vector<StoredRun> runs;
  Usage usage;
  Collected collected;
  for (const auto& entry : cache_layout::entries(store_, cache_layout::kManifests)) {
    StoredRun run{entry.path, entry.age_seconds, entry.size, pinned.contains(entry.digest), {}};
    if (const auto manifest = peek(entry.digest)) run.outputs = manifest->outputs;
    usage.add(run);
    runs.push_back(std::move(run));
  }
  // The one that was not asked for longest goes first; equal ages by name.
  std::stable_sort(runs.begin(), runs.end(),
                   [](const StoredRun& a, const StoredRun& b) { return a.age_seconds > b.age_seconds; });
  for (const StoredRun& run : runs) {
    const bool is_old = run.age_seconds > options.max_age_seconds;
    const bool is_too_much = usage.bytes() > options.max_bytes;
    if (run.is_pinned || (!is_old && !is_too_much)) continue;
    store_.remove(run.path);
    usage.remove(run);
    ++collected.entries;
    collected.bytes += run.size;
  }
  for (const auto& blob : cache_layout::entries(store_, cache_layout::kBlobs)) {
    // A build that runs now writes blobs before it names them.
    if (usage.is_used(blob.digest) || blob.age_seconds < options.min_blob_age_seconds) continue;
    store_.remove(blob.path);
    ++collected.blobs;
    collected.bytes += blob.size;
  }
  collected.bytes_left = usage.bytes();
  return collected;
}

}  // namespace skinforge
