#pragma once

#include <vector>

#include "io/import.h"

namespace skinforge {

/// A glTF 2.0 file (.glb or .gltf with its buffers and images) as it is: exact, nothing settled, floats as
/// doubles without change. Metres and Y up already, so `metres_from_file` is the identity. The whole file is
/// checked first; each error is one line that names the place, e.g. "horse.glb: /accessors/3/count: ...".
/// `files` as from `read_input_files`; equal files give equal scenes. Throws Error (BadInput). Source:
/// glTF 2.0 specification, https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html
RawScene read_gltf(const std::vector<InputFile>& files);

}  // namespace skinforge
