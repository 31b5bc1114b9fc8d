#include <nlohmann/json.hpp>

#include "recipe/recipe.h"
#include "recipe/schema_parts.h"
#include "recipe/schema_values.h"

namespace skinforge::schema {

namespace {
Json method() {
  return described(
      "How keyframes of completed parts are chosen: the best whole sequence, or as in the paper (Sec. 8.1) "
      "the "
      "best keyframe for each frame on its own.",
      {{"type", "string"}, {"enum", {"sequence", "paper"}}}, {"paper"});
}

Json rate() {
  return optional(
      "Keys of completed tracks; without it as many as the clip has, or 30 where its keys are unevenly "
      "spaced.",
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

constexpr const char* kLimbClearing =
    "How far a limb of a completed part may be turned, by one turn for the whole clip, so that it does not "
    "cut "
    "the part that drives the clip; 0 leaves it as its own clips have it.";

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
      {"limb_clearing_deg", optional(kLimbClearing, number(0, 90, "degree"), {0})},
      {"loop", optional("Whether the clip is played in a loop; without it that is found from its poses.",
                        {{"type", "boolean"}}, {true})},
      {"use", described("Clips of other inputs that poses may be taken from; without it all.", clip_names(),
                        {{"Run"}})},
      {"with", described("Clip of another input that its part plays as it is.", text(), {"Idle"})},
  });
  settings["not"] = {{"required", {"use", "with"}}};
  return settings;
}
}  // namespace

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
      {"limb_clearing_deg",
       described(kLimbClearing, with_default(number(0, 90, "degree"), defaults.limb_clearing_deg), {0, 60})},
      {"key_tolerance",
       described("How far leaving out keys of completed tracks may move any point of the skin.",
                 with_default(number(0, 0.1, "diagonal"), defaults.key_tolerance), {0.001})},
      {"per_clip",
       described("Settings of single clips, by their names.",
                 {{"type", "object"}, {"additionalProperties", clip_settings()}, {"default", Json::object()}},
                 {{{"Gallop", {{"use", {"Run"}}}}}})},
  });
}

}  // namespace skinforge::schema
