#include <algorithm>
#include <cctype>
#include <filesystem>

#include "io/gltf_reader.h"
#include "io/import.h"
#include "io/off_reader.h"
#include "io/sandbox.h"

namespace skinforge {

RawScene read_scene(const std::vector<InputFile>& files) {
  std::string ending = std::filesystem::path(files.front().path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".glb" || ending == ".gltf") return read_gltf(files);
  if (ending == ".off") return read_off(files.front());
  return read_in_child(files);
}

}  // namespace skinforge
