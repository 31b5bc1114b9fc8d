#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/archive.h"
#include "base/color_text.h"
#include "base/error.h"
#include "base/hash.h"

/// A recipe as plain data: every default is here, and the schema (schemas/recipe.schema.json) repeats it.
/// Angles in degrees as the person wrote them, lengths in metres. The `fields` of each struct are what a
/// stage key may hash: no paths, no places in the file.
namespace skinforge {

/// How an input is posed before it is mixed (SkinMixer Sec. 4.1, Fig. 3).
struct PoseChange {
  std::array<double, 3> rotate_deg = {0, 0, 0};  ///< x, y, z; R = Ry(y) Rx(x) Rz(z), in the joint's own frame
  std::array<double, 3> translate = {0, 0, 0};   ///< metres, model axes

  auto operator<=>(const PoseChange&) const = default;
  template <class Archive>
  friend void fields(Archive& a, PoseChange& p) {
    a(p.rotate_deg, p.translate);
  }
};

struct Recipe;

/// A path as it stands in the recipe, and where it leads.
struct RecipePath {
  std::string text;
  std::filesystem::path resolved;  ///< beside the recipe; absolute when the recipe's path was
};

enum class RecipeBindMethod : std::uint8_t { Harmonic, Heat };

/// Where the vertices come from that bones hold alone (ETH Sec. 4.1).
enum class RecipeHandles : std::uint8_t {
  Rule,    ///< by distance from the bones
  Groups,  ///< face groups named after joints
  Skin,    ///< the weights that the model has, or else the model that gives the skeleton
  Labels,  ///< a .dmat of labels or a .json of vertex lists
  Image    ///< a painted image, looked up by UV
};

/// A model that gets its skin here: bones of its own or of another file, weights worked out.
struct RecipeBind {
  RecipePath skeleton;  ///< .tgf, or a model whose joints and clips are taken; empty text: the model's own
  RecipeBindMethod method = RecipeBindMethod::Harmonic;
  RecipeHandles handles = RecipeHandles::Rule;
  RecipePath handle_file;                ///< of Labels and Image
  std::map<std::string, Color8> colors;  ///< of Image: the colour of each joint
  double handle_weight = 0.6;            ///< of Skin: a joint holds vertices whose weight is above this
  double handle_factor = 1.5;            ///< of Rule (ETH Sec. 4.1)
  int handle_least = 12;                 ///< of Rule: vertices of a joint it widens itself to take
  int resolution = 96;                   ///< cells along the model, of Heat
  double rate_hz = 30;                   ///< frames a second of .dmat clips

  /// All but where files lie.
  template <class Archive>
  friend void fields(Archive& a, RecipeBind& b) {
    a(b.method, b.handles, b.colors, b.handle_weight, b.handle_factor, b.handle_least, b.resolution,
      b.rate_hz);
  }
};

/// A shape of the model in a pose, for context-aware correctives (ETH Sec. 8).
struct RecipeExample {
  RecipePath shape;  ///< .obj or .off, vertices as in the input's file
  RecipePath pose;   ///< .dmat, one frame of rotations
};

/// One character that goes in: a model file, or another recipe.
struct RecipeInput {
  std::string name;                        ///< the key in "inputs"
  RecipePath file;                         ///< the model; for { "recipe": ... } the recipe
  std::shared_ptr<const Recipe> recipe;    ///< set when the input is made by another recipe
  std::vector<RecipePath> clips;           ///< further files whose clips are added
  std::optional<RecipeBind> bind;          ///< set when the model gets its skin here
  std::map<std::string, PoseChange> pose;  ///< by joint name
};

enum class OperationKind : std::uint8_t { Replace, Attach, Remove, Detach };
enum class Align : std::uint8_t { Joint, Loop, None };
enum class BlendKind : std::uint8_t { Auto, Paper, Smin, Gradient };

/// How the surfaces of an operation become one (SkinMixer Eq. 1 and beyond). "blend" (replace) and "union"
/// (attach) say what the operation does anyway, and mean Auto.
struct Blend {
  BlendKind kind = BlendKind::Auto;
  double radius = 0;  ///< of the fillet, metres; 0: by the parts

