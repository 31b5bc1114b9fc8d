#include <fmt/core.h>

#include "base/safe_name.h"
#include "base/share_text.h"
#include "base/text.h"
#include "recipe/recipe_parts.h"
#include "recipe/recipe_values.h"

namespace skinforge {

namespace {
std::string output_name(const ValueReader& reader, const std::string& extension) {
  const std::string name = reader.text();
  if (!is_safe_relative_path(name))
    reader.fail(fmt::format("output \"{}\" must be a plain path inside the output folder", printable(name)));
  if (extension_of(name) != extension)
    reader.fail(fmt::format("output \"{}\" must end in {}", name, extension));
  return name;
}

// A number is the most that there may be.
ExpectedRange read_range(const ValueReader& reader) {
  if (!reader.is_object() && reader.value().kind != Value::Kind::Number)
    reader.fail_expected("a number (the most), or an object with \"min\" and \"max\"");
  if (!reader.is_object()) return {std::nullopt, reader.number(0, kMaxLength * 1e3)};
  const ObjectReader object = reader.object({"min", "max"});
  ExpectedRange range;
  if (const auto least = object.find("min")) range.min = least->number(0, kMaxLength * 1e3);
  if (const auto most = object.find("max")) range.max = most->number(0, kMaxLength * 1e3);
  if (!range.min && !range.max) reader.fail("expected \"min\", \"max\" or both");
  if (range.min && range.max && *range.min > *range.max)
    reader.fail("\"min\" is above \"max\"; exchange them");
  return range;
}

// A share of the diagonal, the texture or the picture: a number, or "0.05%".
double read_share(const ValueReader& reader) {
  if (!reader.is_string()) return reader.number(0, kMaxShare);
  if (const auto share = parse_share(reader.value().text)) return *share;
  reader.fail_expected("a number, or a percentage such as \"0.05%\"");
}

RecipePath golden_file(const ValueReader& reader) {
  RecipePath file = read_path(reader);
  if (extension_of(file.resolved) != ".glb") reader.fail("a golden is a GLB; the name must end in .glb");
  return file;
}

GoldenOptions read_golden(const ValueReader& reader) {
  GoldenOptions golden;
  if (!reader.is_object()) {
    golden.file = golden_file(reader);
    return golden;
  }
  const ObjectReader object = reader.object(
      {"file", "geometry", "normals", "uv", "weights", "animation", "duration", "picture", "structure"});
  golden.file = golden_file(object.at("file"));
  if (const auto geometry = object.find("geometry")) golden.geometry = read_share(*geometry);
  if (const auto normals = object.find("normals")) golden.normals = normals->number(0, 180);
  if (const auto uv = object.find("uv")) golden.uv = read_share(*uv);
  if (const auto weights = object.find("weights")) golden.weights = weights->number(0, 2);
  if (const auto animation = object.find("animation")) golden.animation = read_share(*animation);
  if (const auto duration = object.find("duration")) golden.duration = duration->number(0, kMaxLength);
  if (const auto picture = object.find("picture")) golden.picture = read_share(*picture);
  if (const auto structure = object.find("structure"))
    golden.structure = structure->choice<bool>({{"none", true}, {"any", false}});
  return golden;
}
}  // namespace

OutputOptions read_output(const ValueReader& reader) {
  const ObjectReader object = reader.object({"glb", "obj", "vdb", "animated", "influences"});
  OutputOptions output;
  if (const auto glb = object.find("glb")) output.glb = output_name(*glb, ".glb");
  if (const auto obj = object.find("obj")) output.obj = output_name(*obj, ".obj");
  if (const auto vdb = object.find("vdb")) output.vdb = output_name(*vdb, ".vdb");
  if (const auto animated = object.find("animated"))
    output.all_animated = read_clips(*animated, output.animated);
  if (const auto influences = object.find("influences")) {
    output.influences = influences->integer(4, 8);
    if (output.influences != 4 && output.influences != 8) influences->fail_expected("4 or 8");
  }
  return output;
}

void read_expectations(const ValueReader& reader, Recipe& recipe) {
  const ObjectReader object =
      reader.object({"triangles", "vertices", "joints", "influences", "materials", "images", "morph_targets",
                     "clips", "bytes", "watertight", "clip_names", "golden"});
  Expectations& expect = recipe.expect;
  for (const auto& [key, value] : reader.members())
    if (key != "watertight" && key != "clip_names" && key != "golden") expect.ranges[key] = read_range(value);
  if (const auto watertight = object.find("watertight")) expect.watertight = watertight->boolean();
  if (const auto names = object.find("clip_names"))
    for (const ValueReader& name : names->items()) expect.clips.push_back(name.text());
  if (const auto golden = object.find("golden")) recipe.golden = read_golden(*golden);
}

}  // namespace skinforge
