#include "recipe/recipe_parts.h"
#include "recipe/recipe_values.h"

namespace skinforge {

namespace {
CompletionMethod read_method(const ValueReader& reader) {
  return reader.choice<CompletionMethod>(
      {{"sequence", CompletionMethod::Sequence}, {"paper", CompletionMethod::Paper}});
}

std::array<double, 2> read_tempo(const ValueReader& reader) {
  const auto items = reader.items();
  if (items.size() != 2) reader.fail_expected("the slowest and the fastest tempo, as [0.8, 1.25]");
  return {items[0].number(0.5, 1), items[1].number(1, 2)};
}

ClipSettings read_clip_settings(const ValueReader& reader) {
  const ObjectReader object = reader.object(
      {"complete", "method", "rate_hz", "tempo", "limb_phase", "limb_clearing_deg", "loop", "use", "with"});
  ClipSettings settings;
  if (const auto complete = find_set(object, "complete")) settings.complete = complete->boolean();
  if (const auto method = object.find("method")) settings.method = read_method(*method);
  if (const auto rate = find_set(object, "rate_hz")) settings.rate_hz = rate->number(1, 240);
  if (const auto tempo = object.find("tempo")) settings.tempo = read_tempo(*tempo);
  if (const auto phase = find_set(object, "limb_phase")) settings.limb_phase = phase->number(0, 1);
  if (const auto turn = find_set(object, "limb_clearing_deg"))
    settings.limb_clearing_deg = turn->number(0, 90);
  if (const auto loop = find_set(object, "loop")) settings.loop = loop->boolean();
  if (const auto use = object.find("use")) settings.use = read_clip_names(*use);
  if (const auto with = object.find("with")) settings.with = with->text();
  if (!settings.use.empty() && !settings.with.empty())
    object.at("use").fail("\"with\" already says which clip is played; leave one of the two out");
  return settings;
}
}  // namespace

AnimationOptions read_animation(const ValueReader& reader) {
  const ObjectReader object = reader.object({"clips", "complete", "method", "rate_hz", "tempo", "limb_phase",
                                             "limb_clearing_deg", "key_tolerance", "per_clip"});
  AnimationOptions options;
  if (const auto clips = object.find("clips")) options.all_clips = read_clips(*clips, options.clips);
  if (const auto complete = object.find("complete")) options.complete = complete->boolean();
  if (const auto method = object.find("method")) options.method = read_method(*method);
  if (const auto rate = find_set(object, "rate_hz")) options.rate_hz = rate->number(1, 240);
  if (const auto tempo = object.find("tempo")) options.tempo = read_tempo(*tempo);
  if (const auto phase = find_set(object, "limb_phase")) options.limb_phase = phase->number(0, 1);
  if (const auto turn = object.find("limb_clearing_deg")) options.limb_clearing_deg = turn->number(0, 90);
  if (const auto tolerance = object.find("key_tolerance")) options.key_tolerance = tolerance->number(0, 0.1);
  if (const auto clips = object.find("per_clip"))
    for (const auto& [name, settings] : clips->members())
      options.per_clip[name] = read_clip_settings(settings);
  return options;
}

}  // namespace skinforge
