// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/cloth_rollout.h"

#include <gtest/gtest.h>

#include "dressed_mannequin.h"
#include "invsim/cloth/named_materials.h"
#include "invsim/sim/scene.h"

namespace invsim {
namespace {

class ClothRolloutTest : public ::testing::Test {
 protected:
  ClothRolloutTest() : person_(0.01), garment_(person_.MakeGarment()) {
    SceneOptions scene;
    scene.step.substeps = 1;
    simulator_ = std::make_unique<Simulator>(MakeSetup(
        scene, person_.body(), garment_, FindMaterial(scene.material)));
    reference_.body = person_.body().Vertices({});
    reference_.cloth.x = garment_.placed;
    reference_.cloth.v = Points::Zero(3, garment_.num_vertices());
  }

  ClothRollout Make() {
    return ClothRollout(simulator_.get(), reference_, 3, 30, {2, 2});
  }
  Points Body(int t) const {
    BodyParameters p;
    p.translation = Vector3d(0.01 * t + 0.01, 0, 0);
    return person_.body().Vertices(p);
  }

  DressedMannequin person_;
  Garment garment_;
  std::unique_ptr<Simulator> simulator_;
  ClothReference reference_;
};

TEST_F(ClothRolloutTest, FrameZeroIsLedThereAndAtRest) {
  ClothRollout rollout = Make();
  ASSERT_TRUE(rollout.Step(0, Body(0)));
  EXPECT_EQ(rollout.cloth(0).v, Points::Zero(3, garment_.num_vertices()));
  EXPECT_EQ(rollout.lead_records().size(), 4u);
  EXPECT_EQ(rollout.record(0).body1, Body(0));
  EXPECT_EQ(rollout.frames_simulated(), 4);
  // The cloth, a loose tube, was taken along.
  EXPECT_GT((rollout.cloth(0).x - garment_.placed).row(0).mean(), 3e-3);
}

// What was simulated before does not matter.
TEST_F(ClothRolloutTest, DependsOnTheBodiesAlone) {
  ClothRollout rollout = Make();
  for (int t = 0; t < 3; ++t) ASSERT_TRUE(rollout.Step(t, Body(t)));
  const std::vector<ClothState> first = rollout.cloth();
  for (int t = 0; t < 3; ++t) ASSERT_TRUE(rollout.Step(t, Body(2 * t)));
  EXPECT_NE(rollout.cloth(2).x, first[2].x);
  for (int t = 0; t < 3; ++t) ASSERT_TRUE(rollout.Step(t, Body(t)));
  for (int t = 0; t < 3; ++t) EXPECT_EQ(rollout.cloth(t).x, first[t].x) << t;
}

TEST_F(ClothRolloutTest, TellsOfEveryFrame) {
  ClothRollout rollout = Make();
  std::vector<int> seen;
  int steps = 0;
  rollout.set_on_frame([&](const SimulatedFrame& f) {
    seen.push_back(f.frame);
    EXPECT_EQ(f.body, Body(f.frame));
    EXPECT_EQ(f.cloth.x, rollout.cloth(f.frame).x);
    steps += f.stats.step.substeps;
    EXPECT_LT(f.stats.penetration.deepest, 1e-3);
  });
  for (int t = 0; t < 3; ++t) ASSERT_TRUE(rollout.Step(t, Body(t)));
  EXPECT_EQ(seen, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(rollout.stats().substeps, steps);
}

TEST_F(ClothRolloutTest, ANewReferenceIsWhereItIsLedFrom) {
  ClothRollout rollout = Make();
  ASSERT_TRUE(rollout.Step(0, Body(0)));
  rollout.set_reference({Body(0), rollout.cloth(0)});
  ASSERT_TRUE(rollout.Step(0, Body(2)));
  EXPECT_EQ(rollout.lead_records()[0].body0, Body(0));
}

}  // namespace
}  // namespace invsim
