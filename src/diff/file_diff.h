#pragma once

#include "diff/character_diff.h"

namespace skinforge {

/// What two files say otherwise about what they were made of, one sentence each: tool version, recipe, files
/// of inputs, other plain members. `a`, `b`: JSON text, of anybody; where one is empty there is nothing to
/// compare.
std::vector<std::string> compare_provenance(const std::string& a, const std::string& b);

/// Rules that the files break a different number of times, by rising code; nothing where one has no rules.
std::vector<RuleDelta> compare_rules(const FileFacts& a, const FileFacts& b);

/// One sentence for each error of B whose rule A keeps. How often a rule is broken depends on how many
/// accessors a writer makes of the same data, so more of the same are no edit.
std::vector<std::string> edits_of(const std::vector<RuleDelta>& rules);

}  // namespace skinforge
