#include "diff/diff_text.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "base/text.h"

namespace skinforge {
using nlohmann::json;

namespace {
struct Count {
  const char* name;
  std::uint64_t CharacterCounts::*value;
};
constexpr std::array kCounts = {Count{"bytes", &CharacterCounts::bytes},
                                Count{"joints", &CharacterCounts::joints},
                                Count{"vertices", &CharacterCounts::vertices},
                                Count{"faces", &CharacterCounts::faces},
                                Count{"triangles", &CharacterCounts::triangles},
                                Count{"quads", &CharacterCounts::quads},
                                Count{"components", &CharacterCounts::components},
                                Count{"open edges", &CharacterCounts::open_edges},
                                Count{"non-manifold edges", &CharacterCounts::non_manifold_edges},
                                Count{"genus", &CharacterCounts::genus},
                                Count{"boundary loops", &CharacterCounts::boundary_loops},
                                Count{"parts", &CharacterCounts::parts},
                                Count{"materials", &CharacterCounts::materials},
                                Count{"images", &CharacterCounts::images},
                                Count{"UV sets", &CharacterCounts::uv_sets},
                                Count{"morph targets", &CharacterCounts::morphs},
                                Count{"influences", &CharacterCounts::influences},
                                Count{"clips", &CharacterCounts::clips},
                                Count{"keys", &CharacterCounts::keys}};

std::string ratio(std::uint64_t a, std::uint64_t b) {
  if (a == b) return "";
  return a == 0 ? "  new" : fmt::format("  x {:.3g}", double(b) / double(a));
}

std::string counts_text(const StructureDiff& diff) {
  std::string text = fmt::format("{:<20}{:>12}{:>12}\n", "", "A", "B");
  for (const Count& count : kCounts)
    text += fmt::format("{:<20}{:>12}{:>12}{}\n", count.name, diff.a.*count.value, diff.b.*count.value,
                        ratio(diff.a.*count.value, diff.b.*count.value));
  return text;
}

std::string clips_text(const std::vector<ClipDiff>& clips) {
  if (clips.empty()) return "";
  std::string text = "clips, % of the diagonal\n";
  text += fmt::format("  {:<24}{:>10}{:>10}{:>10}  {:<16}{:>10}{:>9}{:>16}\n", "", "max", "rms", "at s", "on",
                      "joints", "turn", "keys");
  for (const ClipDiff& c : clips)
    text += fmt::format("  {:<24}{:>10.4g}{:>10.4g}{:>10.4g}  {:<16}{:>10.4g}{:>8.3g}°{:>16}\n",
                        printable(c.clip), 100 * c.max, 100 * c.rms, c.time, printable(c.joint),
                        100 * c.joint_max, c.joint_angle_deg, fmt::format("{} -> {}", c.keys_a, c.keys_b));
  return text;
}

std::string change_text(double a, double b) {
  if (a == b || a == 0) return "";
  return fmt::format(" ({:+.3g} %)", 100 * (b / a - 1));
}

std::string geometry_text(const GeometryDiff& g) {
  return fmt::format(
      "area {:.6g} -> {:.6g} m²{}, volume {:.6g} -> {:.6g} m³{}, {:.4g} % of the vertices unmoved\n",
      g.area_a, g.area_b, change_text(g.area_a, g.area_b), g.volume_a, g.volume_b,
      change_text(g.volume_a, g.volume_b), 100 * g.unchanged);
}

std::string uv_text(const UvMeasures& a, const UvMeasures& b) {
  if (a.triangles + a.flat + b.triangles + b.flat == 0) return "";
  return fmt::format(
      "UV stretch {:.4g} -> {:.4g}, largest {:.4g} -> {:.4g}; {:.4g} % -> {:.4g} % of their area used more "
      "than once; {} -> {} triangles below a texel\n",
      a.stretch, b.stretch, a.stretch_max, b.stretch_max, 100 * a.overlap, 100 * b.overlap, a.flat, b.flat);
}

std::string files_text(const CharacterDiff& diff) {
  std::string text;
  for (const std::string& sentence : diff.provenance) text += "  provenance, " + printable(sentence) + "\n";
  for (const RuleDelta& rule : diff.rules)
    text += fmt::format("  glTF {} {}: {} -> {}\n", rule.is_error ? "error" : "warning", printable(rule.code),
                        rule.in_a, rule.in_b);
  return text;
}

std::string influences_text(const std::vector<std::size_t>& counts) {
  std::string text;
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (counts[i] > 0) text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", i, counts[i]);
  return text.empty() ? "none" : text;
}

std::string skin_text(const SkinDiff& skin) {
  const std::string a = influences_text(skin.influences_a), b = influences_text(skin.influences_b);
  return "vertices by joints they follow  " + (a == b ? a : a + "  ->  " + b) + "\n";
}

std::string pictures_text(const std::vector<PictureDiff>& pictures) {
  if (pictures.empty()) return "";
  std::string text = fmt::format("{:<42}{:>10}{:>12}{:>10}{:>10}\n", "pictures, % of the character",
                                 "changed", "colour", "SSIM", "overlap");
  for (const PictureDiff& picture : pictures) {
    const PictureDifference& d = picture.difference;
    text += fmt::format("  {:<40}{:>10.4g}{:>12.4g}{:>10.4f}{:>10.4g}\n", printable(title_of(picture)),
                        100 * d.changed, 100 * d.mean_error, d.ssim, 100 * d.overlap);
  }
  return text;
}

json to_json(const CharacterCounts& counts) {
  json object = json::object();
  for (const Count& count : kCounts) {
    std::string name = count.name;
    for (char& c : name) c = c == ' ' || c == '-' ? '_' : c == 'U' ? 'u' : c == 'V' ? 'v' : c;
    object[name] = counts.*count.value;
  }
  return object;
}

json to_json(const ClipDiff& c) {
  return {{"clip", c.clip},
          {"compared", c.is_compared},
          {"max", c.max},
          {"rms", c.rms},
          {"time", c.time},
          {"joint", c.joint},
          {"joint_max", c.joint_max},
          {"joint_angle_deg", c.joint_angle_deg},
          {"duration_a", c.duration_a},
          {"duration_b", c.duration_b},
          {"keys_a", c.keys_a},
          {"keys_b", c.keys_b}};
}

json to_json(const CornerDiff& c) {
  return {{"max", c.max}, {"mean", c.mean}, {"joint", c.joint}, {"compared", c.compared}};
}

json to_json(const UvMeasures& uv) {
  return {{"stretch", uv.stretch},
          {"stretch_max", uv.stretch_max},
          {"overlap", uv.overlap},
          {"triangles", uv.triangles},
          {"flat_triangles", uv.flat}};
}

json to_json(const std::vector<RuleDelta>& rules) {
  json list = json::array();
  for (const RuleDelta& rule : rules)
    list.push_back({{"code", rule.code},
                    {"severity", rule.is_error ? "error" : "warning"},
                    {"a", rule.in_a},
                    {"b", rule.in_b}});
  return list;
}

json to_json(const PictureDiff& p) {
  return {{"camera", p.camera},
          {"clip", p.clip.empty() ? json() : json(p.clip)},
          {"time", p.time},
          {"title", title_of(p)},
          {"changed", p.difference.changed},
          {"mean_error", p.difference.mean_error},
          {"ssim", p.difference.ssim},
          {"overlap", p.difference.overlap}};
}
}  // namespace

std::string to_text(const CharacterDiff& diff, const std::vector<DiffFinding>& findings) {
  std::string text = counts_text(diff.structure);
  for (const std::string& edit : diff.structure.edits) text += "  " + printable(edit) + "\n";
  if (diff.geometry.unmatched_a + diff.geometry.unmatched_b > 0)
    text += fmt::format("  {} vertices of A and {} of B have no counterpart\n", diff.geometry.unmatched_a,
                        diff.geometry.unmatched_b);
  text += files_text(diff);
  text += geometry_text(diff.geometry) + uv_text(diff.geometry.uv_a, diff.geometry.uv_b);
  text += skin_text(diff.skin);
  text += clips_text(diff.clips) + pictures_text(diff.pictures);
  for (const DiffFinding& f : findings)
    text +=
        fmt::format("{} {}, {}: {}\n", f.is_over ? "!" : " ", f.group, printable(f.name), printable(f.text));
  return text;
}

json to_json(const CharacterDiff& diff, const std::vector<DiffFinding>& findings) {
  json clips = json::array(), verdicts = json::array(), pictures = json::array();
  for (const PictureDiff& picture : diff.pictures) pictures.push_back(to_json(picture));
  for (const ClipDiff& clip : diff.clips) clips.push_back(to_json(clip));
  for (const DiffFinding& f : findings)
    verdicts.push_back({{"group", f.group}, {"name", f.name}, {"text", f.text}, {"is_over", f.is_over}});
  return {
      {"diagonal_metres", diff.diagonal},
      {"structure",
       {{"a", to_json(diff.structure.a)}, {"b", to_json(diff.structure.b)}, {"edits", diff.structure.edits}}},
      {"provenance", diff.provenance},
      {"rules", to_json(diff.rules)},
      {"geometry",
       {{"max", diff.geometry.max},
        {"p99", diff.geometry.p99},
        {"mean", diff.geometry.mean},
        {"unmatched_a", diff.geometry.unmatched_a},
        {"unmatched_b", diff.geometry.unmatched_b},
        {"unchanged", diff.geometry.unchanged},
        {"area_a", diff.geometry.area_a},
        {"area_b", diff.geometry.area_b},
        {"volume_a", diff.geometry.volume_a},
        {"volume_b", diff.geometry.volume_b},
        {"normals_deg", to_json(diff.geometry.normals_deg)},
        {"uvs", to_json(diff.geometry.uvs)},
        {"uv_a", to_json(diff.geometry.uv_a)},
        {"uv_b", to_json(diff.geometry.uv_b)}}},
      {"skin",
       {{"max", diff.skin.max},
        {"mean", diff.skin.mean},
        {"joint", diff.skin.joint},
        {"changed", diff.skin.changed},
        {"vertices_by_influences_a", diff.skin.influences_a},
        {"vertices_by_influences_b", diff.skin.influences_b}}},
      {"clips", std::move(clips)},
      {"pictures", std::move(pictures)},
      {"drawn_alike", diff.is_drawn_alike},
      {"findings", std::move(verdicts)}};
}

}  // namespace skinforge
