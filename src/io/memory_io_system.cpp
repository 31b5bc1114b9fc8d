#include "io/memory_io_system.h"

#include <algorithm>
#include <cstring>

namespace skinforge {
namespace {

// An open file: what Assimp holds, and where it reads.
struct MemoryFile {
  aiFile callbacks = {};
  const Bytes* bytes = nullptr;
  std::size_t at = 0;
};

MemoryFile& file_of(aiFile* file) {
  return *reinterpret_cast<MemoryFile*>(file->UserData);
}

std::size_t read(aiFile* file, char* buffer, std::size_t size, std::size_t count) {
  MemoryFile& f = file_of(file);
  if (size == 0) return 0;
  const std::size_t items = std::min(count, (f.bytes->size() - f.at) / size);
  if (items > 0) std::memcpy(buffer, f.bytes->data() + f.at, items * size);
  f.at += items * size;
  return items;
}

std::size_t write(aiFile*, const char*, std::size_t, std::size_t) {
  return 0;
}

aiReturn seek(aiFile* file, std::size_t offset, aiOrigin origin) {
  MemoryFile& f = file_of(file);
  const std::size_t base = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? f.at : f.bytes->size();
  const std::size_t target = base + offset;  // a negative offset wraps around twice
  if (target > f.bytes->size()) return aiReturn_FAILURE;
  f.at = target;
  return aiReturn_SUCCESS;
}

std::size_t tell(aiFile* file) {
  return file_of(file).at;
}

std::size_t size_of(aiFile* file) {
  return file_of(file).bytes->size();
}

void flush(aiFile*) {}

aiFile* open(aiFileIO* system, const char* name, const char* mode) {
  const InputFile* input = reinterpret_cast<const MemoryIoSystem*>(system->UserData)->find(name);
  if (!input || std::strchr(mode, 'w')) return nullptr;
  auto* file = new MemoryFile;  // Assimp hands it back through close
  file->callbacks = {read, write, tell, size_of, seek, flush, reinterpret_cast<aiUserData>(file)};
  file->bytes = &input->bytes;
  return &file->callbacks;
}

void close(aiFileIO*, aiFile* file) {
  delete &file_of(file);
}

std::string_view last_part(std::string_view name) {
  const auto slash = name.find_last_of("/\\");
  return slash == std::string_view::npos ? name : name.substr(slash + 1);
}

}  // namespace

MemoryIoSystem::MemoryIoSystem(const std::vector<InputFile>& files) : files_(files) {
  callbacks_ = {open, close, reinterpret_cast<aiUserData>(this)};
}

const InputFile* MemoryIoSystem::find(std::string_view name) const {
  const auto file = std::find_if(files_.begin(), files_.end(),
                                 [&](const InputFile& f) { return last_part(f.path) == last_part(name); });
  return file == files_.end() ? nullptr : &*file;
}

}  // namespace skinforge
