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

Json joints() {
  return {
      {"anyOf", {text(), {{"type", "array"}, {"items", text()}, {"minItems", 1}, {"uniqueItems", true}}}}};
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
          {"targets", described("Morph targets at most; context has one for each example.",
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
          {"rest", described("The rest pose is one more example, without change, of context.",
                             {{"type", "boolean"}, {"default", defaults.rest}}, {true})},
          {"kernel", described("How examples share between them, of context: phi(r) = r, or a Gaussian.",
                               {{"type", "string"}, {"enum", {"linear", "gaussian"}}, {"default", "linear"}},
                               {"linear"})},
          {"joints",
           described("Joints whose rotations say how near a pose is to an example, of context; left "
                     "out, all but roots.",
                     joints(), {{"UpperArm.L", "LowerArm.L"}})},
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
      {"bind", described("Gives a model its skin: bones and weights.", bind(),
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

// `with_defaults`: of the recipe; an operation takes the recipe's where it does not say otherwise.
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

Json if_operation(Json kinds, Json consequence) {
  return {{"if", {{"properties", {{"op", {{"enum", std::move(kinds)}}}}}}}, {"then", std::move(consequence)}};
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
  schema["allOf"] = {
      if_operation({"replace", "attach"}, {{"required", {"from", "joint"}}}),
      if_operation({"replace"}, blend_is_not("union")),
      if_operation({"attach"}, blend_is_not("blend")),
      if_operation({"attach", "detach"}, {{"properties", {{"at", one_joint}}}}),
      if_operation({"remove", "detach"}, {{"not", donor_keys}}),
      if_operation({"attach"}, surface_without({{"hardness", no_at}, {"include_parent", no_at}})),
      if_operation({"remove"}, surface_without({{"include_parent", no_from}})),
      if_operation({"remove", "detach"},
                   surface_without({{"hardness", false}, {"voxel", false}, {"voxel_factor", false}})),
      if_operation({"detach"}, surface_without({{"include_parent", false}}))};
  return schema;
}

// May be null, which is the default and means what `description` says for its absence.
Json optional(const std::string& description, Json schema, Json examples) {
  Json with_null = {{"anyOf", {schema, {{"type", "null"}}}}, {"default", nullptr}};
  if (schema.contains("unit")) with_null["unit"] = schema["unit"];
  return described(description, std::move(with_null), std::move(examples));
}

Json clip_names() {
  return {{"type", "array"}, {"items", text()}, {"uniqueItems", true}};
}

Json all_or_names() {
  return {{"anyOf", {{{"type", "string"}, {"enum", {"all"}}}, clip_names()}}};
}

Json method() {
  return described(
      "How keyframes of completed parts are chosen: the best whole sequence, or as in the paper (Sec. 8.1) "
      "the "
      "best keyframe for each frame on its own.",
      {{"type", "string"}, {"enum", {"sequence", "paper"}}}, {"paper"});
}

Json rate() {
  return optional("Keys of completed tracks; without it 30 a second, as clips are compared.",
                  number(1, 240, "1/second"), {60});
}

Json tempo() {
  return described("Slowest and fastest tempo at which clips are played for completed parts.",
                   {{"type", "array"},
                    {"items", {number(0.5, 1, "factor"), number(1, 2, "factor")}},
                    {"minItems", 2},
                    {"maxItems", 2},
                    {"unit", "factor"}},
                   {{0.8, 1.25}});
}

Json limb_phase() {
  return optional(
      "Share of a step by which limbs that the body has twice (a second pair of arms) follow the first; 0 "
      "moves "
      "both alike. Without it they share the step evenly.",
      number(0, 1, "step"), {0, 0.25});
}

Json complete() {
  return described("Give the other parts motion.", {{"type", "boolean"}}, {false});
}

Json clip_settings() {
  Json settings = closed_object({
      {"complete",
       optional("Give the other parts motion; without it as for all clips.", {{"type", "boolean"}}, {false})},
      {"method", method()},
      {"rate_hz", rate()},
      {"tempo", tempo()},
      {"limb_phase", limb_phase()},
      {"loop", optional("Whether the clip is played in a loop; without it that is found from its poses.",
                        {{"type", "boolean"}}, {true})},
      {"use", described("Clips of other inputs that poses may be taken from; without it all.", clip_names(),
                        {{"Run"}})},
      {"with", described("Clip of another input that its part plays as it is.", text(), {"Idle"})},
  });
  settings["not"] = {{"required", {"use", "with"}}};
  return settings;
}

Json animation() {
  const AnimationOptions defaults;
  return closed_object({
      {"clips", described("Which clips of the inputs to keep.", with_default(all_or_names(), "all"),
                          {"all", {"Walk", "Idle"}})},
      {"complete", with_default(complete(), defaults.complete)},
      {"method", with_default(method(), "sequence")},
      {"rate_hz", rate()},
      {"tempo", with_default(tempo(), defaults.tempo)},
      {"limb_phase", limb_phase()},
      {"key_tolerance",
       described("How far leaving out keys of completed tracks may move any point of the skin.",
                 with_default(number(0, 0.1, "diagonal"), defaults.key_tolerance), {0.001})},
      {"per_clip",
       described("Settings of single clips, by their names.",
                 {{"type", "object"}, {"additionalProperties", clip_settings()}, {"default", Json::object()}},
                 {{{"Gallop", {{"use", {"Run"}}}}}})},
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
// A budget: the most, or both ends.
Json budget(const char* unit) {
  const Json limit = {{"type", "number"}, {"minimum", 0}, {"unit", unit}};
  const Json range = closed_object(
      {{"min", described("At least.", limit, {1})}, {"max", described("At most.", limit, {6000})}});
  return {{"anyOf", {limit, range}}, {"unit", unit}};
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
  });
}

Json variables() {
  const Json plain = {{"type", {"string", "number", "boolean", "array"}}};
  const Json limit = {{"type", "number"}, {"unit", "that of the variable"}};
  const Json declared = closed_object(
      {{"type", described("What it may be; by default what `default` is.",
                          {{"type", "string"}, {"enum", {"string", "number", "integer", "boolean", "list"}}},
                          {"number"})},
       {"default", described("Its value unless --set gives another.",
                             {{"type", {"string", "number", "boolean", "array"}}}, {1.2})},
       {"choices", described("The values it may have.", {{"type", "array"}, {"minItems", 1}},
                             Json::array({Json::array({"L", "R"})}))},
       {"min", described("The least number.", limit, {0})},
       {"max", described("The largest number.", limit, {2})},
       {"description", described("What it is for.", {{"type", "string"}}, {"Size of the rider."})}},
      {"default"});
  return {{"type", "object"}, {"additionalProperties", {{"anyOf", {plain, declared}}}}};
}

Json matrix() {
  const Json cells = {{"type", "array"}, {"items", {{"type", "object"}}}};
  return {{"type", "object"},
          {"properties",
           {{"include", described("Further cells: a value for every axis, and variables of their own.", cells,
                                  {{{{"body", "fox"}, {"torso", "knight"}}}})},
            {"exclude", described("Combinations to leave out.", cells, {{{{"body", "wolf"}}}})}}},
          {"additionalProperties", {{"type", "array"}, {"minItems", 1}}}};
}

// What any value but a name of a file may be instead: a reference to a variable.
Json reference() {
  return {{"type", "string"}, {"pattern", R"(\$\{[^}]+\})"}};
}

bool takes_references(const Json& schema) {
  if (!schema.contains("type")) return schema.contains("enum");
  const Json& type = schema.at("type");
  if (type == "string") return schema.contains("pattern") || schema.contains("enum");
  return type == "number" || type == "integer" || type == "boolean" || type == "array";
}

Json include_path() {
  return described(
      "A value from another file, laid under the members beside it: file.json, or "
      "file.json#/pointer.",
      {{"type", "string"}, {"minLength", 1}}, {"limbs.json#/ops/0"});
}

Json included() {
  return {{"type", "object"}, {"required", {"include"}}, {"properties", {{"include", include_path()}}}};
}

// Lets each value of a recipe be a reference to a variable, and each object one from another file. What is
// said about the property (description, default, unit, examples) stays where it is.
void open_up(Json& schema) {
  if (!schema.is_object()) return;
  if (schema.contains("properties") && schema.contains("type"))
    for (auto& [key, property] : schema.at("properties").items()) open_up(property);
  for (const char* key : {"items", "additionalProperties"})
    if (schema.contains(key)) open_up(schema.at(key));
  for (const char* key : {"anyOf", "oneOf"})
    if (schema.contains(key))
      for (Json& alternative : schema.at(key)) open_up(alternative);
  const bool is_object = schema.contains("type") && schema.at("type") == "object";
  if (!is_object && !takes_references(schema)) return;
  Json rules = Json::object(), said = Json::object();
  for (const auto& [key, value] : schema.items()) {
    const bool is_said = key == "description" || key == "default" || key == "examples" || key == "unit";
    (is_said ? said : rules)[key] = value;
  }
  said["anyOf"] = Json::array({std::move(rules), is_object ? included() : reference()});
  schema = std::move(said);
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
          {"surface",
           described("How the junction's surface is made.", surface(true), {{{"voxel_factor", 0.8}}})},
          {"animation",
           described("Which clips, and how they are completed.", animation(), {{{"clips", "all"}}})},
          {"correctives", described("Morph targets that correct linear blending in every clip.",
                                    correctives(), {{{"method", "dqs"}, {"targets", 4}}})},
          {"output",
           described("Files to write, inside the output folder.", output(), {{{"glb", "centaur.glb"}}})},
          {"expect", described("Budgets that the result has to keep; exit 4 when it does not.", expect(),
                               {{{"triangles", 6000}, {"influences", 4}, {"watertight", true}}})},
          {"extends",
           described("Recipes that this one changes: what stands here is laid over them (merge patch, "
                     "null takes away), the later over the earlier.",
                     {{"anyOf", {path(), {{"type", "array"}, {"items", path()}, {"minItems", 1}}}}},
                     {"base.json", {"base.json", "fast.json"}})},
          {"vars",
           described("Variables, written as ${name} in any value; --set NAME=VALUE gives others.",
                     variables(), {{{"size", 1.2}, {"side", {{"default", "L"}, {"choices", {"L", "R"}}}}}})},
          {"matrix",
           described("One recipe for each combination of these values, written as ${matrix.axis}; the "
                     "name must tell them apart.",
                     matrix(), {{{"body", {"horse", "wolf"}}, {"torso", {"knight", "farmer"}}}})},
      },
      {});
  for (const char* key :
       {"name", "inputs", "base", "ops", "surface", "animation", "correctives", "output", "expect"})
    open_up(schema.at("properties").at(key));
  schema["anyOf"] = {{{"required", {"recipe_version", "name", "inputs", "base"}}},
                     {{"required", {"extends"}}}};
  Json head = {{"$schema", "http://json-schema.org/draft-07/schema#"},
               {"title", "SkinForge recipe"},
               {"description", "Parts of rigged, animated characters grafted into one."}};
  head.update(schema);
  return head.dump(2) + "\n";
}

}  // namespace skinforge
