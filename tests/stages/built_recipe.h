#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "pipeline/engine.h"
#include "stages/artifacts.h"
#include "stages/build.h"

namespace skinforge::testing {

/// A recipe built in memory, without a report. `path`: where it would lie, for the files that it names.
class BuiltRecipe {
 public:
  BuiltRecipe(const nlohmann::json& recipe, const std::string& path) {
    const Recipe parsed = parse_recipe(recipe.dump(), path);
    add_imports(parsed, engine_, [&] { engine_.run(); });
    engine_.run();
    add_grafts(parsed, engine_, ReportLevel::None);
    engine_.run();
  }

  bool is_ok() const { return engine_.is_ok(); }
  template <class T>
  T get(const std::string& artifact) {
    return engine_.get<T>(artifact);
  }

 private:
  MemoryStore store_;
  Cache cache_{store_};
  Engine engine_{cache_, {}};
};

}  // namespace skinforge::testing
