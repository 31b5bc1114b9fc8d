#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/archive.h"

namespace skinforge {

/// Files of a verb that builds without a recipe: gathered first, written together at the end, so that a
/// failure leaves nothing half-made. Each goes through a temporary file.
class OutputFolder {
 public:
  /// `inputs`: files that must not be overwritten.
  OutputFolder(std::filesystem::path folder, std::vector<std::filesystem::path> inputs)
      : folder_(std::move(folder)), inputs_(std::move(inputs)) {}

  void add(const std::string& name, Bytes bytes) { files_.push_back({name, std::move(bytes)}); }
  void add(const std::string& name, const std::string& text);

  /// Writes all. Throws Error: Usage where a file is an input, StageFailed where one cannot be written.
  /// Returns their paths, in the order in which they were added.
  std::vector<std::string> write() const;

 private:
  struct File {
    std::string name;
    Bytes bytes;
  };
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> inputs_;
  std::vector<File> files_;
};

}  // namespace skinforge
