// Parts that are placed at an angle at which their surfaces do not join with their hosts' (the paper's Fig.
// 17).
#include <gtest/gtest.h>

#include "stages/built_recipe.h"
#include "testing/assets.h"

namespace skinforge {
namespace {

struct Built {
  GraftOperation operation;
  Vec3 fused = Vec3::Zero();  // place of the fused joint
  PartTurn turn;
  Junction junction;
};

// The griffin's head on the man's neck, its beak down by `degrees` from where recipes/head_swap.json has it.
Built bowed_head(double degrees, nlohmann::json place = nlohmann::json::object()) {
  place["scale"] = 0.64;
  place["rotate_deg"] = {degrees - 32, 0, 0};
  const nlohmann::json recipe = {
      {"recipe_version", 1},
      {"name", "bowed"},
      {"base", "human"},
      {"animation", {{"clips", {"Idle"}}}},
      {"inputs", {{"human", "data/human.glb"}, {"griffin", "data/griffin.glb"}}},
      {"ops",
       {{{"op", "replace"}, {"at", "Neck"}, {"from", "griffin"}, {"joint", "Head"}, {"place", place}}}}};
  testing::BuiltRecipe built(recipe, testing::repository_file("recipe.json"));
  const ArtifactNames names;
  const auto placed = built.get<PlacedOperations>(names.placement());
  const auto graft = built.get<Graft>(names.graft());
  return {placed.operations[0], graft.skeleton[graft.sites[0].fused].joint_from_model.inverse().translation(),
          placed.turns[0], built.get<SurfaceResult>(names.surface()).junctions[0]};
}

TEST(Turn, LeavesWhatJoins) {
  const Built built = bowed_head(0);
  EXPECT_LT(built.turn.bend, radians(5));
  EXPECT_EQ(built.turn.angle, 0);
  EXPECT_EQ(built.junction.rung, JunctionRung::Tube);
}

// As asked the beak is inside the chest, and so are the faces that would have to join.
TEST(Turn, LiftsABowedHeadUntilItJoins) {
  const Built asked = bowed_head(60, {{"turn_limit_deg", 0}}), built = bowed_head(60);
  EXPECT_TRUE(asked.junction.faults.any());
  EXPECT_EQ(asked.turn.angle, 0);
  EXPECT_FALSE(built.junction.faults.any());
  EXPECT_EQ(built.junction.rung, JunctionRung::Tube);
  EXPECT_NEAR(built.turn.bend, radians(62), radians(2));
  EXPECT_NEAR(built.turn.angle, 0.75 * built.turn.bend, 1e-9);
  EXPECT_LT((built.fused - asked.fused).norm(), 1e-9);  // about its joint
  const Quat turn =
      built.operation.model_from_input.rotation * asked.operation.model_from_input.rotation.inverse();
  EXPECT_NEAR(std::abs(turn.x()), std::sin(0.5 * built.turn.angle), 1e-9);
  EXPECT_NEAR(std::hypot(turn.y(), turn.z()), 0, 1e-9);  // within its plane of symmetry
}

TEST(Turn, KeepsWhatWasAskedWhereTheLimitIsTooLow) {
  const Built built = bowed_head(60, {{"turn_limit_deg", 20}});
  EXPECT_EQ(built.turn.angle, 0);
  EXPECT_TRUE(built.junction.faults.any());
}

// Three quarters of the bend would be 46 degrees.
TEST(Turn, GoesAsFarAsTheLimit) {
  const Built built = bowed_head(60, {{"turn_limit_deg", 40}});
  EXPECT_NEAR(built.turn.angle, radians(40), 1e-9);
  EXPECT_FALSE(built.junction.faults.any());
}

}  // namespace
}  // namespace skinforge
