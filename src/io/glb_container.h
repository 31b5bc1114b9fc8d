#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace skinforge {

/// The chunks of a GLB file (glTF 2.0, section 4.4), as views into its bytes.
struct GlbChunks {
  std::span<const std::byte> json;
  std::optional<std::span<const std::byte>> binary;
};

/// Whether the bytes start like a GLB file (rather than like JSON text).
bool is_glb(std::span<const std::byte> file);

/// Takes a GLB file apart: header, lengths, order and alignment of the chunks. Chunks of unknown type behind
/// the two known ones are skipped. Throws Error (BadInput), e.g. "truncated GLB: header says 682356 bytes,
/// file has 20000".
GlbChunks parse_glb(std::span<const std::byte> file);

/// The same of a file that may be JSON alone, as .gltf files are; one that is called .glb has to be a GLB.
GlbChunks gltf_chunks(std::string_view path, std::span<const std::byte> file);

}  // namespace skinforge
