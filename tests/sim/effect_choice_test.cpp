// SPDX-License-Identifier: Apache-2.0
#include "invsim/sim/effect_choice.h"

#include <gmock/gmock.h>

#include "invsim/base/error.h"
#include "invsim/sim/scene.h"
#include "sim/test_scene.h"

namespace invsim {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class DecideEffectsTest : public ::testing::Test {
 protected:
  DecideEffectsTest() {
    Describe(&table_, &scene_);
    scene_.effects = {"auto"};
    motion_.frames_per_second = 30;
    motion_.steps_per_second = 120;
    motion_.speed = 1;
    motion_.acceleration = 10;
    motion_.dressing_acceleration = 0;
    motion_.layers_can_meet = false;
  }
  void Set(const std::string& toml) {
    table_.Read(Config::FromText(toml, "test"));
  }
  EffectDecision Of(const std::string& name) {
    for (const EffectDecision& d :
         DecideEffects(scene_, sheet_, cloth_, motion_))
      if (d.name == name) return d;
    throw std::logic_error("no decision on " + name);
  }
  std::vector<std::string> On() {
    return EffectsOn(DecideEffects(scene_, sheet_, cloth_, motion_));
  }

  SceneOptions scene_;
  OptionTable table_;
  Garment sheet_ = SheetAboveBall(10, 0.3);  // mean edge 3.4 cm
  Material cloth_ = PlainCloth();            // 1.96 N/m^2, B = 1e-5 N m
  SceneMotion motion_;
};

TEST_F(DecideEffectsTest, SaysSomethingOfEveryEffectInTheirOrder) {
  std::vector<std::string> names;
  for (const EffectDecision& d :
       DecideEffects(scene_, sheet_, cloth_, motion_)) {
    if (!d.built_in) names.push_back(d.name);
    EXPECT_FALSE(d.reason.empty()) << d.name;
  }
  EXPECT_EQ(names, Effects().names());
}

// 1.2 x 1.17 / 2 u^2 against 1.96: one percent at 0.167 m/s.
TEST_F(DecideEffectsTest, AirDragByTheSpeedAgainstTheAir) {
  motion_.speed = 0.16;
  EXPECT_FALSE(Of("air_drag").on);
  motion_.speed = 0.18;
  EXPECT_TRUE(Of("air_drag").on);
  EXPECT_THAT(Of("air_drag").reason, HasSubstr("1.2 % of the cloth's weight"));
  motion_.speed = 0;
  Set("effects.air_drag.wind = [0, 0, 2]");
  EXPECT_TRUE(Of("air_drag").on);
  Set("effects.air_drag.normal = 0\neffects.air_drag.tangential = 0");
  EXPECT_FALSE(Of("air_drag").on);
  Set("effects.air_drag.linear_normal = 0.5");
  EXPECT_TRUE(Of("air_drag").on);
}

TEST_F(DecideEffectsTest, AStrongerWindMattersLessToHeavierCloth) {
  motion_.speed = 0.3;
  EXPECT_TRUE(Of("air_drag").on);
  cloth_.density = 2;
  EXPECT_FALSE(Of("air_drag").on);
}

// It may slide off a body that hardly moves.
TEST_F(DecideEffectsTest, WithoutFrictionTheSpeedOfTheClothIsNotTheBodys) {
  motion_.speed = 0;
  EXPECT_FALSE(Of("air_drag").on);
  scene_.contact.friction = 0;
  EXPECT_TRUE(Of("air_drag").on);
  EXPECT_TRUE(Of("mass_damping").on);
  EXPECT_THAT(Of("air_drag").reason, HasSubstr("not known"));
}

TEST_F(DecideEffectsTest, MassDampingByWhatItTakesOfAFall) {
  EXPECT_TRUE(Of("mass_damping").on);  // 0.5 per s x 1 m/s: 5 % of gravity
  motion_.speed = 0.1;
  EXPECT_FALSE(Of("mass_damping").on);
  Set("effects.mass_damping.rate = 5");
  EXPECT_TRUE(Of("mass_damping").on);
  Set("effects.mass_damping.rate = 0");
  EXPECT_FALSE(Of("mass_damping").on);
}

TEST_F(DecideEffectsTest, InertiaByAccelerationOfMotionAndDressing) {
  Set("effects.mass_damping.rate = 50");  // loose cloth falls 1.6 mm a step
  EXPECT_TRUE(Of("inertia").on);
  motion_.acceleration = 0.05;
  EXPECT_FALSE(Of("inertia").on);
  motion_.speed = 1e-4;
  EXPECT_TRUE(Of("mass_damping").on);
  EXPECT_THAT(Of("mass_damping").reason, HasSubstr("in the place of inertia"));
  motion_.dressing_acceleration = 3;
  EXPECT_TRUE(Of("inertia").on);
  EXPECT_THAT(Of("inertia").reason, HasSubstr("dressing accelerates"));
}

TEST_F(DecideEffectsTest, InertiaStaysWhereNothingElseHoldsLooseCloth) {
  motion_.acceleration = 0;
  EXPECT_TRUE(Of("inertia").on);
  EXPECT_THAT(Of("inertia").reason, HasSubstr("nothing else holds"));
}

// B / (rho g l^3): 13 % at 3.4 cm, of which a tenth is left at a tenth of B.
TEST_F(DecideEffectsTest, BendingByBendingLengthOverEdge) {
  EXPECT_TRUE(Of("bending").on);
  cloth_.bending = IsotropicBending{1e-5 / 20};
  EXPECT_FALSE(Of("bending").on);
  sheet_ = SheetAboveBall(30, 0.3);
  EXPECT_TRUE(Of("bending").on);
  EXPECT_EQ(Of("measured_fabric").on, false);
}

TEST_F(DecideEffectsTest, StiffnessDampingUnlessTheStepDampsMore) {
  scene_.step.substeps = 4;  // 8.3 ms beside 1 ms
  EXPECT_FALSE(Of("stiffness_damping").on);
  scene_.step.substeps = 16;
  EXPECT_TRUE(Of("stiffness_damping").on);
  Set("effects.stiffness_damping.membrane = 0\n"
      "effects.stiffness_damping.bending = 0");
  EXPECT_FALSE(Of("stiffness_damping").on);
}

TEST_F(DecideEffectsTest, SelfContactOnlyIfLayersCanMeet) {
  EXPECT_FALSE(Of("self_contact").on);
  motion_.layers_can_meet = true;
  EXPECT_TRUE(Of("self_contact").on);
}

TEST_F(DecideEffectsTest, LayersAreAsThickAsTheThickerContact) {
  Set("contact.thickness = 0.002\neffects.self_contact.thickness = 0.001");
  EXPECT_EQ(LayerThickness(scene_), 0.002);
  Set("effects.self_contact.thickness = 0.004");
  EXPECT_EQ(LayerThickness(scene_), 0.004);
}

TEST_F(DecideEffectsTest, FrictionOnlyWhereThereIsAny) {
  scene_.contact.friction = 0.3;
  EXPECT_TRUE(Of("friction").on);
  scene_.contact.friction = 0;
  EXPECT_FALSE(Of("friction").on);
  EXPECT_THAT(On(), Not(Contains("friction")));
}

TEST_F(DecideEffectsTest, MeasuredFabricOnlyIfTheMaterialIsOne) {
  EXPECT_FALSE(Of("measured_fabric").on);
  cloth_.stretch = ExampleStretchTable();
  EXPECT_TRUE(Of("measured_fabric").on);
}

// Nothing to compare with: what has a force stays.
TEST_F(DecideEffectsTest, WithoutGravityNothingIsNegligible) {
  Set("effects.gravity.acceleration = [0, 0, 0]");
  motion_.speed = 0.01;
  EXPECT_FALSE(Of("gravity").on);
  EXPECT_TRUE(Of("air_drag").on);
  EXPECT_TRUE(Of("mass_damping").on);
  EXPECT_TRUE(Of("inertia").on);
}

TEST_F(DecideEffectsTest, WhatIsNotKnownOfTheMotionCountsAsLarge) {
  motion_ = SceneMotion();
  EXPECT_EQ(On(), Effects().names());
}

TEST_F(DecideEffectsTest, AListDecides) {
  scene_.effects = {"gravity", "inertia"};
  EXPECT_THAT(On(), testing::UnorderedElementsAre("gravity", "inertia"));
  EXPECT_EQ(Of("bending").reason, "not listed");
}

TEST_F(DecideEffectsTest, WhatIsDecidedIsWhatIsBuilt) {
  Set("scene.effects = 'auto'");
  motion_.speed = 0.1;
  scene_.decisions = DecideEffects(scene_, sheet_, cloth_, motion_);
  const SimulatorSetup setup = MakeSetup(scene_, BallBody(), sheet_, cloth_);
  std::vector<std::string> built;
  for (const auto& effect : setup.effects) built.push_back(effect->name());
  EXPECT_EQ(built, On());
  EXPECT_THAT(built, ElementsAre("inertia", "gravity", "membrane", "bending"));
}

TEST_F(DecideEffectsTest, AutoStandsAlone) {
  scene_.effects = {"gravity", "auto"};
  try {
    ChosenEffects(scene_, sheet_, cloth_);
    FAIL() << "accepted";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("'auto' stands alone"));
  }
}

}  // namespace
}  // namespace invsim
