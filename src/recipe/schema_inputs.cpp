#include <nlohmann/json.hpp>

#include "recipe/recipe.h"
#include "recipe/schema_parts.h"
#include "recipe/schema_values.h"

namespace skinforge::schema {

namespace {
Json pose() {
  const Json change = closed_object({
      {"rotate_deg", described("Turn about x, y and z of the joint's own frame: R = Ry Rx Rz.",
                               with_default(vector3("degrees"), PoseChange().rotate_deg), {{10, 0, 0}})},
      {"translate", described("Move along the axes of the model.",
                              with_default(vector3("metres"), PoseChange().translate), {{0, 0.1, 0}})},
  });
  return {{"type", "object"}, {"additionalProperties", change}, {"default", Json::object()}};
}

Json painted_handles() {
  const Json color = {{"type", "string"}, {"pattern", "^#[0-9a-fA-F]{6}$"}};
  return closed_object(
      {{"image", described("PNG or JPEG over the model's first UV set.", path(), {"labels.png"})},
       {"colors", described("The colour of each joint; others are free.",
                            {{"type", "object"}, {"additionalProperties", color}, {"minProperties", 1}},
                            {{{"Head", "#ff8000"}}})}},
      {"image", "colors"});
}

Json handles() {
  return described(
      "Vertices that a bone holds alone: rule (by distance), groups (face groups named after joints), skin "
      "(the "
      "weights of the model, or of the model that gives the skeleton), a .dmat of labels, a .json of vertex "
      "lists "
      "by joint, or a painted image.",
      {{"anyOf", {path(), painted_handles()}}, {"default", "rule"}}, {"handles.dmat", "skin"});
}

Json bind() {
  const RecipeBind defaults;
  return closed_object({
      {"skeleton", described("Bones: a .tgf file, or a model whose joints and clips are taken; left out, the "
                             "model's own.",
                             path(), {"skeleton.tgf", "human.glb"})},
      {"method",
       described("harmonic: over the surface from handles; heat: from the bones through the inside, "
                 "for surfaces of many or broken parts.",
                 {{"type", "string"}, {"enum", {"harmonic", "heat"}}, {"default", "harmonic"}}, {"heat"})},
      {"handles", handles()},
      {"handle_weight",
       described("A joint holds the vertices whose weight is above this, with handles \"skin\".",
                 with_default(number(0.5, 1, "1"), defaults.handle_weight), {0.6})},
      {"handle_factor", described("The rule takes vertices up to this times the closest distance.",
                                  with_default(number(1, 100, "factor"), defaults.handle_factor), {1.5})},
      {"handle_least", described("Vertices of each joint that the rule widens itself to take.",
                                 {{"type", "integer"},
                                  {"minimum", 0},
                                  {"maximum", 100000},
                                  {"default", defaults.handle_least},
                                  {"unit", "vertices"}},
                                 {12})},
      {"resolution", described("Cells along the longest side of the model, of heat.",
                               {{"type", "integer"},
                                {"minimum", 16},
                                {"maximum", 512},
                                {"default", defaults.resolution},
                                {"unit", "cells"}},
                               {96})},
      {"rate_hz",
       described("Frames of .dmat clips.", with_default(number(1, 240, "1/second"), defaults.rate_hz), {30})},
  });
}

Json input() {
  Json detailed = closed_object({
      {"file",
       described("A model: glTF, GLB, FBX, DAE, OBJ, ... relative to the recipe.", path(), {"man.fbx"})},
      {"recipe", described("Another recipe whose result is the input, relative to this one.", path(),
                           {"centaur.json"})},
      {"clips",
       described("Further files whose clips are added; .dmat files of rotations for a .tgf skeleton.",
                 with_default({{"type", "array"}, {"items", path()}}, Json::array()), {{"walk.fbx"}})},
      {"bind", described("Gives a model its skin: bones and weights.", bind(),
                         {{{"skeleton", "skeleton.tgf"}, {"method", "harmonic"}}})},
      {"pose", described("Pose of the input before it is mixed, by joint name.", pose(),
                         {{{"Head", {{"rotate_deg", {10, 0, 0}}}}}})},
  });
  detailed["oneOf"] = {{{"required", {"file"}}}, {{"required", {"recipe"}}}};
  return {{"anyOf", {path(), detailed}}};
}
}  // namespace

Json inputs() {
  return {{"type", "object"},
          {"minProperties", 1},
          {"propertyNames", {{"pattern", kFileName}}},
          {"additionalProperties", input()}};
}

}  // namespace skinforge::schema
