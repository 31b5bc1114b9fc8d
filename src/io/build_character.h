#pragma once

#include <string>

#include "base/issue.h"
#include "io/raw_scene.h"
#include "model/character.h"

namespace skinforge {

/// `build_character` (import.h) whose errors do not name the file yet.
Character settle_scene(const RawScene& scene, const std::string& place, IssueSink& issues);

}  // namespace skinforge
