#include <fmt/core.h>

#include <algorithm>

#include "base/safe_name.h"
#include "base/text.h"
#include "recipe/recipe_parts.h"
#include "recipe/recipe_values.h"

namespace skinforge {

namespace {
PoseChange read_pose(const ValueReader& reader) {
  const ObjectReader object = reader.object({"rotate_deg", "translate"});
  PoseChange change;
  if (const auto rotate = object.find("rotate_deg")) change.rotate_deg = vector3(*rotate);
  if (const auto translate = object.find("translate")) change.translate = vector3(*translate);
  return change;
}

void read_painted_handles(const ValueReader& reader, RecipeBind& bind) {
  const ObjectReader object = reader.object({"image", "colors"});
  bind.handles = RecipeHandles::Image;
  bind.handle_file = read_path(object.at("image"));
  for (const auto& [joint, value] : object.at("colors").members()) {
    const auto color = parse_color(value.text());
    if (!color) value.fail_expected("a colour such as \"#ff8000\"");
    bind.colors[joint] = *color;
  }
  if (bind.colors.empty())
    object.at("colors").fail("expected at least one joint, such as \"Head\": \"#ff8000\"");
}

void read_handles(const ValueReader& reader, RecipeBind& bind) {
  if (bind.method == RecipeBindMethod::Heat) reader.fail("method \"heat\" takes no handles");
  if (reader.is_object()) return read_painted_handles(reader, bind);
  const std::map<std::string, RecipeHandles> kinds{
      {"rule", RecipeHandles::Rule}, {"groups", RecipeHandles::Groups}, {"skin", RecipeHandles::Skin}};
  if (const auto kind = kinds.find(reader.text()); kind != kinds.end()) {
    bind.handles = kind->second;
    return;
  }
  bind.handles = RecipeHandles::Labels;
  bind.handle_file = read_path(reader);
  const std::string extension = extension_of(bind.handle_file.resolved);
  if (extension != ".dmat" && extension != ".json")
    reader.fail_expected(
        "\"rule\", \"groups\", \"skin\", a .dmat or .json file, or an object with \"image\"");
}

RecipeBind read_bind(const ValueReader& reader) {
  const ObjectReader object = reader.object({"skeleton", "method", "handles", "handle_weight",
                                             "handle_factor", "handle_least", "resolution", "rate_hz"});
  RecipeBind bind;
  if (const auto skeleton = object.find("skeleton")) bind.skeleton = read_path(*skeleton);
  if (const auto method = object.find("method"))
    bind.method = method->choice<RecipeBindMethod>(
        {{"harmonic", RecipeBindMethod::Harmonic}, {"heat", RecipeBindMethod::Heat}});
  if (const auto handles = object.find("handles")) read_handles(*handles, bind);
  if (const auto weight = object.find("handle_weight")) bind.handle_weight = weight->number(0.5, 1);
  if (const auto factor = object.find("handle_factor")) bind.handle_factor = factor->number(1, 100);
  if (const auto least = object.find("handle_least")) bind.handle_least = least->integer(0, 100000);
  if (const auto resolution = object.find("resolution")) bind.resolution = resolution->integer(16, 512);
  if (const auto rate = object.find("rate_hz")) bind.rate_hz = rate->number(1, 240);
  return bind;
}

RecipeInput read_input(const std::string& name, const ValueReader& reader, const ReadIncluded& included) {
  RecipeInput input;
  input.name = name;
  if (reader.is_string()) {
    input.file = read_path(reader);
    return input;
  }
  if (!reader.is_object()) reader.fail_expected("a path, or an object with \"file\" or \"recipe\"");
  const ObjectReader object = reader.object({"file", "recipe", "clips", "bind", "pose"});
  const auto file = object.find("file"), recipe = object.find("recipe");
  if (!file == !recipe) reader.fail("expected one of \"file\" and \"recipe\", not none and not both");
  input.file = read_path(file ? *file : *recipe);
  if (recipe) input.recipe = std::make_shared<const Recipe>(included(*recipe, input.file.resolved));
  if (const auto clips = object.find("clips"))
    for (const ValueReader& clip : clips->items()) input.clips.push_back(read_path(clip));
  if (const auto bind = object.find("bind")) {
    if (recipe) bind->fail("the result of a recipe has its skin; bind a \"file\"");
    input.bind = read_bind(*bind);
  }
  if (const auto pose = object.find("pose"))
    for (const auto& [joint, change] : pose->members()) input.pose[joint] = read_pose(change);
  return input;
}
}  // namespace

std::vector<RecipeInput> read_inputs(const ValueReader& reader, const ReadIncluded& included) {
  std::vector<RecipeInput> inputs;
  for (const auto& [name, value] : reader.members()) {
    if (!is_safe_file_name(name))
      value.fail(fmt::format("input \"{}\" cannot be a file name; take letters, digits and . _ - +",
                             printable(name)));
    inputs.push_back(read_input(name, value, included));
  }
  if (inputs.empty()) reader.fail("expected at least one input, such as \"horse\": \"horse.glb\"");
  std::sort(inputs.begin(), inputs.end(),
            [](const RecipeInput& a, const RecipeInput& b) { return a.name < b.name; });
  return inputs;
}

}  // namespace skinforge
