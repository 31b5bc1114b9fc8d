#include "io/import.h"

#include <filesystem>

#include "base/error.h"
#include "base/text.h"
#include "io/build_character.h"

namespace skinforge {

Character import_character(const std::string& path, IssueSink& issues) {
  const RawScene scene = read_scene(read_input_files(path));
  const std::string place = std::filesystem::path(path).filename().string();
  return with_context(printable(path), [&] { return settle_scene(scene, place, issues); });
}

}  // namespace skinforge
