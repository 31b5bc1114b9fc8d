#include <nlohmann/json.hpp>

#include "recipe/recipe.h"
#include "recipe/schema_parts.h"
#include "recipe/schema_values.h"

namespace skinforge::schema {

Json surface(bool with_defaults) {
  const SurfaceOptions defaults;
  const auto preset = [&](Json schema, Json value) {
    return with_defaults ? with_default(std::move(schema), std::move(value)) : schema;
  };
  const auto sides = [&](const Json& side, const auto& value, const Json& example) {
    const Json both = closed_object(
        {{"at", described("Of the character as it stands.", side, Json::array({example}))},
         {"from", described("Of the input that the part comes from.", side, Json::array({example}))}});
    return preset({{"anyOf", {side, both}}}, {{"at", value.at}, {"from", value.from}});
  };
  const auto rounds = [&](const char* unit, int value) {
    return preset({{"type", "integer"}, {"minimum", 0}, {"maximum", 99}, {"unit", unit}}, value);
  };
  const Json rule = closed_object({
      {"variance", described("A component whose presence varies less is decided as a whole.",
                             preset(number(0, 0.25, "1"), defaults.keep_or_drop.variance), {0.04})},
      {"mean", described("Such a component is kept when its mean presence reaches this.",
                         preset(number(0, 1, "1"), defaults.keep_or_drop.mean), {0.5})},
  });
  Json schema = closed_object({
      {"voxel_factor", described("Voxel edge over the shorter mean edge length of the two meshes. The paper "
                                 "(Sec. 6.1) takes 0.8, at which thin limbs lost their junction.",
                                 preset(number(0.1, 4, "factor"), defaults.voxel_factor), {0.8})},
      {"voxel", described("Voxel edge itself, instead of the factor.", number(1e-6, 1e6, "metres"), {0.02})},
      {"presence_smoothing",
       described("Laplacian passes over the presence. The paper (Sec. 6) makes one, the "
                 "program of its authors ten.",
                 rounds("passes", defaults.presence_smoothing), {10})},
      {"hardness",
       described("How long each side holds its own shape where they blend: above 0 longer, below 0 shorter. "
                 "One number for both sides, or one for each: `at` is the character, `from` the input.",
                 sides(number(-0.9, 0.9, "1"), defaults.hardness, 0.3),
                 {0.3, {{"at", 0.5}, {"from", -0.2}}})},
      {"include_parent",
       described("Let the blend take in what hangs on the parent of the joint, too: of the character it "
                 "goes, of the input it comes along. For both sides, or for each.",
                 sides({{"type", "boolean"}}, defaults.include_parent, true), {true, {{"at", true}}})},
      {"keep_or_drop", described("Rule for components that are neither clearly kept nor clearly gone.", rule,
                                 {{{"variance", 0.04}, {"mean", 0.5}}})},
      {"elements",
       described("Faces of the junction. auto: quads wherever they are good; quads: triangles that are left "
                 "are paired however poor the quad; triangles: triangles only.",
                 preset({{"type", "string"}, {"enum", {"auto", "quads", "triangles"}}}, "auto"), {"auto"})},
      {"smoothing", described("Further Laplacian rounds over the new faces; their borders stay. Fewer are "
                              "made where the faces would fold or cut something.",
                              rounds("rounds", defaults.smoothing), {5})},
  });
  schema["not"] = {{"required", {"voxel", "voxel_factor"}}};
  return schema;
}

}  // namespace skinforge::schema
