#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/expect.h"
#include "io/build_character.h"
#include "io/dae_check.h"
#include "io/export.h"
#include "io/fbx_scene.h"
#include "io/gltf_reader.h"
#include "io/number_table.h"
#include "io/obj_check.h"
#include "io/off_reader.h"
#include "io/raw_scene_check.h"
#include "io/tgf_reader.h"
#include "pipeline/cache.h"
#include "pipeline/cache_layout.h"
#include "recipe/recipe.h"

/// The parsers of untrusted bytes. Whatever the bytes are, each gives a result or throws an `Error` of one
/// line that blames the input. Fed by the fuzzer (fuzz.cpp) and by the test of all that was ever found
/// (tests/stages/fuzz_finds_test.cpp).
namespace skinforge::fuzz {

inline InputFile file_of(const std::string& path, std::span<const std::byte> bytes) {
  return {path, Bytes(bytes.begin(), bytes.end()), {}};
}

inline std::string text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

inline void feed_gltf(std::span<const std::byte> bytes) {
  const bool is_binary = text_of(bytes).starts_with("glTF");
  read_gltf({file_of(is_binary ? "a.glb" : "a.gltf", bytes)});
}

inline void feed_character(std::span<const std::byte> bytes) {
  IssueSink issues;
  settle_scene(read_gltf({file_of("a.glb", bytes)}), "a.glb", issues);
}

/// What the import child hands back, seen by the parent.
inline void feed_scene(std::span<const std::byte> bytes) {
  RawScene scene;
  try {
    scene = from_bytes<RawScene>(bytes);
  } catch (const Error&) {
    return;  // "importer gave a broken answer"
  }
  check_raw_scene(scene);
  IssueSink issues;
  settle_scene(scene, "a.fbx", issues);
}

inline void feed_fbx(std::span<const std::byte> bytes) {
  const InputFile file = file_of("a.fbx", bytes);
  const FbxFile fbx = parse_fbx(file.bytes);
  check_fbx(FbxScene(fbx.root));
}

inline void feed_obj(std::span<const std::byte> bytes) {
  std::vector<Issue> issues;
  check_obj({file_of("a.obj", bytes), file_of("a.mtl", bytes)}, issues);
}

inline void feed_dae(std::span<const std::byte> bytes) {
  std::vector<Issue> issues;
  check_dae(file_of("a.dae", bytes), issues);
}

inline void feed_off(std::span<const std::byte> bytes) {
  read_off(file_of("a.off", bytes));
}

inline void feed_tgf(std::span<const std::byte> bytes) {
  read_tgf(file_of("a.tgf", bytes));
}

inline void feed_dmat(std::span<const std::byte> bytes) {
  read_dmat(file_of("a.dmat", bytes));
}

inline void feed_image(std::span<const std::byte> bytes) {
  decode_image({"a", "image/png", Bytes(bytes.begin(), bytes.end())});
}

/// A recipe in the folder `recipes` of the repository, where its inputs are: without them nothing behind
/// them is read.
inline void feed_recipe(std::span<const std::byte> bytes, const char* name) {
  parse_recipe(text_of(bytes), std::filesystem::current_path() / "recipes" / name);
}

inline void feed_recipe_json(std::span<const std::byte> bytes) {
  feed_recipe(bytes, "fuzz.json");
}

inline void feed_recipe_yaml(std::span<const std::byte> bytes) {
  feed_recipe(bytes, "fuzz.yaml");
}

/// What was read is written and read back.
inline void write_again(Cache& cache, const Digest& key) {
  if (const auto manifest = cache.peek(key)) {
    cache.put(*manifest);
    SF_EXPECT(cache.peek(key).has_value());
  }
  if (const auto failure = cache.failure(key)) {
    cache.put_failure(key, *failure);
    SF_EXPECT(cache.failure(key)->message == failure->message);
  }
  const RunRecord run = cache.last_run("session");
  if (!run.stages.empty()) cache.put_past_run("session", run);
  if (cache.pin("session")) cache.unpin("session");
}

/// Entries of a cache: manifests, results, failures, records of runs. An odd first byte puts a fitting header
/// before the manifest, so that the JSON behind it is reached.
inline void feed_cache(std::span<const std::byte> bytes) {
  if (bytes.empty()) return;
  const std::span<const std::byte> rest = bytes.subspan(1);
  const Digest key = sha256(rest);
  MemoryStore store;
  const auto put = [&](const std::string& path, std::string_view content) {
    const auto view = cache_layout::bytes_of(content);
    store.entries[path] = Bytes(view.begin(), view.end());
  };
  std::string manifest = text_of(rest);
  if (bytes[0] == std::byte{'b'})
    manifest = "skinforge-manifest 1 " + key.hex() + " " + std::to_string(rest.size()) + " " + key.hex() +
               "\n" + manifest;
  put(cache_layout::path_of(cache_layout::kManifests, key), manifest);
  for (const char* folder : {cache_layout::kBlobs, cache_layout::kFailures})
    put(cache_layout::path_of(folder, key), text_of(rest));
  for (const char* folder : {cache_layout::kRuns, cache_layout::kPastRuns, cache_layout::kPins})
    put(cache_layout::run_path(folder, "session"), text_of(rest));
  Cache cache(store);
  cache.peek(key);
  cache.find(key);
  cache.failure(key);
  cache.last_run("session");
  cache.past_runs("session");
  cache.blob(key);
  cache.stats();
  write_again(cache, key);
  cache.collect({.max_bytes = 100, .min_blob_age_seconds = 0});
  cache.verify();
}

struct Target {
  std::string_view name;
  void (*feed)(std::span<const std::byte> bytes);
};

inline constexpr Target kTargets[] = {{"gltf", feed_gltf},
                                      {"character", feed_character},
                                      {"scene", feed_scene},
                                      {"fbx", feed_fbx},
                                      {"obj", feed_obj},
                                      {"dae", feed_dae},
                                      {"off", feed_off},
                                      {"tgf", feed_tgf},
                                      {"dmat", feed_dmat},
                                      {"image", feed_image},
                                      {"cache", feed_cache},
                                      {"recipe_json", feed_recipe_json},
                                      {"recipe_yaml", feed_recipe_yaml}};

/// The target of that name; null when there is none.
inline const Target* find_target(std::string_view name) {
  for (const Target& target : kTargets)
    if (target.name == name) return &target;
  return nullptr;
}

/// Feeds `bytes`; what was wrong with how they were refused, empty when nothing was.
inline std::string complaint(const Target& target, std::span<const std::byte> bytes) {
  try {
    target.feed(bytes);
  } catch (const Error& error) {
    const bool blames_input = error.code() == ExitCode::BadInput || error.code() == ExitCode::Usage;
    const bool is_one_line = std::string_view(error.what()).find('\n') == std::string_view::npos;
    if (!blames_input || !is_one_line) return error.what();
  }
  return {};
}

}  // namespace skinforge::fuzz
