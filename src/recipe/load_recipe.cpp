#include <fmt/core.h>

#include <algorithm>

#include "base/safe_name.h"
#include "base/text.h"
#include "recipe/recipe.h"
#include "recipe/resolve.h"
#include "recipe/value_reader.h"

namespace skinforge {
namespace fs = std::filesystem;

namespace {
constexpr int kRecipeVersion = 1;
constexpr std::size_t kMaxOperations = 10000;  // ours: refuses nonsense, not work
constexpr std::size_t kMaxIncludeDepth = 16;   // ours: recipes in recipes in recipes
const std::initializer_list<std::string_view> kKeys = {
    "$schema", "recipe_version", "name",        "inputs", "base",  "ops",
    "surface", "animation",      "correctives", "output", "expect"};
constexpr double kMaxLength = 1e9;  // ours: metres and factors; keeps sums and products finite
constexpr double kLeastVoxel = 1e-6, kMostVoxel = 1e6;  // ours: metres; beside any character

std::string extension_of(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return extension;
}

void collect_places(const Value& value, const std::string& pointer,
                    std::map<std::string, std::string>& places) {
  places[pointer] = value.where();
  for (const Value::Member& member : value.members)
    collect_places(member.value, pointer_to(pointer, member.key), places);
  for (std::size_t i = 0; i < value.items.size(); ++i)
    collect_places(value.items[i], pointer_to(pointer, std::to_string(i)), places);
}

bool is_list_of_values(const Value& value) {
  return value.kind == Value::Kind::Array &&
         std::none_of(value.items.begin(), value.items.end(), [](const Value& item) {
           return item.kind == Value::Kind::Array || item.kind == Value::Kind::Object;
         });
}

void collect_values(const Value& value, const std::string& pointer,
                    std::map<std::string, std::string>& values) {
  const bool is_nested = value.kind == Value::Kind::Object || value.kind == Value::Kind::Array;
  const bool is_empty = value.members.empty() && value.items.empty();
  if (!is_nested || is_empty || is_list_of_values(value)) values[pointer] = value_text(value);
  for (const Value::Member& member : value.members)
    collect_values(member.value, pointer_to(pointer, member.key), values);
  if (is_list_of_values(value)) return;
  for (std::size_t i = 0; i < value.items.size(); ++i)
    collect_values(value.items[i], pointer_to(pointer, std::to_string(i)), values);
}

// Reads one recipe file; `including` are the files that led here, outermost first.
class RecipeReader {
 public:
  RecipeReader(const fs::path& path, const std::vector<fs::path>& including)
      : path_(path), including_(including) {}

  Recipe read(const ResolvedRecipe& resolved) {
    const Value& root = resolved.root;
    recipe_.path = path_;
    recipe_.variant = resolved.variant;
    const std::string file = path_.string();
    const ValueReader reader(root, file, "");
    expect_version(reader);
    const ObjectReader object = reader.object(kKeys);
    if (const auto schema = object.find("$schema")) schema->text();
    recipe_.name = safe_name(object.at("name"));
    read_inputs(object.at("inputs"));
    recipe_.base = input_name(object.at("base"));
    if (const auto surface = object.find("surface")) read_surface(*surface, recipe_.surface);
    if (const auto ops = object.find("ops")) read_operations(*ops);
    if (const auto animation = object.find("animation")) recipe_.animation = read_animation(*animation);
    if (const auto correctives = object.find("correctives")) read_correctives(*correctives);
    recipe_.output.glb = recipe_.name + ".glb";
    if (const auto output = object.find("output")) read_output(*output);
    if (const auto expect = object.find("expect")) recipe_.expect = read_expectations(*expect);
    collect_places(root, "", recipe_.places);
    collect_values(root, "", recipe_.values);
    return std::move(recipe_);
  }

 private:
  static void expect_version(const ValueReader& reader) {
    for (const auto& [key, value] : reader.members()) {
      if (key != "recipe_version") continue;
      if (value.number() == kRecipeVersion) return;
      value.fail(
          fmt::format("expected recipe version {}, found {}", kRecipeVersion, value.value().describe()));
    }
    reader.object(kKeys);
    reader.fail(fmt::format("missing key \"recipe_version\" (this tool reads version {})", kRecipeVersion));
  }

