#include "cli/build_id.h"

#include <elf.h>
#include <link.h>

#include <cstring>
#include <string_view>

#include "base/version.h"

namespace skinforge {

namespace {
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
    if (head.n_type == NT_GNU_BUILD_ID &&
        std::string_view(name, head.n_namesz) == std::string_view("GNU\0", 4))
      return hex(reinterpret_cast<const unsigned char*>(value), head.n_descsz);
    at += sizeof head + aligned(head.n_namesz) + aligned(head.n_descsz);
  }
  return {};
}

// Called for the program itself first; that is enough.
int visit(dl_phdr_info* object, std::size_t, void* result) {
  auto& id = *static_cast<std::string*>(result);
  for (int i = 0; i < object->dlpi_phnum && id.empty(); ++i) {
    const auto& segment = object->dlpi_phdr[i];
    if (segment.p_type == PT_NOTE)
      id = note_in(reinterpret_cast<const char*>(object->dlpi_addr + segment.p_vaddr), segment.p_memsz);
  }
  return 1;
}
}  // namespace

std::string build_id() {
  std::string id;
  ::dl_iterate_phdr(visit, &id);
  return id.empty() ? kVersion : std::string(kVersion) + "+" + id;
}

}  // namespace skinforge
