#include <dlfcn.h>
#include <link.h>
#include <sys/mman.h>

#include <fstream>
#include <iterator>
#include <new>

#include "base/error.h"
#include "base/hash.h"
#include "field/signed_distance.h"
#include "field/vdb/vdb_module.h"
#include "field/vdb_module_id.h"  // kVdbModule, kVdbModuleSha256: written by the build

namespace skinforge {
namespace {

[[noreturn]] void fail(const std::string& what) {
  throw Error(ExitCode::Internal, std::string(kVdbModule) + ": " + what);
}

std::string file_of(void* library) {
  const link_map* map = nullptr;
  return ::dlinfo(library, RTLD_DI_LINKMAP, &map) == 0 ? map->l_name : std::string();
}

// Results are cached under the id of the program, which knows the module by its digest.
void expect_own(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (sha256(std::as_bytes(std::span(bytes))).hex() != kVdbModuleSha256)
    fail("this file belongs to another build of skinforge");
}

// Libraries that the module brings start threads while they are loaded and end the process when that fails
// (log4cplus 2.0.8); so there must be room for all of it before. An `Error` would be remembered as one that
// the same recipe meets again.
void expect_room() {
  constexpr std::size_t kNeeded = std::size_t{160} << 20;  // ours: 93 MB measured, and stacks that come later
  void* room = ::mmap(nullptr, kNeeded, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (room == MAP_FAILED) throw std::bad_alloc();
  ::munmap(room, kNeeded);
}

const VdbFunctions& load() {
  expect_room();
  void* library = ::dlopen(kVdbModule, RTLD_LAZY | RTLD_LOCAL);
  if (!library) fail(std::string("cannot be loaded: ") + ::dlerror());
  expect_own(file_of(library));
  const auto* found = static_cast<const VdbFunctions*>(::dlsym(library, kVdbSymbol));
  if (!found) fail("is not what it should be");
  return *found;
}

const VdbFunctions& functions() {
  static const VdbFunctions& loaded = load();
  return loaded;
}

}  // namespace

Bytes to_vdb(const DistanceField& field) {
  return functions().to_vdb(field);
}

}  // namespace skinforge
