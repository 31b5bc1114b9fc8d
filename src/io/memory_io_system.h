#pragma once

#include <assimp/IOSystem.hpp>
#include <memory>
#include <string>
#include <vector>

#include "io/import.h"

namespace skinforge {

/// The only files Assimp gets to see: those that were read before, by the last part of their name (an
/// importer asks with folders and slashes of its own). Opens nothing on the disk, writes nothing. `files`
/// must outlive it.
class MemoryIoSystem final : public Assimp::IOSystem {
 public:
  explicit MemoryIoSystem(const std::vector<InputFile>& files) : files_(files) {}

  bool Exists(const char* name) const override { return find(name) != nullptr; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* name, const char* mode) override;
  void Close(Assimp::IOStream* stream) override;

  /// The file of that name; none when it is not among them.
  const InputFile* find(std::string_view name) const;

 private:
  const std::vector<InputFile>& files_;
};

}  // namespace skinforge
