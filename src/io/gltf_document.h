#pragma once

#include <string>
#include <vector>

#include "base/issue.h"
#include "io/gltf_accessors.h"
#include "io/gltf_json.h"
#include "io/import.h"

namespace skinforge {

/// A glTF file taken apart and checked: container, JSON, version, extensions, buffers, views, accessors. What
/// the readers of its parts share.
struct GltfDocument {
  std::string name;  ///< file name without folders, for issues
  JsonDocument json;
  JsonPlace root;
  GltfBuffers buffers;
  GltfAccessors accessors;
  const std::vector<InputFile>* files;

  /// Place of an issue: "horse.glb /meshes/0".
  std::string at(const JsonPlace& place) const { return name + " " + place.place(); }
};

/// Opens the first of `files`; the others are those it names (`read_input_files`). `files` must outlive the
/// result. Notes extensions that are not understood but not required. Throws Error (BadInput) without the
/// file's path.
GltfDocument open_gltf(const std::vector<InputFile>& files, IssueSink& issues);

/// The file that the asset, the first of `files`, names by `uri` (not a data URI); null when it is not among
/// them.
const InputFile* find_file(const std::vector<InputFile>& files, const std::string& uri);

}  // namespace skinforge
