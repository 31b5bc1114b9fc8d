#include <nlohmann/json.hpp>

#include "recipe/recipe.h"
#include "recipe/recipe_values.h"
#include "recipe/schema_parts.h"
#include "recipe/schema_values.h"

namespace skinforge::schema {

namespace {
Json output_name(const std::string& extension) {
  return {
      {"type", "string"},
      {"pattern", R"(^([A-Za-z0-9_+]([A-Za-z0-9._+ -]*[A-Za-z0-9_+-])?\/)*[A-Za-z0-9_+][A-Za-z0-9._+ -]*\.)" +
                      extension + "$"}};
}

// A budget: the most, or both ends.
Json budget(const char* unit) {
  const Json limit = {{"type", "number"}, {"minimum", 0}, {"unit", unit}};
  const Json range = closed_object(
      {{"min", described("At least.", limit, {1})}, {"max", described("At most.", limit, {6000})}});
  return {{"anyOf", {limit, range}}, {"unit", unit}};
}

// A share of something: a number, or a percentage.
Json share(double preset, const char* unit = "of the diagonal") {
  const Json percent = {{"type", "string"}, {"pattern", R"(^[0-9]+(\.[0-9]+)?%$)"}};
  return with_default({{"anyOf", {{{"type", "number"}, {"minimum", 0}}, percent}}, {"unit", unit}}, preset);
}

Json golden() {
  const std::string any_path = kPath;
  const Json file = {{"type", "string"},
                     {"pattern", any_path.substr(0, any_path.size() - 1) + R"(\.[gG][lL][bB]$)"}};
  const GoldenOptions preset;
  const Json object = closed_object(
      {
          {"file", described("The golden, a GLB, relative to the recipe.", file, {"golden/centaur.glb"})},
          {"geometry", described("Largest distance between the surfaces that is still the same.",
                                 share(preset.geometry), {"0.001%", 1e-5})},
          {"normals", described("Largest angle between normals of corresponding corners.",
                                with_default(number(0, 180, "degrees"), preset.normals), {2})},
          {"uv", described("Largest distance of texture coordinates of corresponding corners.",
                           share(preset.uv, "of the texture"), {"0.1%", 0.002})},
          {"weights", described("Largest change of a vertex's weights, summed over its joints.",
                                with_default(number(0, 2, "ratio"), preset.weights), {0.02})},
          {"animation", described("Largest distance by which a clip may move a vertex otherwise.",
                                  share(preset.animation), {"0.05%", 5e-4})},
          {"duration", described("Largest change of a clip's length.",
                                 with_default(number(0, kMaxLength, "s"), preset.duration), {0.02})},
          {"picture",
           described("Largest share of the pixels of the character that are drawn otherwise, over all "
                     "pictures.",
                     share(preset.picture, "of the character"), {"0.5%", 0.01})},
          {"structure",
           described("Edits of names and counts that are still the same: none or any.",
                     with_default({{"type", "string"}, {"enum", {"none", "any"}}}, "none"), {"any"})},
      },
      {"file"});
  return {{"anyOf", {file, object}}};
}
}  // namespace

Json output() {
  return closed_object({
      {"glb", described("The character; without it the recipe's name and .glb.", output_name("glb"),
                        {"centaur.glb"})},
      {"obj",
       described("Its polygons as OBJ; without it none is written.", output_name("obj"), {"centaur.obj"})},
      {"vdb", described("The blended distance field; without it none is written.", output_name("vdb"),
                        {"centaur.vdb"})},
      {"animated", described("Clips to draw as animated pictures (APNG) beside the report.",
                             with_default(all_or_names(), Json::array()), {"all", {"Gallop"}})},
      {"influences", described("Joints a vertex follows at most.",
                               {{"type", "integer"},
                                {"enum", {4, 8}},
                                {"default", OutputOptions().influences},
                                {"unit", "joints"}},
                               {8})},
  });
}

Json expect() {
  const auto of = [](const char* what, const char* unit, Json example) {
    return described(std::string(what) + ": the most, or an object with min and max.", budget(unit),
                     Json::array({std::move(example), {{"min", 1}}}));
  };
  return closed_object({
      {"triangles", of("Triangles of the result", "triangles", 6000)},
      {"vertices", of("Vertices, welded", "vertices", 8000)},
      {"joints", of("Joints", "joints", 80)},
      {"influences", of("Joints that a vertex follows", "joints", 4)},
      {"materials", of("Materials", "materials", 8)},
      {"images", of("Images", "images", 4)},
      {"morph_targets", of("Morph targets", "targets", 16)},
      {"clips", of("Clips", "clips", 40)},
      {"bytes", of("Size of the GLB", "bytes", 4000000)},
      {"watertight",
       described("Whether the surface is closed (true) or open (false).", {{"type", "boolean"}}, {true})},
      {"clip_names", described("Clips that must be there.", {{"type", "array"}, {"items", text()}},
                               Json::array({Json::array({"Walk", "Idle"})}))},
      {"golden", described("A character that the result must still be like: its file, or an object with the "
                           "file and what is still the same. build --accept writes it.",
                           golden(), {"golden/centaur.glb"})},
  });
}

}  // namespace skinforge::schema
