#pragma once

#include <string>
#include <vector>

#include "base/file_digest.h"
#include "base/hash.h"
#include "base/issue.h"
#include "base/limits.h"
#include "io/raw_scene.h"
#include "model/character.h"

namespace skinforge {

/// A file read once, with the digest of the bytes that were read.
struct InputFile {
  std::string path;
  Bytes bytes;
  Digest digest;
};

/// Reads a whole regular file. Throws Error (BadInput) "PATH: no such file", "PATH: not a regular file", ...
/// `max_bytes`: larger files are refused with both numbers. `digests`: of files that need not be hashed anew;
/// null: none.
InputFile read_input_file(const std::string& path, std::size_t max_bytes = limits().file,
                          FileDigests* digests = nullptr);

/// Everything that importing `path` depends on: the file and, for .gltf/.obj, the buffers and images it names
/// (inside its own folder only). First the file itself, then the others in order of their first mention.
/// Cheap: no decoding.
std::vector<InputFile> read_input_files(const std::string& path, FileDigests* digests = nullptr);

/// The file as its format has it. glTF/GLB and OFF by readers of our own in this process; FBX, DAE, OBJ and
/// the rest that Assimp reads by a child process with limits (sandbox.h). `files` as from `read_input_files`.
/// Throws Error (BadInput), one line, starting with the path.
RawScene read_scene(const std::vector<InputFile>& files);

/// Settles every quirk of the scene (`build_character.md` lists them) and returns sound data, `validate`d:
/// metres, Y up, bind pose as rest geometry, welded, one root, all joints, all clips. Each repair is an
/// issue. `place` (the file name) leads each message. Throws Error (BadInput) when nothing sound can be made
/// of it.
Character build_character(const RawScene& scene, const std::string& place, IssueSink& issues);

/// All of the above.
Character import_character(const std::string& path, IssueSink& issues);

}  // namespace skinforge
