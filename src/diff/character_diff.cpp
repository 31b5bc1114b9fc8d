#include "diff/character_diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diff/animation_diff.h"
#include "diff/corner_diff.h"
#include "diff/file_diff.h"
#include "diff/structure_diff.h"
#include "diff/surface_diff.h"

namespace skinforge {

namespace {
std::string percent(double share) {
  return fmt::format("{:.4g} %", 100 * share);
}

std::string worst_on(const std::string& joint) {
  return joint.empty() ? "" : fmt::format(", worst on \"{}\"", joint);
}

DiffFinding structure_finding(const StructureDiff& diff, const DiffThresholds& thresholds) {
  if (diff.edits.empty()) return {"structure", "names and counts", "nothing is missing or new", false};
  return {"structure", "names and counts",
          fmt::format("{} edits: {}{}", diff.edits.size(), diff.edits.front(),
                      diff.edits.size() > 1 ? ", ..." : ""),
          thresholds.structure};
}

// What cannot be compared is not the same.
DiffFinding clip_finding(const ClipDiff& clip, const DiffThresholds& thresholds) {
  if (!clip.is_compared)
    return {"animation", "clip " + clip.clip,
            "no vertex of A has a counterpart in B to compare its motion with", true};
  std::string text = fmt::format("a vertex moves otherwise by up to {} of the diagonal (limit {})",
                                 percent(clip.max), percent(thresholds.animation));
  if (clip.max > 0) text += fmt::format(", at {:.4g} s on \"{}\"", clip.time, clip.joint);
  const double longer = clip.duration_b - clip.duration_a;
  const bool is_longer = std::abs(longer) > thresholds.duration;
  if (is_longer) text += fmt::format("; it lasts {:+.4g} ms", 1000 * longer);
  return {"animation", "clip " + clip.clip, text, clip.max > thresholds.animation || is_longer};
}

std::optional<DiffFinding> picture_finding(const CharacterDiff& diff, const DiffThresholds& thresholds) {
  if (diff.is_drawn_alike)
    return DiffFinding{"picture", "pictures", "both are drawn from the same data", false};
  const PictureDiff* worst = diff.worst_picture();
  if (!worst) return std::nullopt;
  const PictureDifference& found = worst->difference;
  return DiffFinding{"picture", "pictures",
                     fmt::format("{} of the character changed (limit {}) in {}; colours differ by {} in the "
                                 "mean, SSIM {:.4f}, outlines overlap by {}",
                                 percent(found.changed), percent(thresholds.picture), title_of(*worst),
                                 percent(found.mean_error), found.ssim, percent(found.overlap)),
                     found.changed > thresholds.picture};
}
}  // namespace

std::string title_of(const PictureDiff& picture) {
  return picture.clip.empty() ? fmt::format("the bind pose, {}", picture.camera)
                              : fmt::format("{} at {:.3f} s, {}", picture.clip, picture.time, picture.camera);
}

const PictureDiff* CharacterDiff::worst_picture() const {
  const auto worst =
      std::max_element(pictures.begin(), pictures.end(), [](const PictureDiff& x, const PictureDiff& y) {
        return std::pair(x.difference.changed, -x.difference.ssim) <
               std::pair(y.difference.changed, -y.difference.ssim);
      });
  return worst == pictures.end() ? nullptr : &*worst;
}

const ClipDiff* CharacterDiff::worst_clip() const {
  const auto worst = std::max_element(clips.begin(), clips.end(),
                                      [](const ClipDiff& x, const ClipDiff& y) { return x.max < y.max; });
  return worst == clips.end() ? nullptr : &*worst;
}

CharacterDiff compare_characters(const Character& a, const Character& b, const DiffOptions& options) {
  CharacterDiff diff;
  diff.same = correspond(a, b);
  const Correspondence& same = diff.same;
  diff.diagonal = a.mesh.diagonal();
  diff.structure = compare_structure(a, b, same);
  diff.structure.a.bytes = options.a.bytes;
  diff.structure.b.bytes = options.b.bytes;
  diff.provenance = compare_provenance(options.a.provenance, options.b.provenance);
  diff.rules = compare_rules(options.a, options.b);
  for (std::string& edit : edits_of(diff.rules)) diff.structure.edits.push_back(std::move(edit));
  diff.geometry = compare_surfaces(a, b, same, diff.diagonal);
  compare_corners(a, b, same, diff.geometry);
  diff.geometry.uv_a = measure_uvs(a.mesh);
  diff.geometry.uv_b = measure_uvs(b.mesh);
  diff.skin = compare_weights(a, b, same);
  diff.clips = compare_clips(a, b, same, diff.diagonal, options.wants_vertices);
  return diff;
}

std::vector<DiffFinding> judge(const CharacterDiff& diff, const DiffThresholds& thresholds) {
  const CornerDiff &normals = diff.geometry.normals_deg, &uvs = diff.geometry.uvs;
  std::vector<DiffFinding> findings{structure_finding(diff.structure, thresholds)};
  findings.push_back({"geometry", "surface distance",
                      fmt::format("up to {} of the diagonal (limit {}), mean {}", percent(diff.geometry.max),
                                  percent(thresholds.geometry), percent(diff.geometry.mean)),
                      diff.geometry.max > thresholds.geometry});
  findings.push_back({"geometry", "normals",
                      fmt::format("up to {:.4g}° apart (limit {:.4g}°), mean {:.3g}°{}", normals.max,
                                  thresholds.normals, normals.mean, worst_on(normals.joint)),
                      normals.max > thresholds.normals});
  if (uvs.compared > 0)
    findings.push_back({"geometry", "UVs",
                        fmt::format("up to {:.4g} of the texture apart (limit {:.4g}), mean {:.3g}{}",
                                    uvs.max, thresholds.uv, uvs.mean, worst_on(uvs.joint)),
                        uvs.max > thresholds.uv});
  findings.push_back({"skin", "weights",
                      fmt::format("up to {:.4g} of 2 (limit {:.4g}), {} vertices changed{}", diff.skin.max,
                                  thresholds.weights, diff.skin.changed, worst_on(diff.skin.joint)),
                      diff.skin.max > thresholds.weights});
  for (const ClipDiff& clip : diff.clips) findings.push_back(clip_finding(clip, thresholds));
  if (auto finding = picture_finding(diff, thresholds)) findings.push_back(std::move(*finding));
  return findings;
}

bool is_over(const std::vector<DiffFinding>& findings) {
  return std::any_of(findings.begin(), findings.end(), [](const DiffFinding& f) { return f.is_over; });
}

}  // namespace skinforge
