#pragma once

#include <assimp/cfileio.h>

#include <string_view>
#include <vector>

#include "io/import.h"

namespace skinforge {

/// The only files Assimp gets to see: those that were read before, by the last part of their name (an
/// importer asks with folders and slashes of its own). Opens nothing on the disk, writes nothing. `files`
/// must outlive it.
class MemoryIoSystem {
 public:
  explicit MemoryIoSystem(const std::vector<InputFile>& files);
  MemoryIoSystem(const MemoryIoSystem&) = delete;  // the callbacks know its address
  MemoryIoSystem& operator=(const MemoryIoSystem&) = delete;

  /// What Assimp calls.
  aiFileIO& callbacks() { return callbacks_; }

  /// The file of that name; none when it is not among them.
  const InputFile* find(std::string_view name) const;

 private:
  const std::vector<InputFile>& files_;
  aiFileIO callbacks_ = {};
};

}  // namespace skinforge
