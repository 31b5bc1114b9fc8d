#include "recipe/schema.h"

#include <nlohmann/json.hpp>

#include "recipe/schema_parts.h"
#include "recipe/schema_values.h"

namespace skinforge {

std::string recipe_schema() {
  using namespace schema;
  Json whole = closed_object({
      {"$schema", described("This schema, for editors.", text(), {"../schemas/recipe.schema.json"})},
      {"recipe_version", described("Version of the recipe's form.", {{"enum", {1}}}, {1})},
      {"name", described("Name of the character and of its files.",
                         {{"type", "string"}, {"pattern", kFileName}}, {"centaur"})},
      {"inputs", described("Characters that go in, by a name of your choice: a path, or an object.", inputs(),
                           {{{"horse", "horse.glb"}, {"man", {{"file", "man.fbx"}}}}})},
      {"base", described("Input that the operations start from.", text(), {"horse"})},
      {"ops",
       described("Operations, in order.",
                 {{"type", "array"}, {"items", operation()}, {"maxItems", 10000}, {"default", Json::array()}},
                 {{{{"op", "replace"}, {"at", "Neck1"}, {"from", "man"}, {"joint", "Spine"}}}})},
      {"surface", described("How the junction's surface is made.", surface(true), {{{"voxel_factor", 0.8}}})},
      {"animation", described("Which clips, and how they are completed.", animation(), {{{"clips", "all"}}})},
      {"correctives", described("Morph targets that correct linear blending in every clip.", correctives(),
                                {{{"method", "dqs"}, {"targets", 4}}})},
      {"output",
       described("Files to write, inside the output folder.", output(), {{{"glb", "centaur.glb"}}})},
      {"expect",
       described(
           "Budgets that the result has to keep, exit 4 when it does not; and a golden to stay like, exit 5.",
           expect(), {{{"triangles", 6000}, {"influences", 4}, {"watertight", true}}})},
      {"extends", described("Recipes that this one changes: what stands here is laid over them (merge patch, "
                            "null takes away), the later over the earlier.",
                            {{"anyOf", {path(), {{"type", "array"}, {"items", path()}, {"minItems", 1}}}}},
                            {"base.json", {"base.json", "fast.json"}})},
      {"vars",
       described("Variables, written as ${name} in any value; --set NAME=VALUE gives others.", variables(),
                 {{{"size", 1.2}, {"side", {{"default", "L"}, {"choices", {"L", "R"}}}}}})},
      {"matrix", described("One recipe for each combination of these values, written as ${matrix.axis}; the "
                           "name must tell them apart.",
                           matrix(), {{{"body", {"horse", "wolf"}}, {"torso", {"knight", "farmer"}}}})},
  });
  for (const char* key :
       {"name", "inputs", "base", "ops", "surface", "animation", "correctives", "output", "expect"})
    open_up(whole.at("properties").at(key));
  whole["anyOf"] = {{{"required", {"recipe_version", "name", "inputs", "base"}}},
                    {{"required", {"extends"}}}};
  Json head = {{"$schema", "http://json-schema.org/draft-07/schema#"},
               {"title", "SkinForge recipe"},
               {"description", "Parts of rigged, animated characters grafted into one."}};
  head.update(whole);
  return head.dump(2) + "\n";
}

}  // namespace skinforge
