#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "stages/inputs.h"
#include "stages/junction_trial.h"
#include "stages/operation_sides.h"
#include "stages/stages.h"
#include "stages/surface_options.h"
#include "surface/fading.h"

namespace skinforge {
namespace {

// Directions along which the two sides of a replacement fade, towards what stays of them, model space.
struct SideAxes {
  Vec3 host = Vec3::Zero(), part = Vec3::Zero();
};

SideAxes side_axes(const std::vector<const Character*>& characters, const Graft& before,
                   const GraftOperation& operation, const std::string& input) {
  const HostSide host = host_side(before, operation);
  if (host.joints.empty()) return {};
  const GraftSource& placed = before.sources[host.source.index()];
  const Character &base = *characters[placed.input], &donor = *characters[operation.input];
  const JointId joint = require_joint(donor.skeleton, operation.joint, input);
  const Vec3 fading = fading_of(base.mesh, presence_without(base, host.joints)).axis;
  const Vec3 other = fading_of(donor.mesh, presence_without(donor, std::vector{joint})).axis;
  return {placed.model_from_input.rotation * fading, operation.model_from_input.rotation * -other};
}

// The nearest axis of the model where it is within a few degrees: a part that stands in the plane of symmetry
// shall stay in it.
Vec3 snapped(const Vec3& axis) {
  static const double kNear = std::cos(radians(5));  // ours
  for (const Vec3& unit : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(Vec3::UnitZ())})
    if (std::abs(axis.dot(unit)) > kNear) return axis.dot(unit) > 0 ? unit : Vec3(-unit);
  return axis;
}

// Turns the part by `angle` of the way on which it comes to go on where its host ends. Parts that lie one
// upon the other turn about the model's side axis, or its upright one.
Quat turn_back(const SideAxes& axes, double angle) {
  constexpr double kParallel = 0.05;  // ours: sine of the angle from which the plane of the bend is known
  const Vec3 from = axes.part.normalized(), to = -axes.host.normalized();
  Vec3 axis = from.cross(to);
  for (const Vec3& side : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY())})
    if (axis.norm() < kParallel) axis = side - from.dot(side) * from;
  return Quat(Eigen::AngleAxisd(angle, snapped(axis.normalized())));
}

Similarity turned_about(const Similarity& place, const Vec3& centre, const Quat& turn) {
  return {place.scale, (turn * place.rotation).normalized(), turn * (place.translation - centre) + centre};
}

/// Turns parts back whose surfaces would not join with their hosts' as they are placed: the preliminary
/// posing that the paper leaves to its user (Sec. 4.1; Fig. 17).
class TurnParts final : public Stage {
 public:
  TurnParts(ArtifactNames names, const Recipe& recipe)
      : names_(std::move(names)), inputs_(input_names(recipe)), base_(recipe.input_index(recipe.base)) {
    for (const RecipeOperation& operation : recipe.operations) {
      cuts_.push_back(cut_options(operation.surface));
      fields_.push_back(field_options(operation));
      limits_.push_back(radians(operation.place.turn_limit_deg));
    }
  }

  StageInfo info() const override {
    return {.name = "turn",
            .version = 1,
            .reads = joined(character_names(names_, inputs_), {names_.asked_placement()}),
            .writes = {names_.placement()}};
  }
  void add_to_key(Hasher& key) const override {
    key.add_value("inputs", inputs_);
    key.add_value("base", base_);
    key.add_value("cuts", cuts_);
    key.add_value("fields", fields_);
    key.add_value("limits", limits_);
  }

  void run(const StageInput& in, StageOutput& out, IssueSink& issues) const override {
    const std::vector<const Character*> characters = get_characters(in, names_, inputs_);
    const JunctionTrial trial({characters, inputs_, base_, cuts_, fields_});
    PlacedOperations placed = in.get<PlacedOperations>(names_.asked_placement());
    placed.turns.resize(placed.operations.size());
    for (std::size_t k = 0; k < placed.operations.size(); ++k)
      if (placed.operations[k].kind == GraftKind::Replace) settle(characters, trial, placed, k, issues);
    out.put(names_.placement(), std::move(placed));
  }

 private:
  // The first of these whose surfaces join: as asked; by the other operator; turned back by a quarter of the
  // bend, and another; as asked.
  void settle(const std::vector<const Character*>& characters, const JunctionTrial& trial,
              PlacedOperations& placed, std::size_t k, IssueSink& issues) const {
    constexpr double kBent = 55.0 / 180 * std::numbers::pi;  // ours: no junction failed by a smaller bend
    const GraftOperation asked = placed.operations[k];
    const SideAxes axes = side_axes(characters, trial.graft(placed, k), asked, inputs_[asked.input]);
    PartTurn& turn = placed.turns[k];
    turn.bend = bend_between(axes.host, axes.part);
    if (turn.bend < kBent || limits_[k] <= 0 || !placed.joint_shifts[k].empty()) return;
    const BlendOperator op = fields_[k].blend.op;
    const std::string fault = trial.fault(placed, k, op);
    if (fault.empty()) return;
    const BlendOperator other = op == BlendOperator::Smin ? BlendOperator::Auto : BlendOperator::Smin;
    if (trial.fault(placed, k, other).empty()) {
      turn.op = other;
      return tell(turn, fault, k, issues);
    }
    const Skeleton& skeleton = characters[asked.input]->skeleton;
    const JointId joint = require_joint(skeleton, asked.joint, inputs_[asked.input]);
    const Vec3 centre = asked.model_from_input * skeleton[joint].joint_from_model.inverse().translation();
    for (const double share : {0.25, 0.5, 0.75, 1.0}) {
      const double angle = std::min(share * turn.bend, limits_[k]);
      placed.operations[k].model_from_input =
          turned_about(asked.model_from_input, centre, turn_back(axes, angle));
      if (trial.fault(placed, k, op).empty()) {
        turn.angle = angle;
        return tell(turn, fault, k, issues);
      }
      if (angle == limits_[k]) break;
    }
    placed.operations[k] = asked;
  }

  static void tell(const PartTurn& turn, const std::string& fault, std::size_t k, IssueSink& issues) {
    const std::string place = fmt::format("op {}", k + 1);
    if (turn.op)
      return issues.warn("operator-changed", place,
                         fmt::format("as asked the surfaces do not join ({}); blended by \"{}\" instead",
                                     fault, *turn.op == BlendOperator::Smin ? "smin" : "auto"));
    issues.warn(
        "part-turned", place,
        fmt::format("the part stands at {:.0f} degrees to its host and their surfaces do not join ({}); "
                    "turned back by {:.0f} degrees (\"place\": {{\"turn_limit_deg\": 0}} leaves it)",
                    degrees(turn.bend), fault, degrees(turn.angle)));
  }

  ArtifactNames names_;
  std::vector<std::string> inputs_;
  std::size_t base_;
  std::vector<CutOptions> cuts_;  // per operation, as all here
  std::vector<FieldOptions> fields_;
  std::vector<double> limits_;  // radians
};

}  // namespace

StagePointer make_turn_stage(const ArtifactNames& names, const Recipe& recipe) {
  return std::make_unique<TurnParts>(names, recipe);
}

}  // namespace skinforge