  auto operator<=>(const Blend&) const = default;
  template <class Archive>
  friend void fields(Archive& a, Blend& b) {
    a(b.kind, b.radius);
  }
};

/// Where the grafted part goes (SkinMixer Sec. 4.1): p -> scale R p about `joint`, then moved by `align`,
/// then by `offset`; with Align::None p -> scale R p + offset about the input's origin.
struct Placement {
  Align align = Align::Joint;
  bool scale_by_loop =
      false;         ///< "scale": "loop", makes the girths of the cut loops equal; `scale` is 1 then
  double scale = 1;  ///< > 0
  std::array<double, 3> rotate_deg = {0, 0, 0};  ///< x, y, z; R = Ry(y) Rx(x) Rz(z)
  std::array<double, 3> offset = {0, 0, 0};      ///< metres
  /// A part whose surface would not join with its host's is turned back by at most this; [0, 180].
  double turn_limit_deg = 90;

  auto operator<=>(const Placement&) const = default;
  template <class Archive>
  friend void fields(Archive& a, Placement& p) {
    a(p.align, p.scale_by_loop, p.scale, p.rotate_deg, p.offset, p.turn_limit_deg);
  }
};

/// Components that are neither clearly kept nor clearly gone are decided as wholes (SkinMixer Sec. 6).
struct KeepOrDrop {
  double variance = 0.04;  ///< a component whose presence varies less is decided as a whole; [0, 0.25]
  double mean = 0.5;       ///< kept when its mean presence reaches this; [0, 1]

  auto operator<=>(const KeepOrDrop&) const = default;
  template <class Archive>
  friend void fields(Archive& a, KeepOrDrop& k) {
    a(k.variance, k.mean);
  }
};

/// A value for each side of an operation: the character as it stands, and the input the part comes from.
template <class T>
struct Sides {
  T at{};
  T from{};

  auto operator<=>(const Sides&) const = default;
  template <class Archive>
  friend void fields(Archive& a, Sides& s) {
    a(s.at, s.from);
  }
};

/// What the faces of a junction may be.
enum class Elements : std::uint8_t {
  Auto,      ///< quads wherever they are good, else triangles
  Quads,     ///< the same, and triangles are paired however poor the quad is
  Triangles  ///< triangles only
};

/// How the junction of an operation is made. The recipe's own "surface" gives the defaults of all operations.
struct SurfaceOptions {
  /// Voxel edge over the shorter mean edge length; [0.1, 4]. Departure: the paper (Sec. 6.1) takes 0.8, at
  /// which thin limbs lost their junction.
  double voxel_factor = 0.5;
  double voxel = 0;  ///< voxel edge in metres, instead of the factor; 0 for none, else [1e-6, 1e6]
  /// Laplacian passes over the presence; [0, 99]. Departure: the paper (Sec. 6) makes one, the program of its
  /// authors ten.
  int presence_smoothing = 10;
  /// How long each side holds its own shape against the other; [-0.9, 0.9], 0 as the weights say.
  Sides<double> hardness;
  /// Whether the blended region takes in what hangs on the parent of the joint, too.
  Sides<bool> include_parent;
  KeepOrDrop keep_or_drop;
  Elements elements = Elements::Auto;
  int smoothing = 0;  ///< further Laplacian rounds over the new faces; [0, 99]

  auto operator<=>(const SurfaceOptions&) const = default;
  template <class Archive>
  friend void fields(Archive& a, SurfaceOptions& s) {
    a(s.voxel_factor, s.voxel, s.presence_smoothing, s.hardness, s.include_parent, s.keep_or_drop, s.elements,
      s.smoothing);
  }
};

struct RecipeOperation {
  OperationKind kind = OperationKind::Replace;
  std::vector<std::string> at;  ///< joints of the character as it stands; at least one, each once
  std::string from;             ///< input; replace and attach
  std::string joint;            ///< joint of that input; replace and attach
  Placement place;
  Blend blend;
  SurfaceOptions surface;  ///< the recipe's, where the operation does not say otherwise

