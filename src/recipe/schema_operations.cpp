#include <nlohmann/json.hpp>

#include "recipe/recipe.h"
#include "recipe/schema_parts.h"
#include "recipe/schema_values.h"

namespace skinforge::schema {

namespace {
Json scale() {
  return {{"anyOf",
           {{{"type", "number"}, {"exclusiveMinimum", 0}, {"maximum", 1e9}},
            {{"type", "string"}, {"enum", {"loop"}}}}},
          {"unit", "factor"}};
}

Json placement() {
  const Placement defaults;
  return closed_object({
      {"align",
       described("joint: `joint` comes onto `at`; loop: the centres of the cut loops come together; "
                 "none: it stays, p -> scale R p + offset about the input's origin.",
                 {{"type", "string"}, {"enum", {"joint", "loop", "none"}}, {"default", "joint"}}, {"joint"})},
      {"scale", described("Size of the part; \"loop\" makes the girths of the cut loops equal.",
                          with_default(scale(), defaults.scale), {1.2, "loop"})},
      {"rotate_deg", described("Turn about x, y and z of the model: R = Ry Rx Rz.",
                               with_default(vector3("degrees"), defaults.rotate_deg), {{0, -90, 0}})},
      {"offset",
       described("Move at the end.", with_default(vector3("metres"), defaults.offset), {{0, 0.05, 0}})},
      {"turn_limit_deg",
       described(
           "A part that stands at so sharp an angle to its host that their surfaces would not join is turned "
           "back by at most this; 0: never.",
           with_default(number(0, 180, "degree"), defaults.turn_limit_deg), {0})},
  });
}

Json blend() {
  const Json name = {{"type", "string"}, {"enum", {"auto", "blend", "union", "paper", "smin", "gradient"}}};
  const Json object = closed_object({
      {"operator", described("The operator.", with_default(name, "auto"), {"gradient"})},
      {"radius",
       described("Radius of the fillet; by default 1.2 radii of the thinner limb, or three voxels for an "
                 "attachment.",
                 {{"type", "number"}, {"exclusiveMinimum", 0}, {"maximum", 1e9}, {"unit", "metres"}},
                 {0.05})},
  });
  return {{"oneOf", Json::array({name, object})}, {"default", "auto"}};
}

Json if_operation(Json kinds, Json consequence) {
  return {{"if", {{"properties", {{"op", {{"enum", std::move(kinds)}}}}}}}, {"then", std::move(consequence)}};
}

// What an operation of each kind must, may and may not say.
Json rules_of_kinds() {
  const Json one_joint = {{"anyOf", {text(), {{"type", "array"}, {"maxItems", 1}}}}};
  const Json donor_keys = {{"anyOf",
                            {{{"required", {"from"}}},
                             {{"required", {"joint"}}},
                             {{"required", {"place"}}},
                             {{"required", {"blend"}}}}}};
  const auto blend_is_not = [](const char* kind) {
    return Json{{"properties", {{"blend", {{"not", {{"const", kind}}}}}}}};
  };
  const auto surface_without = [](Json patterns) {
    return Json{{"properties", {{"surface", {{"properties", std::move(patterns)}}}}}};
  };
  const auto without = [](const char* side) {
    return Json{{"not", {{"type", "object"}, {"required", Json::array({side})}}}};
  };
  const Json no_at = without("at"), no_from = without("from");
  return {if_operation({"replace", "attach"}, {{"required", {"from", "joint"}}}),
          if_operation({"replace"}, blend_is_not("union")),
          if_operation({"attach"}, blend_is_not("blend")),
          if_operation({"attach", "detach"}, {{"properties", {{"at", one_joint}}}}),
          if_operation({"remove", "detach"}, {{"not", donor_keys}}),
          if_operation({"attach"}, surface_without({{"hardness", no_at}, {"include_parent", no_at}})),
          if_operation({"remove"}, surface_without({{"include_parent", no_from}})),
          if_operation({"remove", "detach"},
                       surface_without({{"hardness", false}, {"voxel", false}, {"voxel_factor", false}})),
          if_operation({"detach"}, surface_without({{"include_parent", false}}))};
}
}  // namespace

Json operation() {
  Json schema = closed_object(
      {
          {"op",
           described(
               "replace: the sub-tree at `at` goes, that of `from` at `joint` takes its place; attach: it "
               "is added under `at`; remove: the sub-tree at `at` goes; detach: only it stays.",
               {{"type", "string"}, {"enum", {"replace", "attach", "remove", "detach"}}}, {"replace"})},
          {"at", described("Joint of the character as it stands, or several for replace and remove.",
                           joints(), {"Neck1", {"Leg.L", "Leg.R"}})},
          {"from", described("Input that the part comes from.", text(), {"man"})},
          {"joint", described("Joint of that input: the top of the part.", text(), {"Spine"})},
          {"place", described("Where the part goes.", placement(),
                              {{{"align", "joint"}, {"rotate_deg", {0, -90, 0}}}})},
          {"blend",
           described(
               "How the surfaces become one: paper (SkinMixer Eq. 1), smin (the same fillet everywhere), "
               "gradient (a fillet where surfaces cross, none where they run side by side), auto (for a "
               "replacement paper where the parts are aligned and gradient where they meet at an angle; "
               "gradient for an attachment). blend and union say what the operation does anyway. Where "
               "operations make one junction, the first one's holds.",
               blend(), {"auto", {{"operator", "gradient"}, {"radius", 0.05}}})},
          {"surface", described("How this operation's junction is made, where it differs from the recipe's "
                                "`surface`.",
                                surface(false), {{{"hardness", 0.3}, {"elements", "triangles"}}})},
      },
      {"op", "at"});
  schema["allOf"] = rules_of_kinds();
  return schema;
}

}  // namespace skinforge::schema
