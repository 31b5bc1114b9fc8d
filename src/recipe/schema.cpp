#include "recipe/schema.h"

#include <nlohmann/json.hpp>

#include "recipe/recipe.h"

namespace skinforge {

namespace {
using Json = nlohmann::ordered_json;

constexpr const char* kFileName = "^(?=.{1,120}$)[A-Za-z0-9_+]([A-Za-z0-9._+ -]*[A-Za-z0-9_+-])?$";
constexpr const char* kPath = R"(^(?![A-Za-z]+:\/\/)[^\/\\\x00-\x1f][^\\\x00-\x1f]*$)";

Json closed_object(Json properties, Json required = Json::array()) {
  Json schema = {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
  if (!required.empty()) schema["required"] = std::move(required);
  return schema;
}

Json described(const std::string& description, Json schema, Json examples) {
  schema["description"] = description;
  schema["examples"] = std::move(examples);
  return schema;
}

Json with_default(Json schema, Json value) {
  schema["default"] = std::move(value);
  return schema;
}

Json text() {
  return {{"type", "string"}, {"minLength", 1}};
}

Json number(double least, double most, const char* unit) {
  return {{"type", "number"}, {"minimum", least}, {"maximum", most}, {"unit", unit}};
}

Json vector3(const char* unit) {
  return {{"type", "array"},
          {"items", number(-1e9, 1e9, unit)},
          {"minItems", 3},
          {"maxItems", 3},
          {"unit", unit}};
}

Json output_name(const std::string& extension) {
  return {
      {"type", "string"},
      {"pattern", R"(^([A-Za-z0-9_+]([A-Za-z0-9._+ -]*[A-Za-z0-9_+-])?\/)*[A-Za-z0-9_+][A-Za-z0-9._+ -]*\.)" +
                      extension + "$"}};
}

Json path() {
  return {{"type", "string"}, {"pattern", kPath}};
}

Json pose() {
  const Json change = closed_object({
      {"rotate_deg", described("Turn about x, y and z of the joint's own frame: R = Ry Rx Rz.",
                               with_default(vector3("degrees"), PoseChange().rotate_deg), {{10, 0, 0}})},
      {"translate", described("Move along the axes of the model.",
                              with_default(vector3("metres"), PoseChange().translate), {{0, 0.1, 0}})},
  });
  return {{"type", "object"}, {"additionalProperties", change}, {"default", Json::object()}};
}

Json bind() {
  const RecipeBind defaults;
  return closed_object(
      {
          {"skeleton", described("Bones: a .tgf file, or a model whose joints and clips are taken.", path(),
                                 {"skeleton.tgf", "human.glb"})},
          {"method",
           described("harmonic: over the surface from handles; heat: from the bones through the inside, "
                     "for surfaces of many or broken parts.",
                     {{"type", "string"}, {"enum", {"harmonic", "heat"}}, {"default", "harmonic"}},
                     {"heat"})},
          {"handles",
           described("Vertices that a bone holds alone: rule (by distance), groups (face groups named "
                     "after joints), a .dmat of labels, or a .json of vertex lists by joint.",
                     with_default(path(), "rule"), {"handles.dmat", "groups"})},
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
          {"rate_hz", described("Frames of .dmat clips.",
                                with_default(number(1, 240, "1/second"), defaults.rate_hz), {30})},
      },
      {"skeleton"});
}

Json correctives() {
  const CorrectivesOptions defaults;
  const Json example = closed_object(
      {{"shape", described("The model's vertices in a pose: .obj or .off.", path(), {"eg0.obj"})},
       {"pose", described("That pose: rotations of all bones.", path(), {"eg0.dmat"})}},
      {"shape", "pose"});
  return closed_object(
      {
          {"method",
           described("dqs: dual quaternions; poisson: averaged rotations, stitched; context: from examples.",
                     {{"type", "string"}, {"enum", {"dqs", "poisson", "context"}}}, {"dqs"})},
          {"targets", described("Morph targets at most.",
                                {{"type", "integer"},
                                 {"minimum", 1},
                                 {"maximum", 64},
                                 {"default", defaults.targets},
                                 {"unit", "targets"}},
                                {8})},
          {"enough",
           described("No more targets once the largest error is below this share of the bounding box's "
                     "diagonal.",
                     with_default(number(0, 1, "1"), defaults.enough), {0.0001})},
          {"examples",
           described("Shapes in poses, of context.", {{"type", "array"}, {"items", example}, {"minItems", 1}},
                     {{{{"shape", "eg0.obj"}, {"pose", "eg0.dmat"}}}})},
      },
      {"method"});
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
      {"bind", described("Gives a model without a skin its bones and weights.", bind(),
                         {{{"skeleton", "skeleton.tgf"}, {"method", "harmonic"}}})},
      {"pose", described("Pose of the input before it is mixed, by joint name.", pose(),
                         {{{"Head", {{"rotate_deg", {10, 0, 0}}}}}})},
  });
  detailed["oneOf"] = {{{"required", {"file"}}}, {{"required", {"recipe"}}}};
  return {{"anyOf", {path(), detailed}}};
}

Json inputs() {
  return {{"type", "object"},
          {"minProperties", 1},
          {"propertyNames", {{"pattern", kFileName}}},
          {"additionalProperties", input()}};
}

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
  });
}

Json joints() {
  return {
      {"anyOf", {text(), {{"type", "array"}, {"items", text()}, {"minItems", 1}, {"uniqueItems", true}}}}};
}