  auto operator<=>(const RecipeOperation&) const = default;
  template <class Archive>
  friend void fields(Archive& a, RecipeOperation& o) {
    a(o.kind, o.at, o.from, o.joint, o.place, o.blend, o.surface);
  }
};

/// How the keyframes of completed parts are chosen (SkinMixer Sec. 8).
enum class CompletionMethod : std::uint8_t {
  Sequence,  ///< the best whole sequence
  Paper,     ///< the best keyframe for each frame on its own, then light smoothing
};

/// How the clip of one name is completed; what is not set is as `AnimationOptions` says.
struct ClipSettings {
  std::optional<bool> complete;
  std::optional<CompletionMethod> method;
  std::optional<double> rate_hz;
  std::optional<std::array<double, 2>> tempo;
  std::optional<double> limb_phase;
  std::optional<double> limb_clearing_deg;
  std::optional<bool> loop;      ///< whether it is played in a loop; by default found from its poses
  std::vector<std::string> use;  ///< clips of other inputs that poses may be taken from; empty: all
  std::string with;              ///< clip of another input that is played as it is; empty: none

  auto operator<=>(const ClipSettings&) const = default;
  template <class Archive>
  friend void fields(Archive& a, ClipSettings& c) {
    a(c.complete, c.method, c.rate_hz, c.tempo, c.limb_phase, c.limb_clearing_deg, c.loop, c.use, c.with);
  }
};

struct AnimationOptions {
  bool all_clips = true;
  std::vector<std::string> clips;  ///< names to keep, when not all
  bool complete = true;            ///< give the other parts motion in each clip (SkinMixer Sec. 8)
  CompletionMethod method = CompletionMethod::Sequence;
  std::optional<double> rate_hz;  ///< keys a second of completed tracks; [1, 240]; by default the clip's own
  std::array<double, 2> tempo = {0.5,
                                 2};  ///< of completed parts over that of their own clips; [0.5, 1], [1, 2]
  /// Share of a step by which limbs that the body has twice follow those it had before; [0, 1]; 0 moves both
  /// alike. By default the limbs of one kind share the step evenly.
  std::optional<double> limb_phase;
  /// Degrees by which a limb of a completed part may be turned for a whole clip, so that it does not cut the
  /// driving part; [0, 90].
  double limb_clearing_deg = 40;
  double key_tolerance =
      1e-4;  ///< of the diagonal: what leaving out keys of completed tracks may move; [0, 0.1]
  std::map<std::string, ClipSettings> per_clip;  ///< by the clip's name, in its input or in the result

  auto operator<=>(const AnimationOptions&) const = default;
  template <class Archive>
  friend void fields(Archive& a, AnimationOptions& o) {
    a(o.all_clips, o.clips, o.complete, o.method, o.rate_hz, o.tempo, o.limb_phase, o.limb_clearing_deg,
      o.key_tolerance, o.per_clip);
  }
};

enum class RecipeDeform : std::uint8_t { None, DualQuaternion, Poisson, Context };
enum class RecipeKernel : std::uint8_t { Linear, Gaussian };

/// Morph targets that bring the clips to what a better skinning method gives, under plain linear blending.
struct CorrectivesOptions {
  RecipeDeform method = RecipeDeform::None;
  int targets = 8;       ///< at most; [1, 64]
  double enough = 1e-4;  ///< of the bounding box's diagonal: no more targets once the error is below
  std::vector<RecipeExample> examples;  ///< of Context
  bool rest = true;                     ///< of Context: the rest pose is one more example, without change
  RecipeKernel kernel = RecipeKernel::Linear;  ///< of Context
  std::vector<std::string>
      joints;  ///< of Context: whose rotations say how near a pose is; empty: all but roots

  template <class Archive>
  friend void fields(Archive& a, CorrectivesOptions& o) {
    a(o.method, o.targets, o.enough, o.rest, o.kernel, o.joints);
  }
};

/// Files to write, as safe relative paths; an empty name writes no such file.
struct OutputOptions {
  std::string glb;  ///< default: the recipe's name + ".glb"
  std::string obj;
  std::string vdb;
  bool all_animated = false;          ///< draw every clip as an animated picture
  std::vector<std::string> animated;  ///< names of clips to draw so, when not all
  int influences = 4;                 ///< 4 or 8 a vertex

  auto operator<=>(const OutputOptions&) const = default;
  template <class Archive>
  friend void fields(Archive& a, OutputOptions& o) {
    a(o.glb, o.obj, o.vdb, o.all_animated, o.animated, o.influences);
  }
};

/// What a quantity of the result may be; unset ends are open.
struct ExpectedRange {
  std::optional<double> min, max;

