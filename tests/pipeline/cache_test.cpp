#include "pipeline/cache.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/text_stage.h"

namespace skinforge {
namespace {
using testing::bytes_of;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

Manifest sample_manifest() {
  const Bytes blob = bytes_of("blob");
  return {.key = sha256(bytes_of("key")),
          .build = "1.0",
          .stage = "import",
          .instance = "horse",
          .version = 3,
          .parameters = {{"scale", "1.5"}, {"scale", "2"}},
          .inputs = {{"file:horse", std::string(64, 'a')}},
          .outputs = {{"character:horse", sha256(blob), blob.size()}},
          .issues = {{"odd", Severity::Warning, "horse.glb", "text with \"quotes\", \n and \xff"}},
          .cost = {.wall_seconds = 0.25, .cpu_seconds = 0.125, .peak_bytes = 1 << 20}};
}

TEST(Manifest, RoundTrip) {
  Manifest before = sample_manifest();
  before.issues[0].message = "plain";
  const auto after = parse_manifest(manifest_text(before), before.key);
  ASSERT_TRUE(after);
  EXPECT_EQ(manifest_text(*after), manifest_text(before));
  EXPECT_EQ(after->parameters, before.parameters);
  EXPECT_EQ(after->inputs, before.inputs);
  EXPECT_EQ(after->outputs[0].digest, before.outputs[0].digest);
  EXPECT_EQ(after->outputs[0].size, 4U);
  EXPECT_EQ(after->cost.wall_seconds, 0.25);
}

TEST(Manifest, SurvivesBytesThatAreNotText) {
  const Manifest manifest = sample_manifest();
  EXPECT_TRUE(parse_manifest(manifest_text(manifest), manifest.key));
}

TEST(Manifest, AnyChangedByteIsNoticed) {
  const Manifest manifest = sample_manifest();
  const std::string text = manifest_text(manifest);
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string damaged = text;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    EXPECT_FALSE(parse_manifest(damaged, manifest.key)) << "byte " << i;
    EXPECT_FALSE(parse_manifest(text.substr(0, i), manifest.key)) << "cut at " << i;
  }
  EXPECT_FALSE(parse_manifest(text, sha256(bytes_of("another key"))));
}

TEST(Cache, FindsWhatWasPut) {
  MemoryStore store;
  Cache cache(store);
  const Manifest manifest = sample_manifest();
  EXPECT_FALSE(cache.find(manifest.key));
  EXPECT_TRUE(cache.put_blob(manifest.outputs[0].digest, bytes_of("blob")));
  cache.put(manifest);
  ASSERT_TRUE(cache.find(manifest.key));
  EXPECT_EQ(cache.find(manifest.key)->instance, "horse");
  EXPECT_EQ(cache.blob(manifest.outputs[0].digest), bytes_of("blob"));
  EXPECT_THAT(cache.take_warnings(), IsEmpty());
}

TEST(Cache, AManifestWithoutItsBlobIsAMiss) {
  MemoryStore store;
  Cache cache(store);
  const Manifest manifest = sample_manifest();
  cache.put(manifest);
  EXPECT_FALSE(cache.find(manifest.key));
  EXPECT_THAT(cache.take_warnings(), SizeIs(1));
}

TEST(Cache, RepeatsNoWarningOfOneKind) {
  MemoryStore store;
  Cache cache(store);
  EXPECT_FALSE(cache.blob(sha256(bytes_of("x"))));
  EXPECT_FALSE(cache.blob(sha256(bytes_of("y"))));
  EXPECT_THAT(cache.take_warnings(), SizeIs(1));
  EXPECT_THAT(cache.take_warnings(), IsEmpty());
}

TEST(Cache, CountsItsEntries) {
  MemoryStore store;
  Cache cache(store);
  const Manifest manifest = sample_manifest();
  cache.put_blob(manifest.outputs[0].digest, bytes_of("blob"));
  cache.put_blob(sha256(bytes_of("left over")), bytes_of("left over"));
  cache.put(manifest);
  const Cache::Stats stats = cache.stats();
  EXPECT_EQ(stats.manifests, 1U);
  EXPECT_EQ(stats.blobs, 2U);
  EXPECT_EQ(stats.unreferenced_blobs, 1U);
  EXPECT_EQ(stats.bytes, 4 + 9 + manifest_text(manifest).size());
  EXPECT_EQ(stats.stages.at("import").entries, 1U);
  EXPECT_EQ(stats.stages.at("import").seconds, 0.25);
}

TEST(Cache, VerifyFindsAndRemovesDamage) {
  MemoryStore store;
  Cache cache(store);
  const Manifest manifest = sample_manifest();
  cache.put_blob(manifest.outputs[0].digest, bytes_of("blob"));
  cache.put(manifest);
  EXPECT_THAT(cache.verify(), IsEmpty());
  store.entries.at("cas/" + manifest.outputs[0].digest.hex())[0] ^= std::byte{1};
  EXPECT_THAT(cache.verify(), SizeIs(2));  // the blob, and the manifest that names it
  EXPECT_THAT(store.entries, IsEmpty());
}

TEST(Cache, ClearLeavesForeignFilesAlone) {
  MemoryStore store;
  Cache cache(store);
  cache.put_blob(sha256(bytes_of("blob")), bytes_of("blob"));
  cache.put(sample_manifest());
  RunRecord run;
  run.note("import", sha256({}), {});
  cache.put_last_run("session", run);
  store.entries["cas/README"] = bytes_of("not ours");
  EXPECT_EQ(cache.clear(), 3U);
  EXPECT_THAT(store.list("cas"), SizeIs(1));
}

RunRecord run_of(const std::string& word) {
  RunRecord run;
  run.note("import horse", sha256(bytes_of(word)), {{"/inputs/horse", word}});
  return run;
}

TEST(Cache, RemembersTheLastRunOfASession) {
  MemoryStore store;
  Cache cache(store);
  EXPECT_EQ(cache.last_run("centaur"), RunRecord());
  cache.put_last_run("centaur", run_of("1"));
  EXPECT_EQ(cache.last_run("centaur"), run_of("1"));
  EXPECT_EQ(cache.last_run("mermaid"), RunRecord());
  for (auto& [path, bytes] : store.entries) bytes.resize(bytes.size() / 2);
  EXPECT_EQ(cache.last_run("centaur"), RunRecord());
}

TEST(Cache, RemembersPastRunsNewestFirst) {
  MemoryStore store;
  Cache cache(store);
  for (std::size_t i = 0; i < Cache::kMaxPastRuns + 2; ++i)
    cache.put_past_run("centaur", run_of(std::to_string(i)));
  cache.put_past_run("centaur", run_of("9"));  // as it was before: moves to the front
  const auto runs = cache.past_runs("centaur");
  ASSERT_THAT(runs, SizeIs(Cache::kMaxPastRuns));
  EXPECT_EQ(runs[0], run_of("9"));
  EXPECT_EQ(runs[1], run_of(std::to_string(Cache::kMaxPastRuns + 1)));
  EXPECT_EQ(std::count(runs.begin(), runs.end(), run_of("9")), 1);
  EXPECT_THAT(cache.past_runs("mermaid"), IsEmpty());
}

TEST(Cache, StoredFailuresAreVerified) {
  MemoryStore store;
  Cache cache(store);
  const Digest key = sha256(bytes_of("key"));
  EXPECT_FALSE(cache.failure(key));
  cache.put_failure(key, {ExitCode::Invalid, "two\nlines"});
  ASSERT_TRUE(cache.failure(key));
  EXPECT_EQ(cache.failure(key)->code, ExitCode::Invalid);
  EXPECT_EQ(cache.failure(key)->message, "two\nlines");
  for (auto& [path, bytes] : store.entries) bytes.back() ^= std::byte{1};
  EXPECT_FALSE(cache.failure(key));
  cache.forget_failure(key);
  EXPECT_THAT(store.entries, IsEmpty());
}

// Three runs of 10, 20 and 30 bytes; the second is pinned. By hand: what was not asked for longest goes
// first.
class Collect : public ::testing::Test {
 protected:
  void SetUp() override {
    for (int i = 1; i <= 3; ++i) {
      const std::string text(static_cast<std::size_t>(10 * i), static_cast<char>('0' + i));
      Manifest manifest = sample_manifest();
      manifest.key = key(i);
      manifest.outputs = {{"out", sha256(bytes_of(text)), text.size()}};
      cache.put_blob(manifest.outputs[0].digest, bytes_of(text));
      cache.put(manifest);
      store.ages[path(i)] = 1000.0 * (4 - i);  // the first is the oldest
    }
    RunRecord run;
    run.note("stage", key(2), {});
    cache.put_last_run("two", run);
    EXPECT_TRUE(cache.pin("two"));
    EXPECT_FALSE(cache.pin("never run"));
  }
  static Digest key(int i) { return sha256(bytes_of("key" + std::to_string(i))); }
  static std::string path(int i) { return "ac/" + key(i).hex(); }
  bool has(int i) { return cache.find(key(i)).has_value(); }

