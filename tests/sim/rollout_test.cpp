// SPDX-License-Identifier: Apache-2.0
#include "invsim/sim/rollout.h"

#include <gtest/gtest.h>

#include <csignal>
#include <limits>
#include <vector>

#include "invsim/sim/scene.h"
#include "sim/test_scene.h"

namespace invsim {
namespace {

// A sheet on the ball, which moves sideways at constant speed.
struct Moving {
  BodyModel body = BallBody();
  Garment sheet = SheetAboveBall(6, 0.3);
  SceneOptions options;
  double speed = 0.3;  // m/s

  Simulator Make() const {
    return Simulator(MakeSetup(options, body, sheet, PlainCloth()));
  }
  ClothState Start() const { return {sheet.placed, 0 * sheet.placed}; }
  Points At(int frame) const {
    BodyParameters p;
    p.translation.x() = speed * frame / 30.0;
    return body.Vertices(p);
  }
};

TEST(Rollout, GivesEveryFrameInOrderAndSumsThem) {
  const Moving scene;
  Simulator simulator = scene.Make();
  ClothState state = scene.Start();
  std::vector<int> frames;
  Points last;
  FrameStats sum;
  const RolloutResult result = SimulateSequence(
      &simulator,
      [&](int t) { return scene.At(t); },
      6,
      30.0,
      &state,
      [&](const SimulatedFrame& f) {
        frames.push_back(f.frame);
        EXPECT_EQ(f.body, scene.At(f.frame));
        if (f.frame == 0) {
          EXPECT_EQ(f.cloth.x, scene.sheet.placed);
        }
        last = f.cloth.x;
        sum.Add(f.stats);
      });
  EXPECT_EQ(result.status, RunStatus::kComplete);
  EXPECT_EQ(result.frames, 6);
  EXPECT_EQ(frames, (std::vector<int>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(state.x, last);
  EXPECT_EQ(result.stats.step.substeps, sum.step.substeps);
  EXPECT_GE(result.stats.step.substeps, 5 * scene.options.step.substeps);
  EXPECT_EQ(result.stats.step.missed, 0);
  // Every vertex looks for skin once a step, again where contacts came late.
  const long queries = result.stats.step.contact_queries;
  EXPECT_EQ(queries, sum.step.contact_queries);
  EXPECT_EQ(queries % scene.sheet.num_vertices(), 0);
  EXPECT_GE(queries,
            long{result.stats.step.substeps} * scene.sheet.num_vertices());
  EXPECT_LT(result.stats.penetration.deepest, 1e-3);
}

TEST(Rollout, IsTheSameAsAdvancingByHand) {
  const Moving scene;
  Simulator one = scene.Make(), other = scene.Make();
  ClothState state = scene.Start(), by_hand = scene.Start();
  SimulateSequence(
      &one, [&](int t) { return scene.At(t); }, 4, 30.0, &state);
  StepStats stats;
  for (int t = 1; t < 4; ++t) {
    other.FindInside(scene.At(t - 1), by_hand);
    ASSERT_TRUE(other.Advance(
        scene.At(t - 1), scene.At(t), 1 / 30.0, &by_hand, &stats));
  }
  // Up to rounding: sums of the linear algebra depend on where in memory it is.
  EXPECT_LT((state.x - by_hand.x).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_LT((state.v - by_hand.v).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(Rollout, WithoutContactTheSheetFallsFreely) {
  Moving scene;
  scene.sheet.placed.row(1).array() -= 1.0;  // below the ball
  Simulator simulator = scene.Make();
  ClothState state = scene.Start();
  SimulateSequence(
      &simulator, [&](int t) { return scene.At(t); }, 4, 30.0, &state);
  EXPECT_NEAR(MeanSpeed(state), 9.8 * 0.1, 1e-9);
  // n implicit Euler steps of h fall n (n + 1) / 2 g h^2.
  const int n = 3 * scene.options.step.substeps;
  const double h = 0.1 / n;
  const double fall = 0.5 * n * (n + 1) * 9.8 * h * h;
  const Points fallen = scene.sheet.placed - state.x;
  EXPECT_LT((fallen.row(1).array() - fall).abs().maxCoeff(), 1e-9);
}

TEST(Rollout, StopsAfterTheFrameInWhichItIsInterrupted) {
  const InterruptedTest guard;
  const Moving scene;
  Simulator simulator = scene.Make();
  ClothState state = scene.Start();
  Points last;
  const RolloutResult result = SimulateSequence(
      &simulator,
      [&](int t) { return scene.At(t); },
      6,
      30.0,
      &state,
      [&](const SimulatedFrame& f) {
        last = f.cloth.x;
        if (f.frame == 2) std::raise(SIGINT);
      });
  EXPECT_EQ(result.status, RunStatus::kInterrupted);
  EXPECT_EQ(result.frames, 3);
  EXPECT_EQ(state.x, last);
}

TEST(Rollout, KeepsTheLastGoodStateIfItFails) {
  const Moving scene;
  Simulator simulator = scene.Make();
  ClothState state = scene.Start();
  state.v(0, 0) = std::numeric_limits<double>::quiet_NaN();
  const RolloutResult result = SimulateSequence(
      &simulator, [&](int t) { return scene.At(t); }, 3, 30.0, &state);
  EXPECT_EQ(result.status, RunStatus::kFailed);
  EXPECT_EQ(result.frames, 1);
  EXPECT_GT(result.stats.step.failed, 0);
  EXPECT_EQ(state.x, scene.sheet.placed);
}

// A body that is nowhere is no reason to let the cloth fall through it.
TEST(Rollout, FailsInTheFrameWhoseBodyIsNotFinite) {
  const Moving scene;
  Simulator simulator = scene.Make();
  ClothState state = scene.Start();
  const RolloutResult result = SimulateSequence(
      &simulator,
      [&](int t) {
        Points body = scene.At(t);
        if (t == 2) body(1, 5) = std::numeric_limits<double>::quiet_NaN();
        return body;
      },
      4,
      30.0,
      &state);
  EXPECT_EQ(result.status, RunStatus::kFailed);
  EXPECT_EQ(result.frames, 2);
  EXPECT_EQ(result.stats.step.failures.at("the body is not finite"), 1);
  EXPECT_TRUE(state.x.allFinite());
}

TEST(FrameStats, AddKeepsTheWorstAndTheLast) {
  FrameStats sum, a, b;
  a.seconds = 1;
  a.penetration.deepest = 0.002;
  a.mean_speed = 0.4;
  b.seconds = 2;
  a.processor_seconds = 3;
  b.processor_seconds = 4;
  b.penetration.deepest = 0.001;
  b.mean_speed = 0.1;
  sum.Add(a);
  sum.Add(b);
  EXPECT_EQ(sum.seconds, 3);
  EXPECT_EQ(sum.processor_seconds, 7);
  EXPECT_EQ(sum.penetration.deepest, 0.002);
  EXPECT_EQ(sum.mean_speed, 0.1);
}

TEST(FrameStepper, MeasuresPenetration) {
  const Moving scene;
  Simulator simulator = scene.Make();
  ClothState state = scene.Start();
  state.x.row(1).array() -= 0.015;  // the middle is 1 cm inside
  FrameStepper stepper(&simulator, scene.At(0), state);
  const FrameStats now = stepper.Measure();
  EXPECT_GT(now.penetration.inside, 0);
  EXPECT_NEAR(now.penetration.deepest, 0.01, 0.002);
}

}  // namespace
}  // namespace invsim
