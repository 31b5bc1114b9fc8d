#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/engine.h"

namespace skinforge {

/// A file to be made of an artifact of type `Bytes`.
struct OutputFile {
  std::string name;      ///< relative to the output folder, a safe relative path (base/safe_name.h)
  std::string artifact;  ///< e.g. "glb"
};

struct PublishedFile {
  std::string name;
  Digest digest;
  std::uint64_t size = 0;
  bool was_written = false;  ///< false when the file was there with these bytes
};

/// Writes one output file so that it is there whole, after a power cut too, or as it was before. Throws Error
/// (StageFailed) "PATH: cannot be written: No space left on device".
void write_output(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_output(const std::filesystem::path& path, std::string_view text);

/// Brings artifacts into `folder` (made if need be): temporary file, on disk before it is renamed,
/// only where the present bytes differ; what killed builds left half-written is removed. An output whose
/// artifact is not known (its stage failed) is left out.
/// Throws Error: Usage for an unsafe or repeated name, for a name whose folder leads outside `folder` by a
/// link, and for a file listed in `inputs` (paths that must not be overwritten); StageFailed when a file
/// cannot be written.
std::vector<PublishedFile> publish(Engine& engine, std::span<const OutputFile> files,
                                   const std::filesystem::path& folder,
                                   std::span<const std::filesystem::path> inputs = {});

}  // namespace skinforge
