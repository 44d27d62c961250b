// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/optimizer_comparison.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

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

// A ball under a sheet, off to one side.
class CompareOptimizersTest : public ::testing::Test {
 protected:
  CompareOptimizersTest()
      : body_(BallBody()),
        garment_(SheetAboveBall(4, 0.2)),
        clouds_(3, garment_.placed) {
    options_.dressings = 1;
    observer_.relaxation = [this](const RelaxationFrame&) { ++dressed_; };
  }

  std::vector<ComparisonRun> Compare() {
    SceneOptions scene_options;
    scene_options.step.substeps = 1;
    Simulator simulator(
        MakeSetup(scene_options, body_, garment_, PlainCloth()));
    const FitScene scene{body_,
                         garment_,
                         [&](const BodySequence&) { return &simulator; },
                         clouds_,
                         30.0,
                         Standing(3, at_)};
    return CompareOptimizers(scene,
                             &options_,
                             {"lm", "dogleg"},
                             Standing(3, {0, 0, 0}),
                             observer_,
                             [&](const std::string& name) {
                               if (name == "lm") once_ = dressed_;
                             });
  }

  BodyModel body_;
  Garment garment_;
  std::vector<Points> clouds_;
  Vector3d at_ = {0.02, 0, 0};
  FitOptions options_;
  FitObserver observer_;
  int dressed_ = 0, once_ = 0;  // frames; in all, and before the first run
};

TEST_F(CompareOptimizersTest, StartsAllFromTheSame) {
  const std::vector<ComparisonRun> runs = Compare();
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_GT(once_, 0);
  EXPECT_EQ(dressed_, once_);
  for (const ComparisonRun& run : runs) {
    EXPECT_NEAR(run.points.front().body_error, 0.02, 1e-12);
    EXPECT_EQ(run.points.front().cost, runs[0].points.front().cost);
    EXPECT_LT(run.summary.final_cost, run.summary.initial_cost);
  }
}

// Whatever the way to the start takes.
TEST_F(CompareOptimizersTest, TheTimeLimitIsOfEachRunFromTheStartOn) {
  options_.time_limit = 1;
  observer_.relaxation = [this](const RelaxationFrame&) {
    if (dressed_++ == 0) std::this_thread::sleep_for(std::chrono::seconds(2));
  };
  const std::vector<ComparisonRun> runs = Compare();
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(options_.time_limit, 1);
  for (const ComparisonRun& run : runs) EXPECT_FALSE(run.points.empty());
}

TEST_F(CompareOptimizersTest, AllHaveFailedWhereNothingCanBeWorn) {
  at_.setConstant(1e200);
  const std::vector<ComparisonRun> runs = Compare();
  ASSERT_EQ(runs.size(), 2u);
  for (const ComparisonRun& run : runs) {
    EXPECT_EQ(run.summary.termination, Termination::kFailed);
    EXPECT_FALSE(run.summary.reason.empty());
    EXPECT_TRUE(run.points.empty());
  }
}

}  // namespace
}  // namespace invsim