Json if_operation(Json kinds, Json consequence) {
  return {{"if", {{"properties", {{"op", {{"enum", std::move(kinds)}}}}}}}, {"then", std::move(consequence)}};
}

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
          {"blend", described("How the surfaces meet (SkinMixer Eq. 1): blend for replace, union for attach; "
                              "auto is the one that fits.",
                              {{"type", "string"}, {"enum", {"auto", "blend", "union"}}, {"default", "auto"}},
                              {"auto"})},
      },
      {"op", "at"});
  const Json one_joint = {{"anyOf", {text(), {{"type", "array"}, {"maxItems", 1}}}}};
  const Json donor_keys = {{"anyOf",
                            {{{"required", {"from"}}},
                             {{"required", {"joint"}}},
                             {{"required", {"place"}}},
                             {{"required", {"blend"}}}}}};
  const auto blend_is = [](const char* kind) {
    return Json{{"properties", {{"blend", {{"enum", {"auto", kind}}}}}}};
  };
  schema["allOf"] = {if_operation({"replace", "attach"}, {{"required", {"from", "joint"}}}),
                     if_operation({"replace"}, blend_is("blend")),
                     if_operation({"attach"}, blend_is("union")),
                     if_operation({"attach", "detach"}, {{"properties", {{"at", one_joint}}}}),
                     if_operation({"remove", "detach"}, {{"not", donor_keys}})};
  return schema;
}

Json surface() {
  const SurfaceOptions defaults;
  const Json rule = closed_object({
      {"variance", described("A component whose presence varies less is decided as a whole.",
                             with_default(number(0, 0.25, "1"), defaults.keep_or_drop.variance), {0.04})},
      {"mean", described("Such a component is kept when its mean presence reaches this.",
                         with_default(number(0, 1, "1"), defaults.keep_or_drop.mean), {0.5})},
  });
  return closed_object({
      {"voxel_factor", described("Voxel edge over the shorter mean edge length of the two meshes. The paper "
                                 "(Sec. 6.1) takes 0.8, at which thin limbs lost their junction.",
                                 with_default(number(0.1, 4, "factor"), defaults.voxel_factor), {0.8})},
      {"presence_smoothing",
       described("Laplacian passes over the presence. The paper (Sec. 6) makes one, the "
                 "program of its authors ten.",
                 {{"type", "integer"},
                  {"minimum", 0},
                  {"maximum", 99},
                  {"default", defaults.presence_smoothing},
                  {"unit", "passes"}},
                 {10})},
      {"keep_or_drop", described("Rule for components that are neither clearly kept nor clearly gone.", rule,
                                 {{{"variance", 0.04}, {"mean", 0.5}}})},
  });
}

Json animation() {
  const AnimationOptions defaults;
  const Json names = {{"type", "array"}, {"items", text()}, {"uniqueItems", true}};
  return closed_object({
      {"clips", described("Which clips of the inputs to keep.",
                          {{"anyOf", {{{"type", "string"}, {"enum", {"all"}}}, names}}, {"default", "all"}},
                          {"all", {"Walk", "Idle"}})},
      {"complete", described("Give the other parts motion in each clip.",
                             {{"type", "boolean"}, {"default", defaults.complete}}, {false})},
      {"rate_hz", described("Keys of completed tracks.",
                            with_default(number(1, 240, "1/second"), defaults.rate_hz), {60})},
  });
}

Json output() {
  return closed_object({
      {"glb", described("The character; without it the recipe's name and .glb.", output_name("glb"),
                        {"centaur.glb"})},
      {"obj",
       described("Its polygons as OBJ; without it none is written.", output_name("obj"), {"centaur.obj"})},
      {"vdb", described("The blended distance field; without it none is written.", output_name("vdb"),
                        {"centaur.vdb"})},
      {"influences", described("Joints a vertex follows at most.",
                               {{"type", "integer"},
                                {"enum", {4, 8}},
                                {"default", OutputOptions().influences},
                                {"unit", "joints"}},
                               {8})},
  });
}
}  // namespace

std::string recipe_schema() {
  Json schema = closed_object(
      {
          {"$schema", described("This schema, for editors.", text(), {"../schemas/recipe.schema.json"})},
          {"recipe_version", described("Version of the recipe's form.", {{"enum", {1}}}, {1})},
          {"name", described("Name of the character and of its files.",
                             {{"type", "string"}, {"pattern", kFileName}}, {"centaur"})},
          {"inputs", described("Characters that go in, by a name of your choice: a path, or an object.",
                               inputs(), {{{"horse", "horse.glb"}, {"man", {{"file", "man.fbx"}}}}})},
          {"base", described("Input that the operations start from.", text(), {"horse"})},
          {"ops",
           described(
               "Operations, in order.",
               {{"type", "array"}, {"items", operation()}, {"maxItems", 10000}, {"default", Json::array()}},
               {{{{"op", "replace"}, {"at", "Neck1"}, {"from", "man"}, {"joint", "Spine"}}}})},
          {"surface", described("How the junction's surface is made.", surface(), {{{"voxel_factor", 0.8}}})},
          {"animation",
           described("Which clips, and how they are completed.", animation(), {{{"clips", "all"}}})},
          {"correctives", described("Morph targets that correct linear blending in every clip.",
                                    correctives(), {{{"method", "dqs"}, {"targets", 4}}})},
          {"output",
           described("Files to write, inside the output folder.", output(), {{{"glb", "centaur.glb"}}})},
      },
      {"recipe_version", "name", "inputs", "base"});
  Json head = {{"$schema", "http://json-schema.org/draft-07/schema#"},
               {"title", "SkinForge recipe"},
               {"description", "Parts of rigged, animated characters grafted into one."}};
  head.update(schema);
  return head.dump(2) + "\n";
}

}  // namespace skinforge
