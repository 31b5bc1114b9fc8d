#pragma once

#include "report/report.h"
#include "stages/artifacts.h"
#include "surface/site_field.h"
#include "texture/color_steps.h"

namespace skinforge {

/// What the report says of the junction of one operation. `field`: its distance field, empty where it was
/// made without one.
JunctionReport report_junction(const SurfaceResult& surface, std::size_t site, const SiteField& field,
                               const ColorSteps& color);

}  // namespace skinforge