  static std::string safe_name(const ValueReader& reader) {
    const std::string name = reader.text();
    if (!is_safe_file_name(name))
      reader.fail(
          fmt::format("\"{}\" cannot be a file name; take letters, digits and . _ - +", printable(name)));
    return name;
  }

  std::string input_name(const ValueReader& reader) const {
    const std::string name = reader.text();
    std::vector<std::string> names;
    for (const RecipeInput& input : recipe_.inputs) names.push_back(input.name);
    if (std::find(names.begin(), names.end(), name) == names.end())
      reader.fail(fmt::format("no input \"{}\"{}", printable(name), nearest_hint(name, names)));
    return name;
  }

  static std::array<double, 3> vector3(const ValueReader& reader) {
    const auto items = reader.items();
    if (items.size() != 3) reader.fail_expected("a list of three numbers");
    return {items[0].number(-kMaxLength, kMaxLength), items[1].number(-kMaxLength, kMaxLength),
            items[2].number(-kMaxLength, kMaxLength)};
  }

  RecipePath read_path(const ValueReader& reader) const {
    const std::string text = reader.text();
    const auto refuse = [&](const char* why) {
      reader.fail(fmt::format("path \"{}\" {}", printable(text), why));
    };
    if (std::any_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }))
      refuse("has control characters");
    if (text.find('\\') != std::string::npos) refuse("has a backslash; write / between folders");
    if (text.find("://") != std::string::npos) refuse("is an address; inputs are files");
    if (fs::path(text).is_absolute()) refuse("is absolute; write it relative to the recipe");
    const fs::path file = reader.value().file ? fs::path(reader.value().file_name()) : path_;
    return {text, (file.parent_path() / text).lexically_normal()};
  }

  void read_inputs(const ValueReader& reader) {
    for (const auto& [name, value] : reader.members()) {
      if (!is_safe_file_name(name))
        value.fail(fmt::format("input \"{}\" cannot be a file name; take letters, digits and . _ - +",
                               printable(name)));
      recipe_.inputs.push_back(read_input(name, value));
    }
    if (recipe_.inputs.empty()) reader.fail("expected at least one input");
    std::sort(recipe_.inputs.begin(), recipe_.inputs.end(),
              [](const RecipeInput& a, const RecipeInput& b) { return a.name < b.name; });
  }

