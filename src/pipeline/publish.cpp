#include "pipeline/publish.h"

#include <algorithm>
#include <set>

#include "base/file_digest.h"
#include "base/safe_name.h"
#include "base/text.h"

namespace skinforge {
namespace fs = std::filesystem;

namespace {
[[noreturn]] void refuse(const std::string& name, const std::string& why) {
  throw Error(ExitCode::Usage, "output \"" + printable(name) + "\" " + why);
}

bool has_prefix(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

void expect_names(std::span<const OutputFile> files) {
  std::set<std::string> names;
  for (const OutputFile& file : files) {
    if (!is_safe_relative_path(file.name)) refuse(file.name, "is not a safe name inside the output folder");
    if (!names.insert(file.name).second) refuse(file.name, "is written twice");
  }
}

// Makes the folder of `name` and returns the file's path, which lies inside `root` even if links are
// followed.
fs::path path_inside(const fs::path& root, const std::string& name) {
  const fs::path path = root / name;
  std::error_code error;
  const fs::path planned = fs::weakly_canonical(path.parent_path(), error);
  if (error || !has_prefix(planned, root)) refuse(name, "leads outside the output folder");
  fs::create_directories(path.parent_path(), error);
  if (error) throw Error(ExitCode::StageFailed, path.parent_path().string() + ": cannot make this folder");
  return path;
}

void expect_no_input(const fs::path& path, const std::string& name, std::span<const fs::path> inputs) {
  std::error_code error;
  for (const fs::path& input : inputs)
    if (fs::equivalent(path, input, error)) refuse(name, "would overwrite an input");
}

// Digest of a regular file of that size; none for anything else.
std::optional<Digest> digest_of_file(const fs::path& path, std::uint64_t size) {
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(path, error)) || fs::file_size(path, error) != size)
    return std::nullopt;
  return sha256_of_file(path);
}
}  // namespace

std::vector<PublishedFile> publish(Engine& engine, std::span<const OutputFile> files, const fs::path& folder,
                                   std::span<const fs::path> inputs) {
  expect_names(files);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error(ExitCode::StageFailed, folder.string() + ": cannot make this folder");
  const fs::path root = fs::canonical(folder);

  std::vector<PublishedFile> published;
  for (const OutputFile& file : files) {
    if (!engine.has(file.artifact)) continue;
    const fs::path path = path_inside(root, file.name);
    expect_no_input(path, file.name, inputs);
    PublishedFile result{file.name, engine.digest(file.artifact), engine.size(file.artifact)};
    result.was_written = digest_of_file(path, result.size) != result.digest;
    if (result.was_written && !write_file_atomically(path, engine.bytes(file.artifact)))
      throw Error(ExitCode::StageFailed, path.string() + ": cannot write this file");
    published.push_back(std::move(result));
  }
  return published;
}

}  // namespace skinforge
