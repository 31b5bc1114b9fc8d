#include "io/memory_io_system.h"

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <cstring>
#include <string_view>

namespace skinforge {
namespace {

class MemoryStream final : public Assimp::IOStream {
 public:
  explicit MemoryStream(const Bytes& bytes) : bytes_(bytes) {}

  std::size_t Read(void* buffer, std::size_t size, std::size_t count) override {
    if (size == 0) return 0;
    const std::size_t items = std::min(count, (bytes_.size() - at_) / size);
    if (items > 0) std::memcpy(buffer, bytes_.data() + at_, items * size);
    at_ += items * size;
    return items;
  }
  std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
  aiReturn Seek(std::size_t offset, aiOrigin origin) override {
    const std::size_t base = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at_ : bytes_.size();
    const std::size_t target = base + offset;  // a negative offset wraps around twice
    if (target > bytes_.size()) return aiReturn_FAILURE;
    at_ = target;
    return aiReturn_SUCCESS;
  }
  std::size_t Tell() const override { return at_; }
  std::size_t FileSize() const override { return bytes_.size(); }
  void Flush() override {}

 private:
  const Bytes& bytes_;
  std::size_t at_ = 0;
};

std::string_view last_part(std::string_view name) {
  const auto slash = name.find_last_of("/\\");
  return slash == std::string_view::npos ? name : name.substr(slash + 1);
}

}  // namespace

const InputFile* MemoryIoSystem::find(std::string_view name) const {
  const auto file = std::find_if(files_.begin(), files_.end(),
                                 [&](const InputFile& f) { return last_part(f.path) == last_part(name); });
  return file == files_.end() ? nullptr : &*file;
}

Assimp::IOStream* MemoryIoSystem::Open(const char* name, const char* mode) {
  const InputFile* file = find(name);
  if (!file || std::strchr(mode, 'w')) return nullptr;
  return new MemoryStream(file->bytes);  // Assimp hands it back through Close
}

void MemoryIoSystem::Close(Assimp::IOStream* stream) {
  delete stream;
}

}  // namespace skinforge