  RecipeInput read_input(const std::string& name, const ValueReader& reader) const {
    RecipeInput input;
    input.name = name;
    if (reader.is_string()) {
      input.file = read_path(reader);
      return input;
    }
    if (!reader.is_object()) reader.fail_expected("a path, or an object with \"file\" or \"recipe\"");
    const ObjectReader object = reader.object({"file", "recipe", "clips", "bind", "pose"});
    const auto file = object.find("file"), recipe = object.find("recipe");
    if (!file == !recipe) reader.fail("expected one of \"file\" and \"recipe\"");
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

  RecipeBind read_bind(const ValueReader& reader) const {
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

  void read_handles(const ValueReader& reader, RecipeBind& bind) const {
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

  void read_painted_handles(const ValueReader& reader, RecipeBind& bind) const {
    const ObjectReader object = reader.object({"image", "colors"});
    bind.handles = RecipeHandles::Image;
    bind.handle_file = read_path(object.at("image"));
    for (const auto& [joint, value] : object.at("colors").members()) {
      const auto color = parse_color(value.text());
      if (!color) value.fail_expected("a colour such as \"#ff8000\"");
      bind.colors[joint] = *color;
    }
    if (bind.colors.empty()) object.at("colors").fail("expected at least one joint");
  }

  void read_correctives(const ValueReader& reader) {
    const ObjectReader object =
        reader.object({"method", "targets", "enough", "examples", "rest", "kernel", "joints"});
    CorrectivesOptions& options = recipe_.correctives;
    options.method = object.at("method").choice<RecipeDeform>({{"dqs", RecipeDeform::DualQuaternion},
                                                               {"poisson", RecipeDeform::Poisson},
                                                               {"context", RecipeDeform::Context}});
    if (const auto targets = object.find("targets")) options.targets = targets->integer(1, 64);
    if (const auto enough = object.find("enough")) options.enough = enough->number(0, 1);
    if (options.method == RecipeDeform::Context) return read_context(reader, object);
    for (const char* key : {"examples", "rest", "kernel", "joints"})
      if (const auto value = object.find(key)) value->fail(fmt::format("{} is for method \"context\"", key));
  }

  void read_context(const ValueReader& reader, const ObjectReader& object) {
    CorrectivesOptions& options = recipe_.correctives;
    for (const ValueReader& item : object.at("examples").items()) {
      const ObjectReader example = item.object({"shape", "pose"});
      options.examples.push_back({read_path(example.at("shape")), read_path(example.at("pose"))});
    }
    if (options.examples.empty()) object.at("examples").fail("expected at least one example");
    if (const auto rest = object.find("rest")) options.rest = rest->boolean();
    if (const auto kernel = object.find("kernel"))
      options.kernel = kernel->choice<RecipeKernel>(
          {{"linear", RecipeKernel::Linear}, {"gaussian", RecipeKernel::Gaussian}});
    if (const auto joints = object.find("joints")) options.joints = read_joints(*joints);
    const bool is_bound = recipe_.inputs[recipe_.input_index(recipe_.base)].bind.has_value();
    if (!is_bound || !recipe_.operations.empty())
      reader.fail(
          "examples follow the vertices of the base, which must have \"bind\", and no \"ops\" may change "
          "them");
  }

  static PoseChange read_pose(const ValueReader& reader) {
    const ObjectReader object = reader.object({"rotate_deg", "translate"});
    PoseChange change;
    if (const auto rotate = object.find("rotate_deg")) change.rotate_deg = vector3(*rotate);
    if (const auto translate = object.find("translate")) change.translate = vector3(*translate);
    return change;
  }

  Recipe included(const ValueReader& reader, const fs::path& path) const;

  void read_operations(const ValueReader& reader) {
    const auto items = reader.items();
    if (items.size() > kMaxOperations)
      reader.fail(fmt::format("{} operations; at most {} are allowed", items.size(), kMaxOperations));
    for (const ValueReader& item : items) recipe_.operations.push_back(read_operation(item));
  }

  RecipeOperation read_operation(const ValueReader& reader) const {
    const ObjectReader object = reader.object({"op", "at", "from", "joint", "place", "blend", "surface"});
    RecipeOperation operation;
    operation.surface = recipe_.surface;
    operation.kind = object.at("op").choice<OperationKind>({{"replace", OperationKind::Replace},
                                                            {"attach", OperationKind::Attach},
                                                            {"remove", OperationKind::Remove},
                                                            {"detach", OperationKind::Detach}});
    operation.at = read_joints(object.at("at"));
    const bool takes_many =
        operation.kind == OperationKind::Replace || operation.kind == OperationKind::Remove;
    if (!takes_many && operation.at.size() > 1) object.at("at").fail("this operation takes one joint");
    const bool has_donor =
        operation.kind == OperationKind::Replace || operation.kind == OperationKind::Attach;
    if (has_donor)
      read_donor(object, operation);
    else
      expect_no_donor(object);
    if (const auto surface = object.find("surface")) {
      expect_meaning(*surface, operation.kind);
      read_surface(*surface, operation.surface);
    }
    return operation;
  }

  static std::vector<std::string> read_joints(const ValueReader& reader) {
    if (reader.is_string()) return {reader.text()};
    if (!reader.is_array()) reader.fail_expected("a joint, or a list of joints");
    std::vector<std::string> joints;
    for (const ValueReader& item : reader.items()) {
      const std::string joint = item.text();
      if (std::find(joints.begin(), joints.end(), joint) != joints.end())
        item.fail("joint \"" + printable(joint) + "\" is listed twice");
      joints.push_back(joint);
    }
    if (joints.empty()) reader.fail("expected at least one joint");
    return joints;
  }

  static void expect_no_donor(const ObjectReader& object) {
    for (const char* key : {"from", "joint", "place", "blend"})
      if (const auto extra = object.find(key))
        extra->fail(
            fmt::format("\"{}\" has no meaning here: this operation takes nothing from an input", key));
  }

  void read_donor(const ObjectReader& object, RecipeOperation& operation) const {
    operation.from = input_name(object.at("from"));
    operation.joint = object.at("joint").text();
    if (const auto place = object.find("place")) operation.place = read_placement(*place);
    if (const auto blend = object.find("blend")) operation.blend = read_blend(*blend, operation.kind);
    const bool changes_nothing = operation.kind == OperationKind::Replace && operation.from == recipe_.base &&
                                 operation.at == std::vector{operation.joint} &&
                                 operation.place == Placement();
    if (changes_nothing)
      object.reader().fail("this replaces joint \"" + printable(operation.joint) +
                           "\" of the base by itself");
  }

  static Blend read_blend(const ValueReader& reader, OperationKind kind) {
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

  static BlendKind blend_kind(const ValueReader& reader, OperationKind kind) {
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

  static Placement read_placement(const ValueReader& reader) {
    const ObjectReader object = reader.object({"align", "scale", "rotate_deg", "offset"});
    Placement place;
    if (const auto align = object.find("align"))
      place.align =
          align->choice<Align>({{"joint", Align::Joint}, {"loop", Align::Loop}, {"none", Align::None}});
    if (const auto scale = object.find("scale")) read_scale(*scale, place);
    if (const auto rotate = object.find("rotate_deg")) place.rotate_deg = vector3(*rotate);
    if (const auto offset = object.find("offset")) place.offset = vector3(*offset);
    return place;
  }

  static void read_scale(const ValueReader& reader, Placement& place) {
    if (reader.is_string() && reader.value().text == "loop") {
      place.scale_by_loop = true;
      return;
    }
    if (reader.is_string()) reader.fail_expected("a number or \"loop\"");
    place.scale = reader.number();
    if (place.scale <= 0 || place.scale > kMaxLength)
      reader.fail_expected(fmt::format("a number above 0 and up to {}", kMaxLength));
  }

  // Keys of an operation's "surface" that this kind of operation has no use for.
  static void expect_meaning(const ValueReader& reader, OperationKind kind) {
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

  static void read_surface(const ValueReader& reader, SurfaceOptions& options) {
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

  static void read_voxel(const ObjectReader& object, SurfaceOptions& options) {
    const auto factor = object.find("voxel_factor"), edge = object.find("voxel");
    if (factor && edge) edge->fail("expected one of \"voxel\" and \"voxel_factor\"");
    if (factor) options.voxel_factor = factor->number(0.1, 4), options.voxel = 0;
    if (edge) options.voxel = edge->number(kLeastVoxel, kMostVoxel);
  }

  // One value for both sides, or { "at": ..., "from": ... }; a side that is not named keeps what it has.
  template <class T, class Read>
  static void read_sides(const ValueReader& reader, Sides<T>& sides, const char* wanted, const Read& read) {
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

  static AnimationOptions read_animation(const ValueReader& reader) {
    const ObjectReader object = reader.object(
        {"clips", "complete", "method", "rate_hz", "tempo", "limb_phase", "key_tolerance", "per_clip"});
    AnimationOptions options;
    if (const auto clips = object.find("clips")) options.all_clips = read_clips(*clips, options.clips);
    if (const auto complete = object.find("complete")) options.complete = complete->boolean();
    if (const auto method = object.find("method")) options.method = read_method(*method);
    if (const auto rate = find_set(object, "rate_hz")) options.rate_hz = rate->number(1, 240);
    if (const auto tempo = object.find("tempo")) options.tempo = read_tempo(*tempo);
    if (const auto phase = find_set(object, "limb_phase")) options.limb_phase = phase->number(0, 1);
    if (const auto tolerance = object.find("key_tolerance"))
      options.key_tolerance = tolerance->number(0, 0.1);
    if (const auto clips = object.find("per_clip"))
      for (const auto& [name, settings] : clips->members())
        options.per_clip[name] = read_clip_settings(settings);
    return options;
  }

  // null is as good as nothing.
  static std::optional<ValueReader> find_set(const ObjectReader& object, std::string_view key) {
    const auto found = object.find(key);
    return found && found->value().kind == Value::Kind::Null ? std::nullopt : found;
  }

  static ClipSettings read_clip_settings(const ValueReader& reader) {
    const ObjectReader object =
        reader.object({"complete", "method", "rate_hz", "tempo", "limb_phase", "loop", "use", "with"});
    ClipSettings settings;
    if (const auto complete = find_set(object, "complete")) settings.complete = complete->boolean();
    if (const auto method = object.find("method")) settings.method = read_method(*method);
    if (const auto rate = find_set(object, "rate_hz")) settings.rate_hz = rate->number(1, 240);
    if (const auto tempo = object.find("tempo")) settings.tempo = read_tempo(*tempo);
    if (const auto phase = find_set(object, "limb_phase")) settings.limb_phase = phase->number(0, 1);
    if (const auto loop = find_set(object, "loop")) settings.loop = loop->boolean();
    if (const auto use = object.find("use")) settings.use = read_clip_names(*use);
    if (const auto with = object.find("with")) settings.with = with->text();
    if (!settings.use.empty() && !settings.with.empty())
      object.at("use").fail("\"with\" already says which clip is played; leave one of the two out");
    return settings;
  }

  static CompletionMethod read_method(const ValueReader& reader) {
    return reader.choice<CompletionMethod>(
        {{"sequence", CompletionMethod::Sequence}, {"paper", CompletionMethod::Paper}});
  }

  static std::array<double, 2> read_tempo(const ValueReader& reader) {
    const auto items = reader.items();
    if (items.size() != 2) reader.fail_expected("the slowest and the fastest tempo, as [0.8, 1.25]");
    return {items[0].number(0.5, 1), items[1].number(1, 2)};
  }

  static std::vector<std::string> read_clip_names(const ValueReader& reader) {
    if (!reader.is_array()) reader.fail_expected("a list of clip names");
    std::vector<std::string> names;
    for (const ValueReader& item : reader.items()) {
      const std::string clip = item.text();
      if (std::find(names.begin(), names.end(), clip) != names.end())
        item.fail("clip \"" + printable(clip) + "\" is listed twice");
      names.push_back(clip);
    }
    return names;
  }

  // True for "all"; otherwise fills in the names.
  static bool read_clips(const ValueReader& reader, std::vector<std::string>& names) {
    if (reader.is_string() && reader.value().text == "all") return true;
    if (!reader.is_array()) reader.fail_expected("\"all\" or a list of clip names");
    names = read_clip_names(reader);
    return false;
  }

  void read_output(const ValueReader& reader) {
    const ObjectReader object = reader.object({"glb", "obj", "vdb", "animated", "influences"});
    OutputOptions& output = recipe_.output;
    if (const auto glb = object.find("glb")) output.glb = output_name(*glb, ".glb");
    if (const auto obj = object.find("obj")) output.obj = output_name(*obj, ".obj");
    if (const auto vdb = object.find("vdb")) output.vdb = output_name(*vdb, ".vdb");
    if (const auto animated = object.find("animated"))
      output.all_animated = read_clips(*animated, output.animated);
    if (const auto influences = object.find("influences")) {
      output.influences = influences->integer(4, 8);
      if (output.influences != 4 && output.influences != 8) influences->fail_expected("4 or 8");
    }
  }

  static Expectations read_expectations(const ValueReader& reader) {
    const ObjectReader object =
        reader.object({"triangles", "vertices", "joints", "influences", "materials", "images",
                       "morph_targets", "clips", "bytes", "watertight", "clip_names"});
    Expectations expect;
    for (const auto& [key, value] : reader.members())
      if (key != "watertight" && key != "clip_names") expect.ranges[key] = read_range(value);
    if (const auto watertight = object.find("watertight")) expect.watertight = watertight->boolean();
    if (const auto names = object.find("clip_names"))
      for (const ValueReader& name : names->items()) expect.clips.push_back(name.text());
    return expect;
  }

  // A number is the most that there may be.
  static ExpectedRange read_range(const ValueReader& reader) {
    if (!reader.is_object() && reader.value().kind != Value::Kind::Number)
      reader.fail_expected("a number (the most), or an object with \"min\" and \"max\"");
    if (!reader.is_object()) return {std::nullopt, reader.number(0, kMaxLength * 1e3)};
    const ObjectReader object = reader.object({"min", "max"});
    ExpectedRange range;
    if (const auto least = object.find("min")) range.min = least->number(0, kMaxLength * 1e3);
    if (const auto most = object.find("max")) range.max = most->number(0, kMaxLength * 1e3);
    if (!range.min && !range.max) reader.fail("expected \"min\", \"max\" or both");
    if (range.min && range.max && *range.min > *range.max) reader.fail("\"min\" is above \"max\"");
    return range;
  }

  static std::string output_name(const ValueReader& reader, const std::string& extension) {
    const std::string name = reader.text();
    if (!is_safe_relative_path(name))
      reader.fail(
          fmt::format("output \"{}\" must be a plain path inside the output folder", printable(name)));
    if (extension_of(name) != extension)
      reader.fail(fmt::format("output \"{}\" must end in {}", name, extension));
    return name;
  }

  fs::path path_;
  std::vector<fs::path> including_;
  Recipe recipe_;
};

// The one recipe of a file that another recipe or the program asks for.
Recipe read_only_one(std::vector<ResolvedRecipe> recipes, const fs::path& path,
                     const std::vector<fs::path>& including) {
  if (recipes.size() != 1)
    throw Error(ExitCode::Usage, fmt::format("{}: this recipe makes {} characters; one is wanted here",
                                             path.string(), recipes.size()));
  return RecipeReader(path, including).read(recipes.front());
}

Recipe RecipeReader::included(const ValueReader& reader, const fs::path& path) const {
  std::vector<fs::path> chain = including_;
  chain.push_back(path_);
  std::error_code error;
  for (const fs::path& file : chain)
    if (fs::equivalent(file, path, error))
      reader.fail("recipe \"" + printable(path.string()) + "\" includes itself");
  if (chain.size() > kMaxIncludeDepth)
    reader.fail(fmt::format("recipes inside each other deeper than {}", kMaxIncludeDepth));
  return read_only_one(resolve_recipes(path), path, chain);
}
}  // namespace

std::size_t Recipe::input_index(const std::string& input) const {
  const auto found =
      std::find_if(inputs.begin(), inputs.end(), [&](const RecipeInput& i) { return i.name == input; });
  if (found == inputs.end()) throw Error(ExitCode::Internal, "no input \"" + input + "\"");
  return static_cast<std::size_t>(found - inputs.begin());
}

namespace {
// The recipe inside this one that the pointer leads into, and the pointer there.
std::pair<const Recipe*, std::string> inner_recipe(const Recipe& recipe, const std::string& pointer) {
  for (const RecipeInput& input : recipe.inputs) {
    const std::string prefix = pointer_to("/inputs", input.name) + "/recipe/";
    if (input.recipe && pointer.starts_with(prefix))
      return {input.recipe.get(), pointer.substr(prefix.size() - 1)};
  }
  return {nullptr, {}};
}
}  // namespace

std::string Recipe::where(const std::string& pointer) const {
  if (const auto [inner, rest] = inner_recipe(*this, pointer); inner) return inner->where(rest);
  std::string enclosing = pointer;
  auto found = places.find(enclosing);
  while (found == places.end() && !enclosing.empty()) {
    enclosing.erase(enclosing.rfind('/'));
    found = places.find(enclosing);
  }
  return found == places.end() ? path.string() : found->second;
}

std::string Recipe::place(const std::string& pointer) const {
  return where(pointer) + ": " + pointer;
}

std::map<std::string, std::string> recipe_settings(const Recipe& recipe) {
  std::map<std::string, std::string> settings = recipe.values;
  for (const char* key : {"/$schema", "/recipe_version"}) settings.erase(key);
  for (const RecipeInput& input : recipe.inputs) {
    if (!input.recipe) continue;
    for (auto& [pointer, text] : recipe_settings(*input.recipe))
      settings[pointer_to("/inputs", input.name) + "/recipe" + pointer] = text;
  }
  return settings;
}

Recipe read_resolved(const ResolvedRecipe& resolved) {
  return RecipeReader(resolved.path, {}).read(resolved);
}

Recipe load_recipe(const fs::path& path) {
  return read_only_one(resolve_recipes(path), path, {});
}

Recipe parse_recipe(const std::string& text, const fs::path& path) {
  return read_only_one(resolve_text(text, path), path, {});
}

}  // namespace skinforge
