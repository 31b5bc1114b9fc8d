#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace skinforge::testing {

/// Folder of the shared test material: SKINFORGE_SHARED, default "../shared" beside the repository.
inline std::filesystem::path shared_folder() {
  if (const char* folder = std::getenv("SKINFORGE_SHARED")) return folder;
  return std::filesystem::path(SKINFORGE_SOURCE_DIR) / ".." / "shared";
}

/// A shared file, e.g. shared_file("assets/quaternius_horse/horse.glb"). Tests that need one start with
/// SKINFORGE_NEEDS_SHARED(), which skips loudly where the folder is absent.
inline std::string shared_file(const std::string& relative) { return (shared_folder() / relative).string(); }

/// A file of this repository.
inline std::string repository_file(const std::string& relative) {
  return (std::filesystem::path(SKINFORGE_SOURCE_DIR) / relative).string();
}

}  // namespace skinforge::testing

#define SKINFORGE_NEEDS_SHARED()                                                          \
  do {                                                                                    \
    if (!std::filesystem::exists(skinforge::testing::shared_folder() / "assets"))         \
      GTEST_SKIP() << "SHARED ASSETS ABSENT: set SKINFORGE_SHARED to the folder of them"; \
  } while (false)
