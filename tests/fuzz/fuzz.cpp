// One fuzzer for all targets; SKINFORGE_FUZZ_TARGET names the one to feed. With the name "seeds" no fuzzing:
// each file given is read as a model and its scene written beside it as FILE.scene, as the import child hands
// it over. With the name "import" it imports the file given, as `skinforge inspect` does
// (scripts/hostile.sh).
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "base/limits.h"
#include "fuzz/targets.h"
#include "io/sandbox.h"

namespace {
using namespace skinforge;

const fuzz::Target* chosen = nullptr;

/// Far below what a user may ask for: what the tool does up to its limits only takes time.
void tighten_limits() {
  Limits tight;
  tight.vertices = 100'000;
  tight.keys = 1'000'000;
  tight.pixels = 1 << 20;
  tight.inflate = 1 << 24;
  tight.memory = 1 << 28;
  tight.frames = 10'000;
  set_limits(tight);
}

int write_seeds(int count, char** files) {
  for (int i = 1; i < count; ++i) {
    try {
      const Bytes bytes = to_bytes(read_scene(read_input_files(files[i])));
      std::ofstream(std::string(files[i]) + ".scene", std::ios::binary)
          .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    } catch (const Error&) {  // hostile files are refused
    }
  }
  return 0;
}

int import_file(const char* path) {
  IssueSink issues;
  try {
    const Character character = import_character(path, issues);
    std::printf("%s: %zu joints\n", path, character.skeleton.size());
  } catch (const Error& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return static_cast<int>(error.code());
  }
  for (const Issue& issue : issues.issues())
    std::fprintf(stderr, "warning: %s: %s\n", issue.place.c_str(), issue.message.c_str());
  return 0;
}
}  // namespace

extern "C" int LLVMFuzzerInitialize(int* count, char*** words) {
  if (*count > 1 && std::string_view((*words)[1]) == "--import-worker")
    std::exit(import_worker_main(*count, *words));
  const char* name = std::getenv("SKINFORGE_FUZZ_TARGET");
  if (name && std::string_view(name) == "seeds") std::exit(write_seeds(*count, *words));
  if (name && std::string_view(name) == "import" && *count == 2) std::exit(import_file((*words)[1]));
  chosen = name ? fuzz::find_target(name) : nullptr;
  if (!chosen) {
    std::fputs("SKINFORGE_FUZZ_TARGET names none of:", stderr);
    for (const fuzz::Target& target : fuzz::kTargets)
      std::fprintf(stderr, " %s", std::string(target.name).c_str());
    std::fputs("\n", stderr);
    std::exit(2);
  }
  tighten_limits();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string complaint = fuzz::complaint(*chosen, std::as_bytes(std::span(data, size)));
  if (!complaint.empty()) {
    std::fprintf(stderr, "not an error of one line that blames the input: %s\n", complaint.c_str());
    std::abort();
  }
  return 0;
}
