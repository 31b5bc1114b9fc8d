#include <fmt/format.h>

#include "skeleton/pose.h"
#include "stages/inputs.h"
#include "stages/operation_sides.h"
#include "stages/stages.h"
#include "surface/cut_line.h"

namespace skinforge {
namespace {

Vec3 to_vec3(const std::array<double, 3>& a) {
  return {a[0], a[1], a[2]};
}

GraftKind to_kind(OperationKind kind) {
  return static_cast<GraftKind>(kind);
}

// The cut that taking `joints` and all below them leaves on a character: its line of presence 1/2.
std::optional<CutLine> cut_line_of(const Character& character, std::span<const JointId> joints) {
  return longest_cut_line(character.mesh, presence_without(character, joints));
}

// Where an operation cuts its host, model space.
std::optional<CutLine> cut_line_of(const std::vector<const Character*>& characters, const Graft& graft,
                                   const HostSide& host) {
  if (host.joints.empty()) return std::nullopt;
  const GraftSource& placed = graft.sources[host.source.index()];
  std::optional<CutLine> cut = cut_line_of(*characters[placed.input], host.joints);
  if (cut) {
    cut->centre = placed.model_from_input * cut->centre;
    cut->length *= placed.model_from_input.scale;
  }
  return cut;
}

/// Works out where each grafted input goes; the paper's default brings joint onto joint (Sec. 4.1).
class Place final : public Stage {
 public:
  Place(ArtifactNames names, const Recipe& recipe)
      : names_(std::move(names)), inputs_(input_names(recipe)), operations_(recipe.operations) {
    base_ = recipe.input_index(recipe.base);
    for (std::size_t i = 0; i < operations_.size(); ++i)
      places_.push_back(recipe.place(fmt::format("/ops/{}", i)));
  }

  StageInfo info() const override {
    return {.name = "place",
            .version = 2,
            .reads = character_names(names_, inputs_),
            .writes = {names_.asked_placement()}};
  }

  void add_to_key(Hasher& key) const override {
    key.add_value("base", base_);
    key.add_value("inputs", inputs_);
    for (const RecipeOperation& o : operations_) {  // only what is used here: looks do not move a part
      key.add_value("kind", o.kind);
      key.add_value("at", o.at);
      key.add("from", o.from);
      key.add("joint", o.joint);
      key.add_value("place", o.place);
    }
  }

  void run(const StageInput& in, StageOutput& out, IssueSink& issues) const override {
    const std::vector<const Character*> characters = get_characters(in, names_, inputs_);
    const auto skeletons = skeletons_of(characters);
    PlacedOperations placed;
    for (std::size_t k = 0; k < operations_.size(); ++k) {
      const RecipeOperation& wanted = operations_[k];
      GraftOperation operation{.kind = to_kind(wanted.kind),
                               .at = wanted.at,
                               .input = 0,
                               .joint = wanted.joint,
                               .model_from_input = {}};
      with_context(places_[k], [&] {
        if (!wanted.from.empty()) {
          operation.input = index_of(wanted.from);
          IssueSink unheard;  // the same operations run again, heard, in graft_skeleton
          const Graft so_far = graft_skeletons(skeletons, inputs_, base_, placed.operations, unheard);
          operation.model_from_input = placement(characters, so_far, operation, wanted, issues);
        }
      });
      placed.operations.push_back(std::move(operation));
    }
    placed.joint_shifts = spread_shifts(characters, placed.operations);
    out.put(names_.asked_placement(), std::move(placed));
  }

 private:
  std::size_t index_of(const std::string& input) const {
    return static_cast<std::size_t>(std::find(inputs_.begin(), inputs_.end(), input) - inputs_.begin());
  }

  Similarity placement(const std::vector<const Character*>& characters, const Graft& graft,
                       const GraftOperation& operation, const RecipeOperation& wanted,
                       IssueSink& issues) const {
    const Placement& place = wanted.place;
    Similarity result{place.scale, rotation_yxz(place.rotate_deg), to_vec3(place.offset)};
    if (place.align == Align::None) return result;
    const Character& donor = *characters[operation.input];
    const JointId joint = require_joint(donor.skeleton, operation.joint, wanted.from);
    const HostSide host = host_side(graft, operation);
    const std::optional<CutLine> host_cut = cut_line_of(characters, graft, host);
    const std::optional<CutLine> cut = cut_line_of(donor, std::vector<JointId>{joint});
    const bool has_loops = host_cut && cut && operation.kind == GraftKind::Replace;
    if (!has_loops && (place.align == Align::Loop || place.scale_by_loop))
      issues.warn("no-cut-loop", fmt::format("op {}", wanted.joint),
                  "no cut loop on both sides to align by: the joints are aligned instead");
    if (place.scale_by_loop && has_loops) result.scale = host_cut->length / cut->length;
    const bool by_loop = place.align == Align::Loop && has_loops;
    const Vec3 from = by_loop ? cut->centre : donor.skeleton[joint].joint_from_model.inverse().translation();
    const Vec3 to = by_loop ? host_cut->centre : host.centre;
    result.translation = to - result.scale * (result.rotation * from) + to_vec3(place.offset);
    return result;
  }

  // Sec. 4.1: an input matched in several places is moved by a translation that is spread over all its
  // joints.
  std::vector<std::vector<Vec3>> spread_shifts(const std::vector<const Character*>& characters,
                                               const std::vector<GraftOperation>& placed) const {
    std::vector<std::vector<Vec3>> shifts(placed.size());
    for (std::size_t k = 0; k < placed.size(); ++k) {
      if (operations_[k].from.empty() || operations_[k].place.align == Align::None) continue;
      const Skeleton& skeleton = characters[placed[k].input]->skeleton;
      std::vector<std::pair<JointId, Vec3>> given;
      for (std::size_t other = 0; other < placed.size(); ++other) {
        const bool matches = operations_[other].from == operations_[k].from &&
                             operations_[other].place.align != Align::None &&
                             operations_[other].place.rotate_deg == operations_[k].place.rotate_deg &&
                             placed[other].model_from_input.scale == placed[k].model_from_input.scale;
        if (!matches) continue;
        given.push_back(
            {require_joint(skeleton, placed[other].joint, operations_[other].from),
             placed[other].model_from_input.translation - placed[k].model_from_input.translation});
      }
      if (given.size() > 1) shifts[k] = spread_translations(skeleton, given);
    }
    return shifts;
  }

  ArtifactNames names_;
  std::vector<std::string> inputs_;
  std::vector<RecipeOperation> operations_;
  std::vector<std::string> places_;
  std::size_t base_ = 0;
};

}  // namespace

StagePointer make_place_stage(const ArtifactNames& names, const Recipe& recipe) {
  return std::make_unique<Place>(names, recipe);
}

}  // namespace skinforge
