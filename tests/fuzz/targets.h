#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/expect.h"
#include "fuzz/cache_target.h"
#include "fuzz/fbx_target.h"
#include "fuzz/image_target.h"
#include "fuzz/input.h"
#include "fuzz/recipe_target.h"
#include "io/build_character.h"
#include "io/dae_check.h"
#include "io/glb_stamp.h"
#include "io/gltf_reader.h"
#include "io/gltf_rules.h"
#include "io/number_table.h"
#include "io/obj_check.h"
#include "io/off_reader.h"
#include "io/tgf_reader.h"

/// The parsers of untrusted bytes. Whatever the bytes are, each gives a result or throws an `Error` of one
/// line that blames the input. Fed by the fuzzer (fuzz.cpp) and by the test of all that was ever found
/// (tests/stages/fuzz_finds_test.cpp).
namespace skinforge::fuzz {

inline void feed_gltf(std::span<const std::byte> bytes) {
  const bool is_binary = text_of(bytes).starts_with("glTF");
  read_gltf({file_of(is_binary ? "a.glb" : "a.gltf", bytes)});
}

inline void feed_character(std::span<const std::byte> bytes) {
  IssueSink issues;
  settle_scene(read_gltf({file_of("a.glb", bytes)}), "a.glb", issues);
}

/// The rules that `validate` checks, of files that need not keep any of them.
inline void feed_rules(std::span<const std::byte> bytes) {
  const InputFile file = file_of(text_of(bytes).starts_with("glTF") ? "a.glb" : "a.gltf", bytes);
  check_gltf({file});
  if (file.path == "a.glb") check_stamp(file.bytes);
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

/// What was read is written and read back.
inline void feed_dmat(std::span<const std::byte> bytes) {
  const Eigen::MatrixXd table = read_dmat(file_of("a.dmat", bytes));
  const std::string text = write_dmat(table);
  SF_EXPECT(read_dmat(file_of("b.dmat", std::as_bytes(std::span(text)))) == table);
}

struct Target {
  std::string_view name;
  void (*feed)(std::span<const std::byte> bytes);
};

inline constexpr Target kTargets[] = {{"gltf", feed_gltf},
                                      {"character", feed_character},
                                      {"scene", feed_scene},
                                      {"rules", feed_rules},
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
