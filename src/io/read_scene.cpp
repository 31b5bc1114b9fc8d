#include "io/file_kind.h"
#include "io/gltf_reader.h"
#include "io/import.h"
#include "io/off_reader.h"
#include "io/sandbox.h"

namespace skinforge {

RawScene read_scene(const std::vector<InputFile>& files) {
  const std::string ending = lower_extension(files.front().path);
  if (ending == ".glb" || ending == ".gltf") return read_gltf(files);
  if (ending == ".off") return read_off(files.front());
  return read_in_child(files);
}

}  // namespace skinforge
