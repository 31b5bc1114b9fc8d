#include <fmt/core.h>

#include "base/text.h"
#include "recipe/recipe_parts.h"
#include "recipe/recipe_values.h"

namespace skinforge {

namespace {
constexpr std::size_t kMaxOperations = 10000;  // ours: refuses nonsense, not work

void expect_no_donor(const ObjectReader& object) {
  for (const char* key : {"from", "joint", "place", "blend"})
    if (const auto extra = object.find(key))
      extra->fail(fmt::format("\"{}\" has no meaning here: this operation takes nothing from an input", key));
}

void read_scale(const ValueReader& reader, Placement& place) {
  if (reader.is_string() && reader.value().text == "loop") {
    place.scale_by_loop = true;
    return;
  }
  if (reader.is_string()) reader.fail_expected("a number or \"loop\"");
  place.scale = reader.number();
  if (place.scale <= 0 || place.scale > kMaxLength)
    reader.fail_expected(fmt::format("a number above 0 and up to {}", kMaxLength));
}

Placement read_placement(const ValueReader& reader) {
  const ObjectReader object = reader.object({"align", "scale", "rotate_deg", "offset", "turn_limit_deg"});
  Placement place;
  if (const auto align = object.find("align"))
    place.align =
        align->choice<Align>({{"joint", Align::Joint}, {"loop", Align::Loop}, {"none", Align::None}});
  if (const auto scale = object.find("scale")) read_scale(*scale, place);
  if (const auto rotate = object.find("rotate_deg")) place.rotate_deg = vector3(*rotate);
  if (const auto offset = object.find("offset")) place.offset = vector3(*offset);
  if (const auto limit = object.find("turn_limit_deg")) place.turn_limit_deg = limit->number(0, 180);
  return place;
}

BlendKind blend_kind(const ValueReader& reader, OperationKind kind) {
  if (kind == OperationKind::Replace && reader.is_string() && reader.value().text == "union")
    reader.fail("a replacement blends; \"op\": \"attach\" unites");
  if (kind == OperationKind::Attach && reader.is_string() && reader.value().text == "blend")
    reader.fail("an attached part is united; \"op\": \"replace\" blends");
  return reader.choice<BlendKind>({{"auto", BlendKind::Auto},
                                   {"blend", BlendKind::Auto},
                                   {"union", BlendKind::Auto},
                                   {"paper", BlendKind::Paper},
                                   {"smin", BlendKind::Smin},
                                   {"gradient", BlendKind::Gradient}});
}

Blend read_blend(const ValueReader& reader, OperationKind kind) {
  if (!reader.is_object()) return {blend_kind(reader, kind), 0};
  const ObjectReader object = reader.object({"operator", "radius"});
  Blend blend;
  if (const auto name = object.find("operator")) blend.kind = blend_kind(*name, kind);
  if (const auto radius = object.find("radius")) {
    blend.radius = radius->number();
    if (!(blend.radius > 0) || blend.radius > kMaxLength)
      radius->fail_expected(fmt::format("a number above 0 and up to {}", kMaxLength));
    if (blend.kind == BlendKind::Paper)
      radius->fail("\"paper\" has no fillet; \"smin\" and \"gradient\" have");
  }
  return blend;
}

void read_donor(const ObjectReader& object, const Recipe& recipe, RecipeOperation& operation) {
  operation.from = input_name(object.at("from"), recipe.inputs);
  operation.joint = object.at("joint").text();
  if (const auto place = object.find("place")) operation.place = read_placement(*place);
  if (const auto blend = object.find("blend")) operation.blend = read_blend(*blend, operation.kind);
  const bool changes_nothing = operation.kind == OperationKind::Replace && operation.from == recipe.base &&
                               operation.at == std::vector{operation.joint} && operation.place == Placement();
  if (changes_nothing)
    object.reader().fail("this replaces joint \"" + printable(operation.joint) + "\" of the base by itself");
}

// Keys of an operation's "surface" that this kind of operation has no use for.
void expect_meaning(const ValueReader& reader, OperationKind kind) {
  const bool has_donor = kind == OperationKind::Replace || kind == OperationKind::Attach;
  const bool has_parent = kind != OperationKind::Detach;
  for (const auto& [key, value] : reader.members()) {
    const bool is_two_sided = key == "hardness" || key == "include_parent";
    const bool is_of_field = key == "hardness" || key == "voxel" || key == "voxel_factor";
    if ((is_of_field && !has_donor) || (key == "include_parent" && !has_parent))
      value.fail(fmt::format("\"{}\" has no meaning here: this operation blends nothing", key));
    if (!is_two_sided || !value.is_object()) continue;
    for (const auto& [side, of_side] : value.members()) {
      if (side == "from" && !has_donor)
        of_side.fail("\"from\" has no meaning here: this operation takes nothing from an input");
      if (side == "at" && kind == OperationKind::Attach)
        of_side.fail("\"at\" has no meaning here: an attachment does not cut the character");
    }
  }
}

RecipeOperation read_operation(const ValueReader& reader, const Recipe& recipe) {
  const ObjectReader object = reader.object({"op", "at", "from", "joint", "place", "blend", "surface"});
  RecipeOperation operation;
  operation.surface = recipe.surface;
  operation.kind = object.at("op").choice<OperationKind>({{"replace", OperationKind::Replace},
                                                          {"attach", OperationKind::Attach},
                                                          {"remove", OperationKind::Remove},
                                                          {"detach", OperationKind::Detach}});
  operation.at = read_joints(object.at("at"));
  const bool takes_many = operation.kind == OperationKind::Replace || operation.kind == OperationKind::Remove;
  if (!takes_many && operation.at.size() > 1) object.at("at").fail("this operation takes one joint");
  const bool has_donor = operation.kind == OperationKind::Replace || operation.kind == OperationKind::Attach;
  if (has_donor)
    read_donor(object, recipe, operation);
  else
    expect_no_donor(object);
  if (const auto surface = object.find("surface")) {
    expect_meaning(*surface, operation.kind);
    read_surface(*surface, operation.surface);
  }
  return operation;
}
}  // namespace

std::vector<RecipeOperation> read_operations(const ValueReader& reader, const Recipe& recipe) {
  const auto items = reader.items();
  if (items.size() > kMaxOperations)
    reader.fail(fmt::format("{} operations; at most {} are allowed", items.size(), kMaxOperations));
  std::vector<RecipeOperation> operations;
  for (const ValueReader& item : items) operations.push_back(read_operation(item, recipe));
  return operations;
}

}  // namespace skinforge
