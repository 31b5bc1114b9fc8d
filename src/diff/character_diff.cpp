#include "diff/character_diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diff/animation_diff.h"
#include "diff/structure_diff.h"
#include "diff/surface_diff.h"

namespace skinforge {

namespace {
std::string percent(double share) {
  return fmt::format("{:.4g} %", 100 * share);
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
}  // namespace

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
  diff.structure.a = count(a, options.bytes_a);
  diff.structure.b = count(b, options.bytes_b);
  diff.geometry = compare_surfaces(a, b, same, diff.diagonal);
  diff.skin = compare_weights(a, b, same);
  diff.clips = compare_clips(a, b, same, diff.diagonal, options.wants_vertices);
  return diff;
}

std::vector<DiffFinding> judge(const CharacterDiff& diff, const DiffThresholds& thresholds) {
  std::vector<DiffFinding> findings{structure_finding(diff.structure, thresholds)};
  findings.push_back({"geometry", "surface distance",
                      fmt::format("up to {} of the diagonal (limit {}), mean {}", percent(diff.geometry.max),
                                  percent(thresholds.geometry), percent(diff.geometry.mean)),
                      diff.geometry.max > thresholds.geometry});
  findings.push_back({"skin", "weights",
                      fmt::format("up to {:.4g} of 2 (limit {:.4g}), {} vertices changed{}", diff.skin.max,
                                  thresholds.weights, diff.skin.changed,
                                  diff.skin.joint.empty() ? "" : ", worst on \"" + diff.skin.joint + "\""),
                      diff.skin.max > thresholds.weights});
  for (const ClipDiff& clip : diff.clips) findings.push_back(clip_finding(clip, thresholds));
  return findings;
}

bool is_over(const std::vector<DiffFinding>& findings) {
  return std::any_of(findings.begin(), findings.end(), [](const DiffFinding& f) { return f.is_over; });
}

}  // namespace skinforge
