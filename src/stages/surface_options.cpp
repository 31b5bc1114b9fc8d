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

FieldOptions field_options(const SurfaceOptions& surface) {
  FieldOptions options;
  options.voxel_factor = surface.voxel_factor;
  options.voxel = surface.voxel;
  return options;
}

JunctionElements junction_elements(const SurfaceOptions& surface) {
  return static_cast<JunctionElements>(surface.elements);
}

}  // namespace skinforge
