#include <fmt/core.h>

#include "recipe/recipe_parts.h"

namespace skinforge {

namespace {
constexpr double kLeastVoxel = 1e-6, kMostVoxel = 1e6;  // ours: metres; beside any character

void read_voxel(const ObjectReader& object, SurfaceOptions& options) {
  const auto factor = object.find("voxel_factor"), edge = object.find("voxel");
  if (factor && edge) edge->fail("expected one of \"voxel\" and \"voxel_factor\"; leave one out");
  if (factor) options.voxel_factor = factor->number(0.1, 4), options.voxel = 0;
  if (edge) options.voxel = edge->number(kLeastVoxel, kMostVoxel);
}

// One value for both sides, or { "at": ..., "from": ... }; a side that is not named keeps what it has.
template <class T, class Read>
void read_sides(const ValueReader& reader, Sides<T>& sides, const char* wanted, const Read& read) {
  if (reader.is_array() || reader.is_string())
    reader.fail_expected(fmt::format("{}, or an object with \"at\" and \"from\"", wanted));
  if (!reader.is_object()) {
    sides.at = sides.from = read(reader);
    return;
  }
  const ObjectReader object = reader.object({"at", "from"});
  if (const auto at = object.find("at")) sides.at = read(*at);
  if (const auto from = object.find("from")) sides.from = read(*from);
}
}  // namespace

void read_surface(const ValueReader& reader, SurfaceOptions& options) {
  const ObjectReader object = reader.object({"voxel_factor", "voxel", "presence_smoothing", "hardness",
                                             "include_parent", "keep_or_drop", "elements", "smoothing"});
  read_voxel(object, options);
  if (const auto passes = object.find("presence_smoothing"))
    options.presence_smoothing = passes->integer(0, 99);
  if (const auto hardness = object.find("hardness"))
    read_sides(*hardness, options.hardness, "a number from -0.9 to 0.9",
               [](const ValueReader& side) { return side.number(-0.9, 0.9); });
  if (const auto parent = object.find("include_parent"))
    read_sides(*parent, options.include_parent, "true or false",
               [](const ValueReader& side) { return side.boolean(); });
  if (const auto rule = object.find("keep_or_drop")) {
    const ObjectReader parts = rule->object({"variance", "mean"});
    if (const auto variance = parts.find("variance"))
      options.keep_or_drop.variance = variance->number(0, 0.25);
    if (const auto mean = parts.find("mean")) options.keep_or_drop.mean = mean->number(0, 1);
  }
  if (const auto elements = object.find("elements"))
    options.elements = elements->choice<Elements>(
        {{"auto", Elements::Auto}, {"quads", Elements::Quads}, {"triangles", Elements::Triangles}});
  if (const auto rounds = object.find("smoothing")) options.smoothing = rounds->integer(0, 99);
}

}  // namespace skinforge
