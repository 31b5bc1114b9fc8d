#include "io/glb_container.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>

#include "base/error.h"

namespace skinforge {
namespace {

constexpr std::size_t kHeaderSize = 12;
constexpr std::size_t kChunkHeaderSize = 8;
constexpr std::uint32_t kMagic = 0x46546C67;       // "glTF"
constexpr std::uint32_t kJsonType = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t kBinaryType = 0x004E4942;  // "BIN\0"

std::uint32_t word(std::span<const std::byte> bytes, std::size_t offset) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

[[noreturn]] void bad(const std::string& sentence) {
  throw Error(ExitCode::BadInput, sentence);
}

void check_header(std::span<const std::byte> file) {
  if (file.size() >= sizeof kMagic && word(file, 0) != kMagic)
    bad("not a GLB file: it does not start with \"glTF\"; export the model as .glb, or call the file what it "
        "is");
  if (file.size() < kHeaderSize)
    bad(fmt::format("truncated GLB: the header has {} bytes, file has {}; copy it anew", kHeaderSize,
                    file.size()));
  if (word(file, 4) != 2) bad(fmt::format("GLB version {}, wanted 2", word(file, 4)));
  const std::size_t length = word(file, 8);
  if (length > file.size())
    bad(fmt::format("truncated GLB: header says {} bytes, file has {}; copy it anew", length, file.size()));
  if (length < file.size()) bad(fmt::format("GLB: header says {} bytes, file has {}", length, file.size()));
}

struct Chunk {
  std::uint32_t type = 0;
  std::span<const std::byte> data;
};

Chunk chunk_at(std::span<const std::byte> file, std::size_t offset) {
  if (file.size() - offset < kChunkHeaderSize)
    bad(fmt::format("GLB: {} bytes at offset {} are too few for a chunk", file.size() - offset, offset));
  const std::size_t length = word(file, offset);
  const std::size_t room = file.size() - offset - kChunkHeaderSize;
  if (length > room)
    bad(fmt::format("GLB: the chunk at offset {} says {} bytes, {} are left", offset, length, room));
  if (length % 4 != 0)
    bad(fmt::format("GLB: the chunk at offset {} has {} bytes, not a multiple of 4", offset, length));
  return {word(file, offset + 4), file.subspan(offset + kChunkHeaderSize, length)};
}

}  // namespace

bool is_glb(std::span<const std::byte> file) {
  return file.size() >= 4 && word(file, 0) == kMagic;
}

GlbChunks parse_glb(std::span<const std::byte> file) {
  check_header(file);
  GlbChunks chunks;
  std::size_t number = 0;
  for (std::size_t offset = kHeaderSize; offset < file.size(); ++number) {
    const Chunk chunk = chunk_at(file, offset);
    offset += kChunkHeaderSize + chunk.data.size();
    if ((chunk.type == kJsonType) != (number == 0))
      bad("GLB: the JSON chunk must be the first one, and there once");
    if (chunk.type == kJsonType) chunks.json = chunk.data;
    if (chunk.type == kBinaryType && number != 1)
      bad("GLB: the BIN chunk must be the second one, and there once");
    if (chunk.type == kBinaryType) chunks.binary = chunk.data;
  }
  if (number == 0) bad("GLB: no JSON chunk");
  return chunks;
}

GlbChunks gltf_chunks(std::string_view path, std::span<const std::byte> file) {
  if (is_glb(file) || path.ends_with(".glb")) return parse_glb(file);
  return {file, {}};
}

}  // namespace skinforge
