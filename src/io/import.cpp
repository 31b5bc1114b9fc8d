#include "io/import.h"

#include <filesystem>

namespace skinforge {

Character import_character(const std::string& path, IssueSink& issues) {
  const RawScene scene = read_scene(read_input_files(path));
  return build_character(scene, std::filesystem::path(path).filename().string(), issues);
}

}  // namespace skinforge
