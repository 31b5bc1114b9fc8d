#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "cli/session.h"

/// What `plan` and `explain` share: the stages of a recipe with their states and changes, and how those are
/// said.
namespace skinforge {

struct RecipePlan {
  std::vector<StagePlan> stages;
  bool is_complete = false;  ///< false: further stages follow from inputs whose contents are not in the cache
};

/// Plans everything that can be known; runs nothing.
RecipePlan plan_recipe(Session& session);

/// "hit", "run", "waits".
const char* state_name(PlanState state);

/// Where in the recipe a change comes from, "centaur.json:12:9"; empty when it comes from elsewhere.
std::string place_of(const KeyChange& change, const Recipe& recipe);

/// One line for people: "/ops/0/place/scale: 1.2 -> 1.3 (centaur.json:12:9)". A property that one side does
/// not set is shown with its default.
std::string sentence(const KeyChange& change, const Recipe& recipe);

/// The same for programs: kind, name, before, after, place.
nlohmann::json to_json(const std::vector<KeyChange>& changes, const Recipe& recipe);

}  // namespace skinforge
