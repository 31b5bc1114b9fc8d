#include "cli/report_page.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "html/html_page.h"
#include "io/export.h"
#include "io/image_codec.h"
#include "pipeline/blob_store.h"
#include "pipeline/publish.h"
#include "render/shrink.h"
#include "report/report_json.h"
#include "stages/build.h"

namespace skinforge {
namespace fs = std::filesystem;
using nlohmann::json;

namespace {
constexpr std::size_t kPictureBytes = 300'000;  // ours: with the viewer the page stays below a megabyte
constexpr int kQuality = 82;                    // ours: JPEG; below, lines of wireframes blur
constexpr std::array kWidths = {1280, 1024, 768, 512, 384};  // ours: pixels, the first at which all fit

struct Picture {
  std::string name;
  Raster raster;
};

// Pictures of the build; strips of clips only where nothing else shows the clips.
std::vector<Picture> pictures_of(Session& session, bool with_clips) {
  std::vector<Picture> pictures;
  for (const OutputFile& file : outputs(session.recipe(), session.engine(), ReportLevel::Full)) {
    const fs::path path(file.name);
    const std::string name = path.stem().string();
    if (path.extension() != ".png" || (!with_clips && name.starts_with("clip_"))) continue;
    pictures.push_back({name, decode_image({.name = file.name,
                                            .mime = "image/png",
                                            .bytes = session.engine().get<Bytes>(file.artifact)})});
  }
  return pictures;
}

std::vector<std::pair<std::string, Bytes>> at_width(const std::vector<Picture>& pictures, int width) {
  std::vector<std::pair<std::string, Bytes>> files;
  for (const Picture& picture : pictures)
    files.emplace_back(picture.name, encode_jpeg(shrunk(picture.raster, width), kQuality));
  return files;
}

std::vector<std::pair<std::string, Bytes>> small_pictures(const std::vector<Picture>& pictures) {
  for (const int width : kWidths) {
    auto files = at_width(pictures, width);
    std::size_t bytes = 0;
    for (const auto& [name, file] : files) bytes += file.size();
    if (bytes <= kPictureBytes || width == kWidths.back()) return files;
  }
  return {};
}

std::string text_of(const Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Without what the page does not show, and without spaces.
std::string shown_report(const Bytes& bytes) {
  json report = json::parse(text_of(bytes));
  report.erase("joint_maps");
  return report.dump();
}
}  // namespace

Bytes viewer_module() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) return {};
  return DiskStore(program.parent_path()).read("skinforge_viewer.js.gz").value_or(Bytes());
}

std::string report_page(Session& session) {
  const ArtifactNames names;
  Engine& engine = session.engine();
  Bytes viewer = viewer_module();
  HtmlPage page{.kind = "build",
                .title = session.recipe().name + " \u2013 SkinForge",
                .json = {},
                .files = {},
                .pictures = {}};
  page.pictures = small_pictures(pictures_of(session, viewer.empty()));
  page.json = {{"report", shown_report(engine.get<Bytes>(names.report()))},
               {"timings", json::parse(to_json(session.timings())).dump()},
               {"view", text_of(engine.get<Bytes>(names.view()))}};
  if (viewer.empty()) return html_page(page);
  page.files = {{"model", engine.get<Bytes>(names.glb())}, {"viewer", std::move(viewer)}};
  return html_page(page);
}

void write_run_files(Session& session, ReportLevel level, const fs::path& folder, bool is_changed) {
  const fs::path timings = folder / "timings.json", page = folder / "report.html";
  if (level != ReportLevel::None && (is_changed || !fs::exists(timings)))
    write_output(timings, to_json(session.timings()));
  if (level == ReportLevel::Full && (is_changed || !fs::exists(page)))
    write_output(page, report_page(session));
}

}  // namespace skinforge
