#include "pipeline/publish.h"

#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <set>

#include "base/safe_name.h"
#include "base/text.h"

namespace skinforge {
namespace fs = std::filesystem;

namespace {
[[noreturn]] void refuse(const std::string& name, const std::string& why) {
  throw Error(ExitCode::Usage, "output \"" + printable(name) + "\" " + why);
}

[[noreturn]] void cannot_make(const fs::path& folder, const std::error_code& why) {
  throw Error(ExitCode::StageFailed,
              fmt::format("{}: cannot make this folder: {}", printable(folder.string()), why.message()));
}

[[noreturn]] void cannot_write(const fs::path& path) {
  const int why = errno;
  throw Error(ExitCode::StageFailed,
              fmt::format("{}: cannot be written: {}", printable(path.string()), std::strerror(why)));
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
  if (error) cannot_make(path.parent_path(), error);
  return path;
}

void expect_no_input(const fs::path& path, const std::string& name, std::span<const fs::path> inputs) {
  std::error_code error;
  for (const fs::path& input : inputs)
    if (fs::equivalent(path, input, error)) refuse(name, "would overwrite an input");
}

// Digest of a regular file of that size; none for anything else.
std::optional<Digest> digest_of_file(const fs::path& path, std::uint64_t size, FileDigests& digests) {
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(path, error)) || fs::file_size(path, error) != size)
    return std::nullopt;
  return digests.of(path);
}
}  // namespace

void write_output(const fs::path& path, std::span<const std::byte> bytes) {
  if (!write_file_durably(path, bytes) || !sync_folder(path.parent_path())) cannot_write(path);
}

void write_output(const fs::path& path, std::string_view text) {
  write_output(path, std::as_bytes(std::span(text)));
}

std::vector<PublishedFile> publish(Engine& engine, std::span<const OutputFile> files, const fs::path& folder,
                                   std::span<const fs::path> inputs) {
  expect_names(files);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) cannot_make(folder, error);
  const fs::path root = fs::canonical(folder);

  std::vector<PublishedFile> published;
  std::set<fs::path> folders, changed;
  for (const OutputFile& file : files) {
    if (!engine.has(file.artifact)) continue;
    const fs::path path = path_inside(root, file.name);
    expect_no_input(path, file.name, inputs);
    PublishedFile result{file.name, engine.digest(file.artifact), engine.size(file.artifact)};
    result.was_written = digest_of_file(path, result.size, engine.digests()) != result.digest;
    if (result.was_written && !write_file_durably(path, engine.bytes(file.artifact))) cannot_write(path);
    folders.insert(path.parent_path());
    if (result.was_written) changed.insert(path.parent_path());
    published.push_back(std::move(result));
  }
  for (const fs::path& written : changed)
    if (!sync_folder(written)) cannot_write(written);
  for (const fs::path& used : folders)
    DiskStore(used).remove_stale_temporaries("");  // of builds that were killed
  return published;
}

}  // namespace skinforge
