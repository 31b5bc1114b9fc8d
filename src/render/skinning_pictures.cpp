#include "render/skinning_pictures.h"

#include <algorithm>

#include "render/canvas.h"
#include "render/color.h"

namespace skinforge {
namespace {

const Vec3 kFree(0.72, 0.73, 0.75);
const ViewAngles kFront{radians(35), radians(14)}, kBack{radians(215), radians(16)};
constexpr int kMargin = 6;

Raster two_views(const Subject& subject, std::span<const Vec3> colors, const std::string& title, int size) {
  DrawOptions options{.width = size, .height = size};
  options.vertex_colors = colors;
  std::vector<Raster> views;
  for (const ViewAngles& angles : {kFront, kBack})
    views.push_back(draw(subject, {}, fit_view(subject.mesh().positions, angles, 1, 0.07), options));
  label(views[0], 2 * kMargin, 2 * kMargin, title);
  return tile(views);
}

}  // namespace

Raster handles_picture(const Subject& subject, std::span<const JointId> handles, std::size_t joint_count,
                       int size) {
  const std::vector<Vec3> of_joint = joint_colors(joint_count);
  std::vector<Vec3> colors;
  for (const JointId joint : handles) colors.push_back(joint.is_valid() ? of_joint[joint.index()] : kFree);
  return two_views(subject, colors, "handles", size);
}

Raster joint_weights_picture(const Subject& subject, const SkinWeights& weights, JointId joint,
                             const std::string& title, int size) {
  return two_views(subject, joint_weight_colors(weights, joint), title, size);
}

Raster methods_picture(const Subject& subject, std::span<const MethodFrames> methods,
                       const StripOptions& options) {
  std::vector<Vec3> all;
  std::size_t columns = 1;
  for (const MethodFrames& method : methods) {
    columns = std::max(columns, method.frames.size());
    for (const ClipFrame& frame : method.frames)
      all.insert(all.end(), frame.positions.begin(), frame.positions.end());
  }
  const View view = fit_view(all, options.angles, static_cast<double>(options.width) / options.height, 0.09);
  std::vector<Raster> pictures;
  for (const MethodFrames& method : methods)
    for (std::size_t i = 0; i < method.frames.size(); ++i) {
      DrawOptions drawing{.width = options.width, .height = options.height};
      std::vector<Vec3> colors;
      if (!method.heat.empty())
        for (const double value : method.heat[i]) colors.push_back(heat_color(value));
      drawing.vertex_colors = colors;
      Raster picture = draw(subject, {.positions = method.frames[i].positions}, view, drawing);
      if (i == 0) label(picture, kMargin, kMargin, method.title, {.scale = 2});
      if (i < method.captions.size())
        label(picture, kMargin, options.height - 3 * kMargin, method.captions[i], {.scale = 1});
      pictures.push_back(std::move(picture));
    }
  return tile(pictures, {.columns = static_cast<int>(columns), .gap = 2});
}

}  // namespace skinforge
