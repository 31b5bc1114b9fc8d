#include "render/pictures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "render/canvas.h"
#include "render/color.h"

namespace skinforge {
namespace {

const Vec3 kInsideOut(0.55, 0.0, 0.02);  // red that no material of ours has
const ViewAngles kFront{radians(35), radians(14)};
const ViewAngles kSide{radians(90), radians(6)};
const ViewAngles kBack{radians(215), radians(16)};

std::span<const Vec3> positions_of(const Subject& subject, const Posture& posture) {
  return posture.positions.empty() ? std::span<const Vec3>(subject.mesh().positions) : posture.positions;
}

double lowest(std::span<const Vec3> positions) {
  double low = positions.empty() ? 0 : positions[0].y();
  for (const Vec3& p : positions) low = std::min(low, p.y());
  return low;
}

Raster whole_body(const Subject& subject, const Posture& posture, const ViewAngles& angles,
                  DrawOptions options) {
  const auto positions = positions_of(subject, posture);
  options.floor = lowest(positions);
  const double aspect = static_cast<double>(options.width) / options.height;
  return draw(subject, posture, fit_view(positions, angles, aspect, 0.07), options);
}

double angle_between(const ViewAngles& a, const ViewAngles& b) {
  return std::acos(std::clamp(a.direction().dot(b.direction()), -1.0, 1.0));
}

// Views around the ball, the one that shows most of the junction first.
std::vector<ViewAngles> clearest_views(const Subject& subject, const Posture& posture,
                                       const JunctionShot& shot) {
  constexpr int kYaws = 12;  // ours: every 30 degrees, at three heights
  struct Candidate {
    ViewAngles angles;
    double area;
  };
  std::vector<Candidate> candidates;
  for (const double pitch_deg : {12.0, 45.0, -15.0})
    for (int i = 0; i < kYaws; ++i) {
      const ViewAngles angles{radians(35 + i * 360.0 / kYaws), radians(pitch_deg)};
      const View view = fit_view(shot.center, shot.radius, angles, 1, 0.04);
      candidates.push_back({angles, visible_area(subject, posture, shot.faces, view)});
    }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.area > b.area; });
  std::vector<ViewAngles> views;
  for (const Candidate& candidate : candidates) views.push_back(candidate.angles);
  return views;
}

std::string seconds_text(double time) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f s", time);
  return text;
}

}  // namespace

Raster rest_picture(const Subject& subject, const Posture& posture, int size) {
  std::vector<Raster> views;
  for (const ViewAngles& angles : {kFront, kSide, kBack})
    views.push_back(whole_body(subject, posture, angles, {.width = size, .height = size}));
  return tile(views);
}

Raster junction_picture(const Subject& subject, const JunctionShot& shot, const Posture& posture, int size) {
  const std::vector<ViewAngles> best = clearest_views(subject, posture, shot);
  const auto other = std::find_if(best.begin(), best.end(), [&](const ViewAngles& angles) {
    return angle_between(angles, best[0]) >= radians(90) - 1e-9;
  });
  DrawOptions options{.width = size, .height = size, .wireframe = true};
  options.highlight = shot.faces;
  options.back_face_color = kInsideOut;
  std::vector<Raster> views;
  for (const ViewAngles& angles : {best[0], *other})
    views.push_back(draw(subject, posture, fit_view(shot.center, shot.radius, angles, 1, 0.04), options));
  label(views[0], 10, 10, shot.title);
  return tile(views);
}

Raster weights_picture(const Subject& subject, const SkinWeights& weights, std::size_t joint_count,
                       int size) {
  const std::vector<Vec3> colors = dominant_weight_colors(weights, joint_count);
  DrawOptions options{.width = size, .height = size};
  options.vertex_colors = colors;
  std::vector<Raster> views;
  for (const ViewAngles& angles : {kFront, kBack}) views.push_back(whole_body(subject, {}, angles, options));
  return tile(views);
}

std::vector<Raster> clip_frames(const Subject& subject, std::span<const ClipFrame> frames,
                                const std::string& title, const StripOptions& options) {
  std::vector<Vec3> all;
  for (const ClipFrame& frame : frames) all.insert(all.end(), frame.positions.begin(), frame.positions.end());
  const View view = fit_view(all, options.angles, static_cast<double>(options.width) / options.height, 0.09);
  DrawOptions drawing{.width = options.width, .height = options.height};
  drawing.floor = lowest(all);
  constexpr int kScale = 1, kMargin = 6;
  std::vector<Raster> pictures;
  for (const ClipFrame& frame : frames) {
    drawing.highlight = frame.marked;
    Raster picture = draw(subject, {.positions = frame.positions}, view, drawing);
    const std::string time = (frame.marked.empty() ? "" : "worst ") + seconds_text(frame.time);
    label(picture, options.width - kMargin - label_width(time, kScale),
          options.height - kMargin - kLetterHeight, time, {.scale = kScale});
    if (pictures.empty()) label(picture, kMargin, kMargin, title, {.scale = kScale});
    pictures.push_back(std::move(picture));
  }
  return pictures;
}

Raster clip_picture(const Subject& subject, std::span<const ClipFrame> frames, const std::string& title,
                    const StripOptions& options) {
  return tile(clip_frames(subject, frames, title, options), {.gap = 2});
}

}  // namespace skinforge
