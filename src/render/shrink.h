#pragma once

#include "model/material.h"

namespace skinforge {

/// The picture at that width (pixels, at least 1), its height in proportion: each pixel is the mean of what
/// it covers, in the values as stored. A picture that is no wider stays as it is.
Raster shrunk(const Raster& raster, int width);

}  // namespace skinforge
