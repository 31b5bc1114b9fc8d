#include "cli/diff_page.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/base64.h"
#include "cli/report_page.h"
#include "diff/diff_text.h"
#include "html/html_page.h"
#include "io/export.h"
#include "io/glb_map.h"
#include "io/image_codec.h"

namespace skinforge {
using nlohmann::json;

namespace {
constexpr std::uint8_t kUnmatched = 255;  // of a vertex without counterpart
constexpr double kSteps = 254;            // errors as bytes: 0 to 254 of the largest

// Per primitive the vertices of the character that it shows, as 32-bit little-endian numbers.
json vertices_of(const Character& character) {
  json primitives = json::array();
  for (const GlbMap::Primitive& primitive : glb_map(character).primitives) {
    Bytes bytes;
    for (const VertexId v : primitive.vertices)
      for (int shift = 0; shift < 32; shift += 8)
        bytes.push_back(static_cast<std::byte>(static_cast<std::uint32_t>(v.value) >> shift & 0xFF));
    primitives.push_back(base64(bytes));
  }
  return primitives;
}

// Distances of one moment or clip, per vertex of A, shares of the diagonal.
struct Errors {
  std::string clip;  // empty: the bind pose
  std::vector<float> of_a;
};

std::vector<Errors> errors_of(const Character& a, const Character& b, const CharacterDiff& diff) {
  Errors bind;
  for (std::size_t v = 0; v < diff.same.vertices.size(); ++v) {
    const VertexId image = diff.same.vertices[v];
    const double distance =
        image.is_valid() ? (a.mesh.positions[v] - b.mesh.positions[image.index()]).norm() : 0;
    bind.of_a.push_back(diff.diagonal > 0 ? static_cast<float>(distance / diff.diagonal) : 0.0F);
  }
  std::vector<Errors> all{std::move(bind)};
  for (const ClipDiff& clip : diff.clips) all.push_back({clip.clip, clip.vertex_max});
  return all;
}

// As bytes of both sides: a vertex of B has the largest error of those of A that it stands for.
json json_of(const Errors& errors, const Correspondence& same, std::size_t vertices_of_b) {
  const double most = errors.of_a.empty() ? 0 : *std::max_element(errors.of_a.begin(), errors.of_a.end());
  const auto step = [&](double error) {
    return static_cast<std::uint8_t>(most > 0 ? std::lround(kSteps * error / most) : 0);
  };
  std::vector<std::uint8_t> a(errors.of_a.size(), kUnmatched), b(vertices_of_b, kUnmatched);
  for (std::size_t v = 0; v < a.size(); ++v) {
    if (!same.vertices[v].is_valid()) continue;
    std::uint8_t& image = b[same.vertices[v].index()];
    a[v] = step(errors.of_a[v]);
    image = image == kUnmatched ? a[v] : std::max(image, a[v]);
  }
  return {{"clip", errors.clip},
          {"max", most},
          {"a", base64(std::as_bytes(std::span(a)))},
          {"b", base64(std::as_bytes(std::span(b)))}};
}

// In the order of `diff.pictures`.
std::vector<std::pair<std::string, Bytes>> drawings_of(const CharacterDiff& diff) {
  constexpr int kQuality = 82;  // ours: JPEG; ten pictures stay below 300 kB
  std::vector<std::pair<std::string, Bytes>> drawings;
  for (const PictureDiff& picture : diff.pictures)
    drawings.emplace_back(
        title_of(picture),
        encode_jpeg(picture_of_difference(picture.a, picture.b, title_of(picture)), kQuality));
  return drawings;
}
}  // namespace

std::string diff_page(const DiffRequest& request, const Character& a, const Character& b,
                      const CharacterDiff& diff, const std::vector<DiffFinding>& findings) {
  json data = to_json(diff, findings);
  const auto name = [](const std::string& path) { return std::filesystem::path(path).filename().string(); };
  data["a"] = {{"name", name(request.a)}, {"vertices", vertices_of(a)}};
  data["b"] = {{"name", name(request.b)}, {"vertices", vertices_of(b)}};
  data["errors"] = json::array();
  for (const Errors& errors : errors_of(a, b, diff))
    data["errors"].push_back(json_of(errors, diff.same, b.mesh.vertex_count()));
  HtmlPage page{.kind = "diff",
                .title = name(request.a) + " / " + name(request.b) + " \u2013 SkinForge",
                .json = {{"diff", data.dump(-1, ' ', false, json::error_handler_t::replace)}},
                .files = {},
                .pictures = drawings_of(diff)};
  if (Bytes viewer = viewer_module(); !viewer.empty())
    page.files = {{"model", write_glb(a)}, {"model_b", write_glb(b)}, {"viewer", std::move(viewer)}};
  return html_page(page);
}

}  // namespace skinforge
