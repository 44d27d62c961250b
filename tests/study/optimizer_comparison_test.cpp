// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/optimizer_comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "invsim/sim/scene.h"
#include "sim/test_scene.h"

namespace invsim {
namespace {

BodySequence Standing(int frames, const Vector3d& at) {
  BodySequence sequence;
  for (int t = 0; t < frames; ++t) {
    BodyParameters p;
    p.translation = at;
    sequence.Append(p);
  }
  return sequence;
}

TEST(BodyError, OfAShiftIsItsLength) {
  const BodyModel ball = BallBody();
  EXPECT_NEAR(
      BodyError(ball, Standing(3, {0, 0, 0}), Standing(3, {0.03, 0, 0.04})),
      0.05,
      1e-12);
  // Of frames that only one has nothing can be said.
  EXPECT_NEAR(
      BodyError(ball, Standing(2, {0, 0, 0}), Standing(5, {0, 0.01, 0})),
      0.01,
      1e-12);
}

ComparisonRun RunOf(const std::vector<ComparisonPoint>& points) {
  ComparisonRun run;
  run.points = points;
  return run;
}

TEST(ComparisonRun, IsMeasuredByTheBodyErrorIfItIsKnown) {
  const ComparisonRun run =
      RunOf({{0, 10, 0, 5, 0.09}, {1, 20, 1, 4, 0.03}, {2, 30, 2, 3, 0.04}});
  EXPECT_EQ(Best(run), 0.03);
  EXPECT_EQ(StepsToReach(run, 0.05), 20);
  EXPECT_EQ(StepsToReach(run, 0.09), 10);
  EXPECT_FALSE(StepsToReach(run, 0.02));
}

TEST(ComparisonRun, WithoutATruthTheCostIsTheMeasure) {
  const ComparisonRun run = RunOf({{0, 10, 0, 5}, {1, 20, 1, 3}});
  EXPECT_EQ(Best(run), 3);
  EXPECT_EQ(StepsToReach(run, 4), 20);
  EXPECT_TRUE(std::isinf(Best(RunOf({}))));
}

// All begin where the first did, with the cloth that it wore.
TEST(CompareOptimizers, StartsAllFromTheSame) {
  const BodyModel body = BallBody();
  const Garment garment = SheetAboveBall(4, 0.2);
  const std::vector<Points> clouds(3, garment.placed);
  SceneOptions scene_options;
  scene_options.step.substeps = 1;
  Simulator simulator(MakeSetup(scene_options, body, garment, PlainCloth()));
  int dressed = 0;
  FitObserver observer;
  observer.relaxation = [&](const RelaxationFrame&) { ++dressed; };
  FitOptions options;
  options.dressings = 1;
  FitScene scene{body,
                 garment,
                 [&](const BodySequence&) { return &simulator; },
                 clouds,
                 30.0,
                 Standing(3, {0.02, 0, 0})};
  int once = 0;
  const std::vector<ComparisonRun> runs =
      CompareOptimizers(scene,
                        &options,
                        {"lm", "dogleg"},
                        Standing(3, {0, 0, 0}),
                        observer,
                        [&](const std::string& name) {
                          if (name == "dogleg") once = dressed;
                        });
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_GT(once, 0);
  EXPECT_EQ(dressed, once);
  for (const ComparisonRun& run : runs) {
    EXPECT_NEAR(run.points.front().body_error, 0.02, 1e-12);
    EXPECT_EQ(run.points.front().cost, runs[0].points.front().cost);
    EXPECT_LT(run.summary.final_cost, run.summary.initial_cost);
  }
}

}  // namespace
}  // namespace invsim
