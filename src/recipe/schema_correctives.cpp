#include <nlohmann/json.hpp>

#include "recipe/recipe.h"
#include "recipe/schema_parts.h"
#include "recipe/schema_values.h"

namespace skinforge::schema {

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

}  // namespace skinforge::schema