  MemoryStore store;
  Cache cache{store};
};

TEST_F(Collect, ByAgeSparesWhatIsPinned) {
  const Cache::Collected found = cache.collect({.max_age_seconds = 1500, .min_blob_age_seconds = 0});
  EXPECT_EQ(found.entries, 1U);
  EXPECT_EQ(found.blobs, 1U);
  EXPECT_FALSE(has(1));
  EXPECT_TRUE(has(2));
  EXPECT_TRUE(has(3));
  EXPECT_TRUE(cache.unpin("two"));
  EXPECT_FALSE(cache.unpin("two"));
  EXPECT_THAT(cache.verify(), IsEmpty());
}

TEST_F(Collect, BySizeTakesTheOldestFirst) {
  const std::uint64_t all = cache.stats().bytes;
  cache.unpin("two");
  const Cache::Collected found = cache.collect({.max_bytes = all - 1, .min_blob_age_seconds = 0});
  EXPECT_EQ(found.entries, 1U);
  EXPECT_FALSE(has(1));
  EXPECT_TRUE(has(2));
  cache.collect({.max_bytes = 0, .min_blob_age_seconds = 0});
  EXPECT_THAT(store.list("ac"), IsEmpty());
  EXPECT_THAT(store.list("cas"), IsEmpty());
}

TEST_F(Collect, AHitMakesAnEntryYoung) {
  cache.unpin("two");
  EXPECT_TRUE(has(1));
  cache.collect({.max_age_seconds = 1500, .min_blob_age_seconds = 0});
  EXPECT_TRUE(has(1));
  EXPECT_FALSE(has(2));
}

// Blobs are written before the manifest that names them: young ones stay.
TEST_F(Collect, SparesResultsOfABuildThatRuns) {
  cache.put_blob(sha256(bytes_of("new")), bytes_of("new"));
  EXPECT_EQ(cache.collect({.max_age_seconds = 1e9}).blobs, 0U);
  EXPECT_EQ(cache.collect({.max_age_seconds = 1e9, .min_blob_age_seconds = 0}).blobs, 1U);
}

}  // namespace
}  // namespace skinforge
