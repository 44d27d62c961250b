// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/hard_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <set>

#include "test_name.h"

namespace invsim {

void PrintTo(const HardCase& hard, std::ostream* out) { *out << hard.name; }

namespace {

class HardSceneTest : public testing::TestWithParam<HardCase> {};

TEST_P(HardSceneTest, Holds) {
  const HardCase& hard = GetParam();
  const HardOutcome outcome = RunHardCase(hard);
  EXPECT_EQ(outcome.refused, hard.refused) << outcome.refusal;
  if (hard.border.empty()) {
    for (const Breach& broken : outcome.broken)
      ADD_FAILURE() << hard.name << ": " << broken.text;
    return;
  }
  // Beyond a known border there are limits, too.
  for (const Breach& broken : outcome.beyond)
    ADD_FAILURE() << hard.name << ", beyond its border: " << broken.text;
  EXPECT_FALSE(outcome.broken.empty()) << "the border is no more: remove it";
  EXPECT_TRUE(std::isfinite(outcome.speed));
}

INSTANTIATE_TEST_SUITE_P(Gallery,
                         HardSceneTest,
                         testing::ValuesIn(HardCases()),
                         TestName<HardCase>);

TEST(HardCases, NamesAreUnique) {
  std::set<std::string> names;
  for (const HardCase& hard : HardCases())
    EXPECT_TRUE(names.insert(hard.name).second) << hard.name;
}

// The measures themselves can fail: a scene that breaks each limit is caught.

HardScene Scene(const char* name) {
  for (const HardCase& hard : HardCases())
    if (hard.name == name) return hard.make();
  throw std::logic_error(name);
}

TEST(RunHardScene, SeesPenetration) {
  HardScene scene = Scene("contact/start_inside");
  scene.grace = 0;
  scene.frames = 1;
  const HardOutcome outcome = RunHardScene(scene, false);
  EXPECT_GT(outcome.penetration, 1e-3);
  ASSERT_EQ(outcome.broken.size(), 1u);
  EXPECT_EQ(outcome.broken[0].limit, "penetration");
}

TEST(RunHardScene, SeesStepsThatMissTheTolerance) {
  HardScene scene = Scene("contact/mu_1");
  scene.frames = 10;
  scene.options.step.friction.admm_iterations = 1;
  scene.options.step.friction.newton_iterations = 1;
  scene.options.step.friction.retries = 0;
  scene.options.step.max_halvings = 0;
  const HardOutcome outcome = RunHardScene(scene, false);
  EXPECT_GT(outcome.step.missed, 0);
  EXPECT_FALSE(outcome.broken.empty());
}

TEST(RunHardScene, SeesEnergyFromNowhere) {
  // The wind drags the cloth along without being a body.
  HardScene scene = Scene("material/undamped");
  scene.frames = 20;
  scene.options.effects.push_back("air_drag");
  OptionTable table;
  Describe(&table, &scene.options);
  Config config;
  config.Set("effects.air_drag.wind", "[0, 0, 20]", "test");
  table.Read(config);
  const HardOutcome outcome = RunHardScene(scene, false);
  EXPECT_GT(outcome.energy, 0.1);
  EXPECT_FALSE(outcome.broken.empty());
}

// What falling cloth loses is no room for what a wind gives it afterwards.
TEST(RunHardScene, SeesEnergyGainedAfterALoss) {
  HardScene scene = Scene("contact/all_in_contact");
  scene.frames = 40;
  scene.garment.placed.row(1).array() += 0.1;
  EXPECT_LT(RunHardScene(scene, false).energy, scene.limits.energy);
  scene.options.effects.push_back("air_drag");
  OptionTable table;
  Describe(&table, &scene.options);
  Config config;
  config.Set("effects.air_drag.wind", "[5, 0, 0]", "test");
  config.Set("contact.friction", "0", "test");
  table.Read(config);
  const HardOutcome outcome = RunHardScene(scene, false);
  EXPECT_GT(outcome.energy, scene.limits.energy);
}

// Without self-contact layers thrown at each other go through each other,
// which is no breach there; with it they do not.
TEST(RunHardScene, SeesLayersThatCross) {
  HardScene scene = Scene("contact/layers");
  scene.frames = 5;
  EXPECT_EQ(RunHardScene(scene, false).crossings, 0);
  std::erase(scene.options.effects, "self_contact");
  const int n = scene.garment.num_vertices();
  scene.start = {scene.garment.placed, Points::Zero(3, n)};
  for (int i = 0; i < n / 2; ++i)  // the lower one, in part
    scene.start.v(1, i) = i % 3 == 0 ? 2 : 0;
  const HardOutcome outcome = RunHardScene(scene, false);
  EXPECT_GT(outcome.crossings, 0);
  EXPECT_TRUE(outcome.broken.empty());
}

// Of cloth that does not come near the body there is nothing to compare.
TEST(RunHardScene, SeesThatNoDerivativeWasCompared) {
  HardScene scene = Scene("contact/mu_1");
  scene.frames = 4;
  scene.garment.placed.row(1).array() += 1;
  scene.limits.contacts = 0;
  const HardOutcome outcome = RunHardScene(scene);
  EXPECT_EQ(outcome.columns, 0);
  ASSERT_EQ(outcome.broken.size(), 1u);
  EXPECT_EQ(outcome.broken[0].limit, "derivative");
}

TEST(RunHardScene, SeesThatNothingWasTouched) {
  HardScene scene = Scene("contact/mu_1");
  scene.frames = 4;
  scene.garment.placed.row(1).array() += 1;
  const HardOutcome outcome = RunHardScene(scene, false);
  ASSERT_EQ(outcome.broken.size(), 1u);
  EXPECT_EQ(outcome.broken[0].limit, "contacts");
}

TEST(RunHardScene, SeesThatTheSceneDidNotComeToItsPoint) {
  HardScene scene = Scene("contact/stick_slip");
  scene.options.contact.friction = 5;  // it only sticks
  const HardOutcome outcome = RunHardScene(scene, false);
  ASSERT_EQ(outcome.broken.size(), 1u);
  EXPECT_EQ(outcome.broken[0].limit, "check");
}

TEST(RunHardScene, SeesCreep) {
  HardScene scene = Scene("contact/resting");
  scene.options.contact.friction = 0.1;
  scene.frames = 20;
  const HardOutcome outcome = RunHardScene(scene, false);
  EXPECT_GT(outcome.creep, 1e-3);
  EXPECT_FALSE(outcome.broken.empty());
}

TEST(RunHardScene, SeesVerticesOnTheWrongSide) {
  HardScene scene = Scene("contact/tunnelling");
  scene.body.faces.resize(3, 0);
  const HardOutcome outcome = RunHardScene(scene, false);
  EXPECT_EQ(outcome.misplaced, scene.garment.num_vertices());
}

}  // namespace
}  // namespace invsim
