#pragma once

#include <string>

#include "base/issue.h"
#include "model/character.h"
#include "skeleton/graft.h"
#include "surface/selection.h"

namespace skinforge {

/// Warns of what one source loses or leaves behind because its joints are not where the surface is: parts of
/// the character that would stay in the air, and parts of an input that do not come along; names the joints
/// that cure it. `input`: name of the source's input.
void tell_loose_parts(const Graft& graft, SourceId source, const Character& character,
                      const SourceSelection& selection, const std::string& input, IssueSink& issues);

}  // namespace skinforge
