#include <assimp/cimport.h>
#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "io/file_kind.h"
#include "io/gltf_reader.h"
#include "io/import.h"
#include "io/off_reader.h"
#include "io/sandbox.h"

namespace skinforge {

namespace {
bool is_known_to_assimp(const std::string& ending) {
  for (const char* common : {".fbx", ".dae", ".obj"})
    if (ending == common) return true;
  return !ending.empty() && aiIsExtensionSupported(ending.c_str()) == AI_TRUE;
}
}  // namespace

RawScene read_scene(const std::vector<InputFile>& files) {
  const std::string ending = lower_extension(files.front().path);
  if (ending == ".glb" || ending == ".gltf") return read_gltf(files);
  if (ending == ".off") return read_off(files.front());
  if (!is_known_to_assimp(ending))
    throw Error(ExitCode::BadInput,
                fmt::format("{}: no model format ends in \"{}\" (known: .glb, .gltf, .fbx, "
                            ".dae, .obj, .off and what else Assimp reads)",
                            printable(files.front().path), printable(ending)));
  return read_in_child(files);
}

}  // namespace skinforge
