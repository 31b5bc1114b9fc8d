#pragma once

#include "io/raw_scene.h"

namespace skinforge {

/// Checks what the reading of a scene promises to those behind it: indices in range, matching counts, finite
/// numbers (weights may be anything), nodes that form trees. A scene that comes back from a worker process
/// is not trusted before. Throws Error (BadInput) that names the first fault. Linear.
void check_raw_scene(const RawScene& scene);

}  // namespace skinforge
