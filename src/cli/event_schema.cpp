#include <nlohmann/json.hpp>

#include "cli/event_stream.h"

namespace skinforge {

namespace {
using Json = nlohmann::ordered_json;

Json text(const char* what) {
  return {{"type", "string"}, {"description", what}};
}

Json number(const char* what, const char* unit) {
  return {{"type", "number"}, {"minimum", 0}, {"unit", unit}, {"description", what}};
}

Json count(const char* what) {
  return {{"type", "integer"}, {"minimum", 0}, {"description", what}};
}

Json issues() {
  const Json issue = {{"type", "object"},
                      {"properties",
                       {{"code", text("Stable name of the kind (src/report/issues.md)")},
                        {"severity", {{"enum", {"note", "warning"}}}},
                        {"place", text("File, joint, clip that it is about")},
                        {"message", text("One sentence")}}},
                      {"required", {"code", "severity", "place", "message"}},
                      {"additionalProperties", false}};
  return {{"type", "array"}, {"items", issue}, {"description", "What was odd but usable"}};
}

// One kind of event: what all have, and what it has of its own.
Json event(const char* name, const char* what, bool is_of_recipe, const Json& own,
           std::vector<std::string> required) {
  Json properties = {{"event", {{"const", name}}},
                     {"time", number("From the start of the build", "seconds")}};
  if (is_of_recipe) {
    properties["recipe"] = text("File, as the person named it");
    properties["variant"] = text("Cell of the recipe's matrix; left out without one");
    required.emplace_back("recipe");
  }
  properties.update(own);
  for (const char* key : {"time", "event"}) required.insert(required.begin(), key);
  return {{"title", name},        {"description", what},
          {"type", "object"},     {"properties", properties},
          {"required", required}, {"additionalProperties", false}};
}
}  // namespace

std::string event_schema() {
  const Json stage = text("Stage and what it runs on: \"import horse\"");
  const Json exit_code = {{"type", "integer"}, {"description", "Exit status that this would end with"}};
  const Json schema = {
      {"$schema", "http://json-schema.org/draft-07/schema#"},
      {"title", "SkinForge event"},
      {"description", "One line of what `skinforge build --events FILE` writes."},
      {"oneOf",
       {event("build-started", "First.", false,
              {{"recipes", count("Characters to make")}, {"version", text("Of the program")}},
              {"recipes", "version"}),
        event("recipe-started", "A character is begun.", true, Json::object(), {}),
        event("stage-started", "A stage runs; one that is taken from the cache only finishes.", true,
              {{"stage", stage}}, {"stage"}),
        event("stage-finished", "A stage is done.", true,
              {{"stage", stage},
               {"status", {{"enum", {"hit", "ran", "failed", "skipped"}}}},
               {"wall_seconds", number("What it took, for a hit when it ran", "seconds")},
               {"cpu_seconds", number("Processor time, likewise", "seconds")},
               {"reason", text("Why it ran, or which failed stage it waited for")},
               {"error", text("Why it failed, one line")},
               {"issues", issues()}},
              {"stage", "status", "wall_seconds", "cpu_seconds", "issues"}),
        event("recipe-finished", "A character is done.", true,
              {{"name", text("Of the character; empty where the recipe could not be read")},
               {"exit_code", exit_code},
               {"error", text("Why it failed, one line")},
               {"seconds", number("What it took", "seconds")}},
              {"name", "exit_code", "seconds"}),
        event("build-finished", "Last.", false, {{"exit_code", exit_code}}, {"exit_code"})}}};
  return schema.dump(2) + "\n";
}

}  // namespace skinforge
