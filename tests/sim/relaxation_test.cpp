// SPDX-License-Identifier: Apache-2.0
#include "invsim/sim/relaxation.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <csignal>
#include <vector>

#include "invsim/body/rotation.h"
#include "invsim/sim/scene.h"
#include "sim/test_scene.h"

namespace invsim {
namespace {

// The ball stands far from where it was made, turned and a little swollen.
struct Scene {
  Scene() {
    motion.resize(2);
    motion[0].translation = Vector3d(5, 1, -3);
    motion[0].pose[1] = 2.5;
    motion[0].shape[0] = 0.5;
    motion[1] = motion[0];
    motion[1].translation.x() += 0.02;  // 0.6 m/s
    options.contact.friction = 1.0;
  }
  Simulator Make() const {
    return Simulator(MakeSetup(options, body, sheet, PlainCloth()));
  }
  RelaxationResult Run(const RelaxationOptions& relaxation,
                       Simulator* simulator,
                       const RelaxationCallback& callback = {},
                       const StopPredicate& stop = {}) const {
    return Relax(
        {body, sheet, motion, 30.0}, relaxation, simulator, callback, stop);
  }

  BodyModel body = BallBody();
  Garment sheet = SheetAboveBall(6, 0.25);
  SceneOptions options;
  std::vector<BodyParameters> motion;
};

TEST(Relaxation, BringsTheClothToRestOnTheFirstPose) {
  const Scene scene;
  Simulator simulator = scene.Make();
  Points last_body;
  std::vector<RelaxationPhase> phases;
  const RelaxationResult result =
      scene.Run({}, &simulator, [&](const RelaxationFrame& f) {
        last_body = f.body;
        if (phases.empty() || phases.back() != f.phase)
          phases.push_back(f.phase);
        EXPECT_LE(f.frame, f.most_frames);
      });
  EXPECT_EQ(result.status, RunStatus::kComplete);
  EXPECT_TRUE(result.at_rest);
  EXPECT_LT(MeanSpeed(result.cloth), 0.01);
  EXPECT_EQ(last_body, scene.body.Vertices(scene.motion[0]));
  EXPECT_THAT(phases,
              testing::ElementsAre(RelaxationPhase::kSettle,
                                   RelaxationPhase::kMove,
                                   RelaxationPhase::kHold));
  EXPECT_LT(result.stats.penetration.deepest, 1e-3);
  EXPECT_EQ(result.stats.step.missed, 0);
  // It rests on the ball, which now is where the first pose has it.
  const Vector3d middle = result.cloth.x.rowwise().mean();
  const Vector3d centre = scene.motion[0].translation;
  EXPECT_NEAR(middle.x(), centre.x(), 0.02);
  EXPECT_NEAR(middle.z(), centre.z(), 0.02);
  EXPECT_GT(middle.y(), centre.y());
}

TEST(Relaxation, DoesNotDependOnPlaceOrHeading) {
  Scene scene, elsewhere;
  elsewhere.motion[0].translation = elsewhere.motion[1].translation =
      Vector3d::Zero();
  elsewhere.motion[0].pose.setZero();
  elsewhere.motion[1].pose.setZero();
  Simulator a = scene.Make(), b = elsewhere.Make();
  RelaxationOptions brief;
  brief.settle_seconds = 0.1;
  brief.move_seconds = 0.1;
  brief.hold_seconds = 0;
  const ClothState at = scene.Run(brief, &a).cloth;
  const ClothState made = elsewhere.Run(brief, &b).cloth;
  const Points moved =
      (Exp({0, 2.5, 0}) * made.x).colwise() + scene.motion[0].translation;
  // Up to the tolerance of the contact solve.
  EXPECT_LT((at.x - moved).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(Relaxation, LeadsInWithTheVelocityOfTheMotion) {
  const Scene scene;
  Simulator simulator = scene.Make();
  RelaxationOptions options;
  options.settle_seconds = 0.1;
  options.move_seconds = 0.2;
  options.lead_in_seconds = 0.5;
  std::vector<Points> bodies;
  const RelaxationResult result =
      scene.Run(options, &simulator, [&](const RelaxationFrame& f) {
        bodies.push_back(f.body);
      });
  EXPECT_EQ(result.phase, RelaxationPhase::kLeadIn);
  const Points first = scene.body.Vertices(scene.motion[0]);
  EXPECT_LT((bodies.back() - first).cwiseAbs().maxCoeff(), 1e-12);
  // The last frame before has 0.6 m/s less half a frame of acceleration.
  const Vector3d last_move =
      30.0 * (bodies.back() - bodies[bodies.size() - 2]).col(0);
  EXPECT_NEAR(last_move.x(), 0.6 - 0.6 / 0.5 * 0.5 / 30, 1e-9);
  // Friction takes the cloth along.
  EXPECT_NEAR(result.cloth.v.row(0).mean(), 0.6, 0.1);
}

TEST(Relaxation, TakesStepsOfItsOwnLength) {
  RelaxationOptions brief;
  brief.settle_seconds = 0.2;
  brief.move_seconds = 0.2;
  brief.hold_seconds = 0;
  brief.steps_per_second = 60;
  for (const int substeps : {1, 2, 4}) {
    Scene scene;
    scene.options.step.substeps = substeps;
    Simulator simulator = scene.Make();
    const RelaxationResult result = scene.Run(brief, &simulator);
    EXPECT_EQ(result.frames, 24 / substeps);
    // A halving makes one more.
    EXPECT_EQ(result.stats.step.substeps - result.stats.step.halved, 24);
  }
}

TEST(Relaxation, SaysSoIfItIsNotAtRestInTime) {
  const Scene scene;
  Simulator simulator = scene.Make();
  RelaxationOptions hasty;
  hasty.settle_seconds = 0;
  hasty.move_seconds = 0.1;
  hasty.hold_seconds = 0.04;
  hasty.damping = 0;
  const RelaxationResult result = scene.Run(hasty, &simulator);
  EXPECT_EQ(result.status, RunStatus::kComplete);
  EXPECT_FALSE(result.at_rest);
  EXPECT_GT(result.rest_speed, 0.01);
}

TEST(Relaxation, StopsWhenInterrupted) {
  const InterruptedTest guard;
  const Scene scene;
  Simulator simulator = scene.Make();
  const RelaxationResult result =
      scene.Run({}, &simulator, [](const RelaxationFrame& f) {
        if (f.frame == 3) std::raise(SIGINT);
      });
  EXPECT_EQ(result.status, RunStatus::kInterrupted);
  EXPECT_EQ(result.frames, 3);
  EXPECT_EQ(result.phase, RelaxationPhase::kSettle);
}

TEST(Relaxation, StopsWhenAsked) {
  const Scene scene;
  Simulator simulator = scene.Make();
  int asked = 0;
  const RelaxationResult result =
      scene.Run({}, &simulator, {}, [&] { return ++asked > 3; });
  EXPECT_EQ(result.status, RunStatus::kInterrupted);
  EXPECT_EQ(result.frames, 3);
}

TEST(Relaxation, HasOptionsAndPhaseNames) {
  RelaxationOptions options;
  OptionTable table;
  table.AddSection("relaxation", &options);
  table.Read(Config::FromText("relaxation.lead_in_seconds = 0.25", "t"));
  EXPECT_EQ(options.lead_in_seconds, 0.25);
  EXPECT_STREQ(PhaseName(RelaxationPhase::kLeadIn), "lead in");
}

}  // namespace
}  // namespace invsim
