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
  cache.put_last_keys("session", {{"import", sha256({})}});
  store.entries["cas/README"] = bytes_of("not ours");
  EXPECT_EQ(cache.clear(), 3U);
  EXPECT_THAT(store.list("cas"), SizeIs(1));
}

TEST(Cache, RemembersTheLastKeysOfASession) {
  MemoryStore store;
  Cache cache(store);
  const std::map<std::string, Digest> keys = {{"import horse", sha256(bytes_of("1"))}, {"place", sha256({})}};
  EXPECT_THAT(cache.last_keys("centaur"), IsEmpty());
  cache.put_last_keys("centaur", keys);
  EXPECT_EQ(cache.last_keys("centaur"), keys);
  EXPECT_THAT(cache.last_keys("mermaid"), IsEmpty());
  for (auto& [path, bytes] : store.entries) bytes.resize(bytes.size() / 2);
  EXPECT_THAT(cache.last_keys("centaur"), IsEmpty());
}

}  // namespace
}  // namespace skinforge
