#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>

#include "base/error.h"
#include "base/text.h"
#include "io/file_kind.h"
#include "io/glb_container.h"
#include "io/gltf_json.h"
#include "io/gltf_uri.h"
#include "io/import.h"
#include "io/obj_statements.h"

namespace skinforge {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void bad(const std::string& path, const std::string& sentence) {
  throw Error(ExitCode::BadInput, fmt::format("{}: {}", printable(path), sentence));
}

/// An open file descriptor.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { ::close(number_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

int open_to_read(const std::string& path) {
  if (path.find('\0') != std::string::npos) bad(path, "no such file");
  // Without O_NONBLOCK opening a pipe would wait for its writer.
  const int number = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (number >= 0) return number;
  if (errno == ENOENT || errno == ENOTDIR) bad(path, "no such file");
  bad(path, std::string("cannot be opened: ") + std::strerror(errno));
}

FileStamp regular_stamp(const std::string& path, int number) {
  if (const auto stamp = stamp_of(number)) return *stamp;
  bad(path, "not a regular file");
}

/// Reads to the end; `expected` is only a guess, the file may have grown.
Bytes read_all(const std::string& path, int number, std::size_t expected, std::size_t max_bytes) {
  Bytes bytes(expected + 1);
  std::size_t filled = 0;
  for (;;) {
    if (filled == bytes.size()) bytes.resize(2 * bytes.size());
    const ssize_t got = ::read(number, bytes.data() + filled, bytes.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) bad(path, std::string("cannot be read: ") + std::strerror(errno));
    if (got == 0) break;
    filled += static_cast<std::size_t>(got);
    if (filled > max_bytes) bad(path, fmt::format("more than {} bytes, which is the limit", max_bytes));
  }
  bytes.resize(filled);
  return bytes;
}

/// A file that an asset names, and whether it can do without.
struct Reference {
  std::string path;
  bool needed = false;
};

void add_uris(std::vector<Reference>& list, const std::string& asset, const JsonPlace& root,
              const char* table, bool needed) {
  for (const JsonPlace& entry : root.objects(table)) {
    const auto uri = entry.find("uri");
    if (!uri || is_data_uri(uri->text())) continue;
    with_context(uri->place(), [&] { list.push_back({resolve_uri(asset, uri->text()), needed}); });
  }
}

/// Whether the JSON chunk of a GLB may name files; most do not, and need not be parsed for it.
bool mentions_uris(std::span<const std::byte> json) {
  return std::string_view(reinterpret_cast<const char*>(json.data()), json.size()).find("\"uri\"") !=
         std::string_view::npos;
}

std::vector<Reference> gltf_references(const InputFile& file) {
  const GlbChunks chunks = gltf_chunks(file.path, file.bytes);
  if (is_glb(file.bytes) && !mentions_uris(chunks.json)) return {};
  const JsonDocument document(chunks.json);
  std::vector<Reference> list;
  add_uris(list, file.path, document.root(), "buffers", true);
  add_uris(list, file.path, document.root(), "images", false);
  return list;
}

/// Names in an OBJ are hints of unknown age: one that leaves the folder is refused, one that is absent is
/// not.
std::vector<Reference> obj_references(const InputFile& file) {
  std::vector<Reference> list;
  for_each_statement(file.bytes, [&](const ObjStatement& s) {
    if (s.keyword == "mtllib" && !s.rest.empty()) list.push_back({resolve_name(file.path, s.rest), false});
  });
  return list;
}

/// Textures of a material library; options stand before the name, which is taken to have no blanks then.
std::vector<Reference> mtl_references(const InputFile& file) {
  std::vector<Reference> list;
  for_each_statement(file.bytes, [&](const ObjStatement& s) {
    const auto& keyword = s.keyword;
    if (!keyword.starts_with("map_") && keyword != "bump" && keyword != "norm" && keyword != "disp") return;
    std::string_view rest = s.rest;
    if (rest.starts_with('-')) rest = rest.substr(rest.find_last_of(" \t") + 1);
    if (!rest.empty()) list.push_back({resolve_name(file.path, rest), false});
  });
  return list;
}

std::vector<Reference> references(const InputFile& file) {
  const std::string extension = lower_extension(file.path);
  if (extension == ".gltf" || extension == ".glb") return gltf_references(file);
  if (extension == ".obj") return obj_references(file);
  if (extension == ".mtl") return mtl_references(file);
  return {};
}

/// Follows links, so that none leads out of the folder of the asset.
void check_inside(const std::string& asset, const std::string& path) {
  std::error_code failure;
  const fs::path parent = fs::path(asset).parent_path();
  const fs::path folder = fs::canonical(parent.empty() ? fs::path(".") : parent, failure);
  const fs::path target = fs::canonical(path, failure);
  if (failure) return;
  const fs::path below = target.lexically_relative(folder);
  if (below.empty() || *below.begin() == "..") bad(path, "leads out of the folder of the asset");
}

/// The referenced file; none when it may be absent and is.
std::optional<InputFile> read_reference(const InputFile& asset, const Reference& reference,
                                        FileDigests* digests) {
  if (!reference.needed && !fs::exists(reference.path)) return std::nullopt;
  check_inside(asset.path, reference.path);
  return read_input_file(reference.path, limits().file, digests);
}

bool is_read(const std::vector<InputFile>& files, const std::string& path) {
  return std::any_of(files.begin(), files.end(), [&](const InputFile& f) { return f.path == path; });
}

// Files of that kind beside one that is not there, for a mistyped name.
std::string nearest_files(const fs::path& path) {
  constexpr std::size_t kMost = 1000;  // ours: names to look through
  std::vector<std::string> names;
  std::error_code error;  // of a folder that is not there either
  for (fs::directory_iterator item(path.has_parent_path() ? path.parent_path() : fs::path("."), error), end;
       !error && item != end && names.size() < kMost; item.increment(error))
    if (item->path().extension() == path.extension()) names.push_back(item->path().filename().string());
  std::sort(names.begin(), names.end());
  return nearest_hint(path.filename().string(), names);
}

}  // namespace

InputFile read_input_file(const std::string& path, std::size_t max_bytes, FileDigests* digests) {
  const Descriptor file(open_to_read(path));
  const FileStamp stamp = regular_stamp(path, file.number());
  const std::size_t size = stamp.size;
  if (size > max_bytes)
    bad(path, fmt::format("{} bytes, the limit is {}; --limit file=N raises it", size, max_bytes));
  InputFile input{path, read_all(path, file.number(), size, max_bytes), {}};
  const bool is_as_before = digests && stamp_of(file.number()) == stamp && input.bytes.size() == size;
  input.digest = is_as_before ? digests->of(input.bytes, stamp) : sha256(input.bytes);
  return input;
}

std::vector<InputFile> read_input_files(const std::string& path, FileDigests* digests) {
  std::error_code error;
  if (!fs::exists(path, error) && !error && path.find('\0') == std::string::npos)
    bad(path, "no such file" + nearest_files(path));
  std::vector<InputFile> files;
  files.push_back(read_input_file(path, limits().file, digests));
  for (std::size_t i = 0; i < files.size(); ++i) {  // a material library found in an OBJ names files itself
    const auto list = with_context(printable(files[i].path), [&] { return references(files[i]); });
    for (const Reference& reference : list) {
      if (is_read(files, reference.path)) continue;
      auto file = with_context(printable(path), [&] { return read_reference(files[i], reference, digests); });
      if (file) files.push_back(std::move(*file));
    }
  }
  return files;
}

}  // namespace skinforge
