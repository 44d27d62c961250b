// SPDX-License-Identifier: Apache-2.0
#include "invsim/sim/scene.h"

#include <gmock/gmock.h>

#include "invsim/base/error.h"
#include "invsim/cloth/mass.h"
#include "sim/test_scene.h"

namespace invsim {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> EffectNames(const SimulatorSetup& setup) {
  std::vector<std::string> names;
  for (const auto& effect : setup.effects) names.push_back(effect->name());
  return names;
}

TEST(Scene, BuildsTheListedEffectsInOrderAndNoOthers) {
  SceneOptions options;
  options.effects = {"bending", "gravity"};
  const SimulatorSetup setup =
      MakeSetup(options, BallBody(), SheetAboveBall(2, 0.2), PlainCloth());
  EXPECT_THAT(EffectNames(setup), ElementsAre("bending", "gravity"));
}

TEST(Scene, HasInertiaGravityMembraneAndBendingUnlessTold) {
  const SimulatorSetup setup =
      MakeSetup({}, BallBody(), SheetAboveBall(2, 0.2), PlainCloth());
  EXPECT_THAT(EffectNames(setup),
              ElementsAre("inertia", "gravity", "membrane", "bending"));
  EXPECT_DOUBLE_EQ(setup.contact.thickness, 0.002);
}

TEST(Scene, TakesEverythingOfBodyAndGarment) {
  const BodyModel body = BallBody();
  const Garment sheet = SheetAboveBall(3, 0.2);
  const SimulatorSetup setup = MakeSetup({}, body, sheet, PlainCloth());
  EXPECT_EQ(setup.faces, sheet.faces);
  EXPECT_EQ(setup.body_faces, body.faces());
  EXPECT_EQ(setup.body, body.data().v_template);
  EXPECT_NEAR(setup.mass.sum(), 0.2 * 0.2 * 0.2, 1e-12);
}

TEST(Scene, ReadsItsKeysAndThoseOfEffects) {
  SceneOptions options;
  OptionTable table;
  Describe(&table, &options);
  table.Read(Config::FromText(R"(
scene.effects = ["inertia", "gravity"]
scene.material = "silk"
effects.gravity.acceleration = [0, -1, 0]
contact.thickness = 0.003
step.substeps = 7
step.friction.tolerance = 1e-5
)",
                              "scene.toml"));
  EXPECT_EQ(options.material, "silk");
  EXPECT_EQ(options.contact.thickness, 0.003);
  EXPECT_EQ(options.step.substeps, 7);
  EXPECT_EQ(options.step.friction.tolerance, 1e-5);
  const Garment sheet = SheetAboveBall(2, 0.2);
  const SimulatorSetup setup =
      MakeSetup(options, BallBody(), sheet, PlainCloth());
  Points weight = Points::Zero(3, sheet.num_vertices());
  setup.effects[1]->AddForce({sheet.placed, 0 * sheet.placed}, &weight);
  EXPECT_NEAR(weight.row(1).sum(), -setup.mass.sum(), 1e-12);
}

TEST(Scene, NamesTheNearestEffectAndKey) {
  SceneOptions options;
  OptionTable table;
  Describe(&table, &options);
  try {
    table.Read(Config::FromText("contact.thicknes = 1\n", "scene.toml"));
    FAIL() << "read an unknown key";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr("scene.toml:1"),
                      HasSubstr("did you mean 'contact.thickness'")));
  }
  EXPECT_THROW(table.Read(Config::FromText("scene.effects = ['membran']", "s")),
               UsageError);
  options.effects = {"membran"};
  EXPECT_THROW(
      MakeSetup(options, BallBody(), SheetAboveBall(2, 0.2), PlainCloth()),
      UsageError);
}

TEST(Scene, RefusesAnEffectListedTwice) {
  SceneOptions options;
  options.effects = {"gravity", "gravity"};
  EXPECT_THROW(
      MakeSetup(options, BallBody(), SheetAboveBall(2, 0.2), PlainCloth()),
      UsageError);
}

TEST(Scene, FrictionIsTheMaterialsUnlessSet) {
  Material slippery = PlainCloth();
  slippery.friction = 0.05;
  SceneOptions options;
  OptionTable table;
  Describe(&table, &options);
  UseMaterialFriction(table, slippery, &options);
  EXPECT_EQ(options.contact.friction, 0.05);
  table.Read(Config::FromText("contact.friction = 0.7", "scene.toml"));
  UseMaterialFriction(table, slippery, &options);
  EXPECT_EQ(options.contact.friction, 0.7);
}

TEST(CheckGarmentFits, AcceptsCloseAndRefusesInsideOrAway) {
  const BodyModel body = BallBody();
  const ShapeVector mean = ShapeVector::Zero();
  EXPECT_NO_THROW(
      CheckGarmentFits(SheetAboveBall(4, 0.2), body, mean, "sheet.obj"));

  Garment inside = SheetAboveBall(4, 0.1);
  inside.placed.row(1).array() -= kBallRadius;
  try {
    CheckGarmentFits(inside, body, mean, "sheet.obj");
    FAIL() << "took a garment inside the body";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr("sheet.obj: 25 of its 25 vertices"),
                      HasSubstr("T-posed body")));
  }

  Garment away = SheetAboveBall(4, 0.2, 1.0);
  EXPECT_THROW(CheckGarmentFits(away, body, mean, "sheet.obj"), InputError);
}

TEST(CheckGarmentFits, LooksAtTheBodyOfTheGivenShape) {
  const BodyModel body = BallBody();
  ShapeVector swollen = ShapeVector::Zero();
  swollen[0] = 10;  // twice the radius
  EXPECT_THROW(
      CheckGarmentFits(SheetAboveBall(4, 0.2), body, swollen, "sheet.obj"),
      InputError);
}

}  // namespace
}  // namespace invsim
