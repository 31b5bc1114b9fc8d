#include "cli/build_id.h"

#include <elf.h>
#include <link.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string_view>
#include <vector>

#include "base/hash.h"
#include "base/version.h"

namespace skinforge {
namespace fs = std::filesystem;

namespace {
// Loaded when a stage needs them, after the keys are made; with spaces between.
constexpr const char* kLateLibraries = SKINFORGE_LATE_LIBRARIES;

std::string hex(const unsigned char* bytes, std::size_t size) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (std::size_t i = 0; i < size; ++i) {
    text.push_back(kDigits[bytes[i] >> 4]);
    text.push_back(kDigits[bytes[i] & 15]);
  }
  return text;
}

std::size_t aligned(std::size_t size) {
  return (size + 3) & ~std::size_t{3};
}

// The GNU build-id note in one note segment; empty when it has none.
std::string note_in(const char* notes, std::size_t size) {
  for (std::size_t at = 0; at + sizeof(ElfW(Nhdr)) <= size;) {
    ElfW(Nhdr) head;
    std::memcpy(&head, notes + at, sizeof head);
    const char* name = notes + at + sizeof head;
    const char* value = name + aligned(head.n_namesz);
    if (value + head.n_descsz > notes + size) break;
    if (head.n_type == NT_GNU_BUILD_ID &&
        std::string_view(name, head.n_namesz) == std::string_view("GNU\0", 4))
      return hex(reinterpret_cast<const unsigned char*>(value), head.n_descsz);
    at += sizeof head + aligned(head.n_namesz) + aligned(head.n_descsz);
  }
  return {};
}

// What is loaded: "libassimp.so.5 e4829e..." each, and where it lies.
struct Loaded {
  std::vector<std::string> objects;
  std::set<fs::path> folders;
};

int visit(dl_phdr_info* object, std::size_t, void* result) {
  auto& loaded = *static_cast<Loaded*>(result);
  const fs::path path = object->dlpi_name;
  if (path.filename().string().starts_with("linux-vdso")) return 0;  // the kernel's; it only tells the time
  std::string id;
  for (int i = 0; i < object->dlpi_phnum && id.empty(); ++i) {
    const auto& segment = object->dlpi_phdr[i];
    if (segment.p_type == PT_NOTE)
      id = note_in(reinterpret_cast<const char*>(object->dlpi_addr + segment.p_vaddr), segment.p_memsz);
  }
  loaded.objects.push_back(path.filename().string() + " " + id);
  if (path.has_parent_path()) loaded.folders.insert(path.parent_path());
  return 0;
}

// Build id in a library's file, from its first pages; empty when it has none.
std::string note_of_file(const fs::path& path) {
  std::vector<char> head(16 << 10);
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  const auto size = static_cast<std::size_t>(file.gcount());
  ElfW(Ehdr) elf;
  if (size < sizeof elf) return {};
  std::memcpy(&elf, head.data(), sizeof elf);
  for (std::size_t i = 0; i < elf.e_phnum; ++i) {
    ElfW(Phdr) segment;
    const std::size_t at = elf.e_phoff + i * sizeof segment;
    if (at + sizeof segment > size) break;
    std::memcpy(&segment, head.data() + at, sizeof segment);
    if (segment.p_type != PT_NOTE || segment.p_offset + segment.p_filesz > size) continue;
    if (auto id = note_in(head.data() + segment.p_offset, segment.p_filesz); !id.empty()) return id;
  }
  return {};
}

// Libraries that are loaded late lie where the others do, or where the person sends the loader.
void add_late_libraries(Loaded& loaded) {
  const char* path = std::getenv("LD_LIBRARY_PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (!folder.empty()) loaded.folders.insert(folder);
  std::istringstream names(kLateLibraries);
  for (std::string name; names >> name;)
    for (const fs::path& folder : loaded.folders)
      if (const std::string id = note_of_file(folder / name); !id.empty())
        loaded.objects.push_back(name + " " + id);
}

// The C library picks its sines and powers by what the processor can do, and they differ in the last bit.
const char* arithmetic() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("fma") && __builtin_cpu_supports("avx2")) return "fma";
#endif
  return "plain";
}
}  // namespace

std::string build_id() {
  static const std::string id = [] {
    Loaded loaded;
    ::dl_iterate_phdr(visit, &loaded);
    add_late_libraries(loaded);
    std::sort(loaded.objects.begin(), loaded.objects.end());
    loaded.objects.erase(std::unique(loaded.objects.begin(), loaded.objects.end()), loaded.objects.end());
    Hasher hasher;
    for (const std::string& object : loaded.objects) hasher.add("object", object);
    hasher.add("arithmetic", std::string(arithmetic()));
    return std::string(kVersion) + "+" + hasher.finish().hex().substr(0, 40);
  }();
  return id;
}

}  // namespace skinforge
