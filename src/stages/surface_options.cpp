#include "stages/surface_options.h"

namespace skinforge {

SelectionOptions selection_options(const SurfaceOptions& surface, bool is_donor) {
  SelectionOptions options;
  options.smoothing_passes = surface.presence_smoothing;
  options.keep_variance = surface.keep_or_drop.variance;
  options.keep_mean = surface.keep_or_drop.mean;
  options.hardness = is_donor ? surface.hardness.from : surface.hardness.at;
  return options;
}

namespace {

BlendOperator blend_operator(BlendKind kind) {
  switch (kind) {
    case BlendKind::Paper:
      return BlendOperator::Paper;
    case BlendKind::Smin:
      return BlendOperator::Smin;
    case BlendKind::Gradient:
      return BlendOperator::Gradient;
    case BlendKind::Auto:
      break;
  }
  return BlendOperator::Auto;
}

}  // namespace

FieldOptions field_options(const RecipeOperation& operation) {
  FieldOptions options;
  options.voxel_factor = operation.surface.voxel_factor;
  options.voxel = operation.surface.voxel;
  options.blend = {blend_operator(operation.blend.kind), operation.blend.radius};
  return options;
}

JunctionElements junction_elements(const SurfaceOptions& surface) {
  return static_cast<JunctionElements>(surface.elements);
}

}  // namespace skinforge
