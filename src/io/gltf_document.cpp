#include "io/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "base/error.h"
#include "base/text.h"
#include "io/glb_container.h"
#include "io/gltf_uri.h"

namespace skinforge {
namespace {

constexpr std::array<std::string_view, 6> kUnderstood = {
    "FB_ngon_encoding",    "KHR_materials_emissive_strength", "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_unlit", "KHR_mesh_quantization",           "KHR_texture_transform"};

bool is_understood(std::string_view extension) {
  return std::find(kUnderstood.begin(), kUnderstood.end(), extension) != kUnderstood.end();
}

void check_version(const JsonPlace& root) {
  const JsonPlace asset = root.get("asset");
  const std::string version = asset.get("version").text();
  if (!version.starts_with("2."))
    asset.get("version").fail(fmt::format("glTF \"{}\", wanted 2.0", printable(version)));
}

void check_extensions(const JsonPlace& root, const std::string& file, IssueSink& issues) {
  if (const auto list = root.find("extensionsRequired"))
    for (std::size_t i = 0; i < list->size(); ++i) {
      const std::string name = list->at(i).text();
      if (!is_understood(name))
        list->at(i).fail(fmt::format("extension \"{}\" is required but not understood", printable(name)));
    }
  if (const auto list = root.find("extensionsUsed"))
    for (std::size_t i = 0; i < list->size(); ++i)
      if (const std::string name = list->at(i).text(); !is_understood(name))
        issues.note("extension-ignored", file,
                    fmt::format("extension \"{}\" is not understood and left out", printable(name)));
}

std::span<const std::byte> buffer_bytes(const JsonPlace& place, std::size_t number,
                                        const std::vector<InputFile>& files,
                                        std::optional<std::span<const std::byte>> binary,
                                        GltfBuffers& buffers) {
  const auto uri = place.find("uri");
  if (!uri) {
    if (number == 0 && binary) return *binary;
    place.fail("has no data: neither a URI nor a BIN chunk");
  }
  if (is_data_uri(uri->text())) {
    buffers.owned.push_back(with_context(uri->place(), [&] { return decode_data_uri(uri->text()); }));
    return buffers.owned.back();
  }
  const InputFile* file = with_context(uri->place(), [&] { return find_file(files, uri->text()); });
  if (file == nullptr) uri->fail(fmt::format("no file \"{}\"", printable(uri->text())));
  return file->bytes;
}

GltfBuffers read_buffers(const JsonPlace& root, const std::vector<InputFile>& files,
                         std::optional<std::span<const std::byte>> binary) {
  GltfBuffers buffers;
  const auto list = root.objects("buffers");
  buffers.owned.reserve(list.size());  // spans point into it
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto bytes = buffer_bytes(list[i], i, files, binary, buffers);
    const std::size_t wanted = list[i].get("byteLength").count();
    if (wanted > bytes.size())
      list[i]
          .get("byteLength")
          .fail(fmt::format("{} bytes are promised, {} are there", wanted, bytes.size()));
    buffers.spans.push_back(bytes.first(wanted));
  }
  return buffers;
}

}  // namespace

GltfDocument open_gltf(const std::vector<InputFile>& files, IssueSink& issues) {
  const GlbChunks chunks = gltf_chunks(files.front().path, files.front().bytes);
  JsonDocument json(chunks.json);
  const JsonPlace root = json.root();
  const std::string name = printable(std::filesystem::path(files.front().path).filename().string());
  check_version(root);
  check_extensions(root, name, issues);
  GltfBuffers buffers = read_buffers(root, files, chunks.binary);
  GltfAccessors accessors(root, buffers);
  return {name, std::move(json), root, std::move(buffers), std::move(accessors), &files};
}

const InputFile* find_file(const std::vector<InputFile>& files, const std::string& uri) {
  const std::string path = resolve_uri(files.front().path, uri);
  const auto file =
      std::find_if(files.begin(), files.end(), [&](const InputFile& f) { return f.path == path; });
  return file == files.end() ? nullptr : &*file;
}

}  // namespace skinforge