  auto operator<=>(const ExpectedRange&) const = default;
  template <class Archive>
  friend void fields(Archive& a, ExpectedRange& r) {
    a(r.min, r.max);
  }
};

/// Budgets that the result has to keep ("expect"). They change nothing in it, so they are in no key but that
/// of the stage that checks them.
struct Expectations {
  std::map<std::string, ExpectedRange> ranges;  ///< by quantity: "triangles", "joints", ... (schema)
  std::optional<bool> watertight;
  std::vector<std::string> clips;  ///< clips that must be there

  bool is_empty() const { return ranges.empty() && !watertight && clips.empty(); }
  auto operator<=>(const Expectations&) const = default;
  template <class Archive>
  friend void fields(Archive& a, Expectations& e) {
    a(e.ranges, e.watertight, e.clips);
  }
};

/// The character that the result is compared with ("expect.golden"), and what is still the same: shares of
/// the golden's diagonal, of the texture and of the picture, weights in [0, 2], degrees, seconds, as
/// `DiffThresholds` gives them.
struct GoldenOptions {
  RecipePath file;  ///< a .glb
  double geometry = 1e-5;
  double normals = 1;  ///< degrees
  double uv = 1e-3;
  double weights = 0.01;
  double animation = 5e-4;
  double duration = 1e-3;
  double picture = 1e-3;
  bool structure = true;  ///< whether any edit of the structure is a difference

  /// All but where the file lies.
  template <class Archive>
  friend void fields(Archive& a, GoldenOptions& g) {
    a(g.geometry, g.normals, g.uv, g.weights, g.animation, g.duration, g.picture, g.structure);
  }
};

struct Recipe {
  std::filesystem::path path;
  std::string variant;              ///< cell of the recipe's matrix, "body=horse torso=knight"; else empty
  std::string name;                 ///< a safe file name
  std::vector<RecipeInput> inputs;  ///< by rising name, so the order in the file does not matter
  std::string base;                 ///< an input
  std::vector<RecipeOperation> operations;
  SurfaceOptions surface;
  AnimationOptions animation;
  CorrectivesOptions correctives;
  OutputOptions output;
  Expectations expect;
  std::optional<GoldenOptions> golden;
  std::map<std::string, std::string> places;  ///< JSON pointer -> "centaur.json:12:9"
  std::map<std::string, std::string> values;  ///< JSON pointer of each value or list of values -> its text

  /// Index into `inputs` of a name that the recipe uses (load_recipe has checked that it is there).
  std::size_t input_index(const std::string& input) const;
  /// "centaur.json:12:9", where that stands; the nearest enclosing place when `pointer` itself was left to
  /// its default. Behind "/inputs/<name>/recipe" stand the pointers of that recipe.
  std::string where(const std::string& pointer) const;
  /// "centaur.json:12:9: /ops/0/at", for messages about what stands there.
  std::string place(const std::string& pointer) const;
};

/// All that a recipe sets, by JSON pointer, as text: `"joint"`, `1.2`, `[0, -90, 0]`; those of recipes inside
/// it behind "/inputs/<name>/recipe". Without what no result depends on ("$schema", "recipe_version").
std::map<std::string, std::string> recipe_settings(const Recipe& recipe);

/// Digest of what the recipe asks for: every value that can change the result, those of recipes inside it
/// too, but no path, since where files lie changes nothing (their contents have digests of their own), and
/// neither comments nor the order of keys.
Digest recipe_digest(const Recipe& recipe);

/// The version of recipes that this tool reads; older ones `migrate` rewrites (migrate.h).
constexpr int kRecipeVersion = 1;

/// Reads a recipe: JSON, JSON with comments (.json, .jsonc), YAML (.yaml, .yml). Inputs that are recipes are
/// read too. Names, kinds, ranges and references between parts of the recipe are checked, files other than
/// recipes are not touched. Throws Error: BadInput when `path` cannot be read; Usage for everything else, one
/// line such as `centaur.json:12:9: /ops/0/at: unknown key "att" (nearest: "at")`.
Recipe load_recipe(const std::filesystem::path& path);

/// The same from text in hand; `path` gives the format, the folder and the name in messages.
Recipe parse_recipe(const std::string& text, const std::filesystem::path& path);

}  // namespace skinforge
