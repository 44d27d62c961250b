// SPDX-License-Identifier: Apache-2.0
// What Ceres's optimisers do beyond what every optimiser does, for which see
// optimizer_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "invsim/base/config.h"
#include "invsim/base/error.h"
#include "invsim/base/options.h"
#include "invsim/fit/optimizer.h"
#include "toy_term.h"

namespace invsim {
namespace {

// All unknowns alike.
BodySequence CeresSequence(int frames, double value) {
  BodySequence x;
  x.shape.setConstant(value);
  for (int t = 0; t < frames; ++t)
    x.Append({x.shape, PoseVector::Constant(value), Vector3d::Constant(value)});
  return x;
}

double LargestDifference(const BodySequence& a, const BodySequence& b) {
  double largest = (a.shape - b.shape).cwiseAbs().maxCoeff();
  for (int t = 0; t < a.num_frames(); ++t)
    largest = std::max(
        {largest,
         (a.poses[t] - b.poses[t]).cwiseAbs().maxCoeff(),
         (a.translations[t] - b.translations[t]).cwiseAbs().maxCoeff()});
  return largest;
}

double Moved(const BodySequence& a, const BodySequence& b) {
  double sum = (a.shape - b.shape).squaredNorm();
  for (int t = 0; t < a.num_frames(); ++t)
    sum += (a.poses[t] - b.poses[t]).squaredNorm() +
           (a.translations[t] - b.translations[t]).squaredNorm();
  return std::sqrt(sum);
}

// Its residuals lead uphill, as those of a rough cost may: no step helps.
class UphillTerm : public ToyTerm {
 public:
  using ToyTerm::ToyTerm;
  bool Linearize(std::vector<FrameBlock>* blocks) override {
    if (!ToyTerm::Linearize(blocks)) return false;
    for (FrameBlock& block : *blocks) block.residual *= -1;
    return true;
  }
};

// Its derivative is a quarter of the true one: full steps go four times too
// far, past the minimum and up on the other side.
class OvershootingTerm : public ToyTerm {
 public:
  using ToyTerm::ToyTerm;
  bool Linearize(std::vector<FrameBlock>* blocks) override {
    if (!ToyTerm::Linearize(blocks)) return false;
    for (FrameBlock& block : *blocks) block.jacobian *= 0.25;
    return true;
  }
};

// Beside what the body can do there is a cost that always stays.
class FlooredTerm : public ToyTerm {
 public:
  using ToyTerm::ToyTerm;
  Evaluation Evaluate(const BodySequence& x,
                      double cost_limit,
                      std::vector<double>* costs) override {
    const Evaluation outcome =
        ToyTerm::Evaluate(x, cost_limit - kFloor * num_frames(), costs);
    for (double& cost : *costs) cost += kFloor;
    return outcome;
  }
  bool Linearize(std::vector<FrameBlock>* blocks) override {
    const bool done = ToyTerm::Linearize(blocks);
    for (FrameBlock& block : *blocks) block.cost += kFloor;
    return done;
  }

  static constexpr double kFloor = 100;
};

// Every second evaluation, which is never that of the start, has no result.
class EverySecondTerm : public ToyTerm {
 public:
  EverySecondTerm(BodySequence truth, Evaluation outcome)
      : ToyTerm(std::move(truth)), outcome_(outcome) {}
  Evaluation Evaluate(const BodySequence& x,
                      double cost_limit,
                      std::vector<double>* costs) override {
    const Evaluation outcome = ToyTerm::Evaluate(x, cost_limit, costs);
    return evaluations % 2 == 0 ? outcome_ : outcome;
  }

 private:
  Evaluation outcome_;
};

// A record with the point kept after it.
struct CeresStep {
  IterationRecord record;
  BodySequence x;
};

class CeresTest : public ::testing::TestWithParam<std::string> {
 protected:
  CeresTest() { options_.function_tolerance = 1e-14; }

  static std::unique_ptr<Optimizer> Make(const std::string& name,
                                         const TrustRegionOptions& options) {
    if (name == "lm") return MakeLevenbergMarquardt(options);
    if (name == "dogleg") return MakeDogleg(options);
    return MakeLbfgs(options);
  }
  PriorOptions WithoutPriors() const {
    PriorOptions priors;
    priors.smoothness = priors.shape = priors.pose = 0;
    return priors;
  }
  // From x_ on; `steps_` are those it took.
  OptimizerSummary Minimize(const std::string& name,
                            DataTerm* term,
                            int last_iteration = 1000) {
    Objective objective(priors_, free_, term, &x_, ToyBody());
    steps_.clear();
    return Make(name, options_)
        ->Run(&objective, [&](const IterationRecord& record) {
          steps_.push_back({record, *objective.x()});
          return record.iteration < last_iteration;
        });
  }

  TrustRegionOptions options_;
  PriorOptions priors_ = WithoutPriors();
  FreeParameters free_;
  BodySequence x_ = CeresSequence(1, 0);
  std::vector<CeresStep> steps_;
};

class EveryCeresOptimizer : public CeresTest {};
class EveryTrustRegion : public CeresTest {};

INSTANTIATE_TEST_SUITE_P(Ceres,
                         EveryCeresOptimizer,
                         ::testing::Values("lm", "dogleg", "lbfgs"));
INSTANTIATE_TEST_SUITE_P(Ceres,
                         EveryTrustRegion,
                         ::testing::Values("lm", "dogleg"));

// In a trust region as good as endless: x - r / r', for every unknown alone.
TEST_P(EveryTrustRegion, TheFirstStepIsThatOfGaussAndNewton) {
  options_.radius = 1e15;
  ToyTerm term(CeresSequence(1, 0.3));
  Minimize(GetParam(), &term, 1);
  const double d = -0.3;
  const double step = -(d + 0.1 * std::sin(d)) / (1 + 0.1 * std::cos(d));
  ASSERT_EQ(steps_.size(), 2u);
  EXPECT_LT(LargestDifference(steps_[1].x, CeresSequence(1, step)), 1e-6);
}

// J^T J + diag(J^T J) / radius: of radius one it is half a step.
TEST_F(CeresTest, ASmallRadiusShortensTheStepsOfLevenbergAndMarquardt) {
  ToyTerm term(CeresSequence(1, 0.3));
  options_.radius = 1;
  Minimize("lm", &term, 1);
  const double d = -0.3;
  const double step = -(d + 0.1 * std::sin(d)) / (1 + 0.1 * std::cos(d));
  EXPECT_LT(LargestDifference(steps_[1].x, CeresSequence(1, step / 2)), 1e-12);
}

// Few frames are solved densely and many sparsely. Frames that are all alike
// go the way of one; the shape, which would tie them together, is held.
TEST_P(EveryCeresOptimizer, ManyFramesGoTheWayOfOne) {
  free_.shape = false;
  ToyTerm one(CeresSequence(1, 0.3));
  Minimize(GetParam(), &one, 3);
  const std::vector<CeresStep> alone = steps_;
  ASSERT_GT(alone.size(), 2u);
  for (const int frames : {2, 3, 5}) {
    x_ = CeresSequence(frames, 0);
    ToyTerm many(CeresSequence(frames, 0.3));
    Minimize(GetParam(), &many, 3);
    ASSERT_EQ(steps_.size(), alone.size());
    for (size_t k = 0; k < alone.size(); ++k) {
      const double cost = frames * alone[k].record.cost;
      EXPECT_NEAR(steps_[k].record.cost, cost, 1e-6 * (1e-6 + cost));
      for (int t = 0; t < frames; ++t)
        EXPECT_LT((steps_[k].x.poses[t] - alone[k].x.poses[0]).norm(), 1e-9);
    }
  }
}

// The number beside the point is the cost of that point, and so are its terms
// and its gradient.
TEST_P(EveryCeresOptimizer, RecordsBelongToThePointKept) {
  priors_ = PriorOptions();
  x_ = CeresSequence(4, 0);
  BodySequence truth = CeresSequence(4, 0.3);
  truth.translations[1] = Vector3d(0.5, 0, -0.2);
  truth.poses[2].setConstant(-0.2);
  ToyTerm term(truth);
  Minimize(GetParam(), &term, 8);
  ASSERT_GT(steps_.size(), 3u);
  for (CeresStep& step : steps_) {
    const IterationRecord& record = step.record;
    ToyTerm same(truth);
    Objective objective(priors_, free_, &same, &step.x, ToyBody());
    double cost = 0;
    std::vector<double> gradient;
    ASSERT_TRUE(objective.Evaluate(&cost, &gradient));
    EXPECT_NEAR(record.cost, cost, 1e-9 * cost);
    EXPECT_NEAR(record.terms.total(), cost, 1e-9 * cost) << record.iteration;
    const CostTerms terms = objective.terms();
    EXPECT_NEAR(record.terms.data, terms.data, 1e-9 * cost);
    EXPECT_NEAR(record.terms.smoothness, terms.smoothness, 1e-9 * cost);
    double largest = 0;
    for (const double g : gradient) largest = std::max(largest, std::abs(g));
    EXPECT_NEAR(record.gradient_norm, largest, 1e-9 * (1 + largest));
  }
}

TEST_P(EveryCeresOptimizer, RecordsTellHowFarAndAfterHowMuch) {
  x_ = CeresSequence(3, 0);
  ToyTerm term(CeresSequence(3, 0.3));
  const OptimizerSummary summary = Minimize(GetParam(), &term);
  ASSERT_EQ(summary.iterations.size(), steps_.size());
  EXPECT_EQ(steps_[0].record.step_norm, 0);
  EXPECT_EQ(steps_[0].record.counts.evaluations, 1);
  for (size_t k = 1; k < steps_.size(); ++k) {
    const IterationRecord &now = steps_[k].record, &last = steps_[k - 1].record;
    EXPECT_EQ(now.iteration, static_cast<int>(k));
    EXPECT_GE(now.seconds, last.seconds);
    EXPECT_GT(now.counts.evaluations, last.counts.evaluations);
    const double moved = Moved(steps_[k].x, steps_[k - 1].x);
    ASSERT_TRUE(now.successful);
    EXPECT_NEAR(now.step_norm, moved, 1e-6 * moved + 1e-12);
  }
  EXPECT_EQ(summary.counts.evaluations, term.evaluations);
}

TEST_P(EveryCeresOptimizer, AnInterruptLeavesThePointKept) {
  ToyTerm term(CeresSequence(1, 0.3));
  options_.radius = 1;  // in several steps
  const OptimizerSummary summary = Minimize(GetParam(), &term, 2);
  EXPECT_EQ(summary.termination, Termination::kInterrupted);
  ASSERT_EQ(steps_.size(), 3u);
  EXPECT_EQ(Moved(x_, steps_[2].x), 0);
  EXPECT_EQ(summary.final_cost, steps_[2].record.cost);
  EXPECT_LT(summary.final_cost, summary.initial_cost);
}

TEST_P(EveryCeresOptimizer, NoIterationIsTheStart) {
  ToyTerm term(CeresSequence(1, 0.3));
  options_.iterations = 0;
  const OptimizerSummary summary = Minimize(GetParam(), &term);
  EXPECT_EQ(summary.termination, Termination::kIterationLimit);
  EXPECT_EQ(summary.final_cost, summary.initial_cost);
  EXPECT_EQ(steps_.size(), 1u);
  EXPECT_EQ(Moved(x_, CeresSequence(1, 0)), 0);
}

TEST_P(EveryCeresOptimizer, StaysAtAMinimum) {
  x_ = CeresSequence(1, 0.3);
  ToyTerm term(CeresSequence(1, 0.3));
  const OptimizerSummary summary = Minimize(GetParam(), &term);
  EXPECT_EQ(summary.termination, Termination::kConverged);
  EXPECT_LE(steps_.size(), 1u);
  EXPECT_EQ(Moved(x_, CeresSequence(1, 0.3)), 0);
}

TEST_P(EveryCeresOptimizer, WhatIsHeldStays) {
  free_.shape = false;
  for (int j = 0; j < kNumJoints; ++j) free_.joints[j] = j % 3 == 1;
  ToyTerm term(CeresSequence(1, 0.3));
  Minimize(GetParam(), &term);
  EXPECT_EQ(x_.shape, CeresSequence(1, 0).shape);
  for (int i = 0; i < kNumPose; ++i) {
    const bool moves = i / 3 % 3 == 1;
    EXPECT_NEAR(x_.poses[0][i], moves ? 0.3 : 0, moves ? 1e-4 : 0);
  }
  EXPECT_NEAR(x_.translations[0][2], 0.3, 1e-4);
}

// Nothing but the start can be evaluated. What was tried is taken back.
TEST_P(EveryCeresOptimizer, StaysAtTheStartIfNoStepCanBeEvaluated) {
  ToyTerm term(CeresSequence(1, 0.3));
  term.wall = 0;
  const OptimizerSummary summary = Minimize(GetParam(), &term);
  EXPECT_EQ(summary.termination, Termination::kStalled);
  EXPECT_EQ(summary.reason, "The last steps could not be evaluated.");
  EXPECT_EQ(summary.final_cost, summary.initial_cost);
  EXPECT_GT(summary.counts.failed, 0);
  EXPECT_EQ(Moved(x_, CeresSequence(1, 0)), 0);
}

// Failures on the way, after which it went on, are counted and no stall.
TEST_P(EveryTrustRegion, FailuresThatWereOvercomeAreNoStall) {
  EverySecondTerm term(CeresSequence(1, 0.3), Evaluation::kFailed);
  options_.function_tolerance = 0;
  options_.parameter_tolerance = 0;
  options_.gradient_tolerance = 1e-3;  // after a step that went well
  const OptimizerSummary summary = Minimize(GetParam(), &term);
  EXPECT_EQ(summary.termination, Termination::kConverged) << summary.reason;
  EXPECT_GT(summary.counts.failed, 0);
  EXPECT_EQ(summary.counts.failed, term.evaluations / 2);
  EXPECT_LT(LargestDifference(x_, CeresSequence(1, 0.3)), 1e-4);
}

// At the end of the iterations a step that was too long says nothing about
// those that would have followed.
TEST_P(EveryTrustRegion, ALastStepThatFailedIsNoStall) {
  options_.refused_steps = 0;
  for (const int iterations : {1, 1000}) {
    x_ = CeresSequence(1, 0);
    options_.iterations = iterations;
    OvershootingTerm term(CeresSequence(1, 0.3));
    term.wall = 0.5;  // of the first step, to 1.2
    const OptimizerSummary summary = Minimize(GetParam(), &term);
    EXPECT_GT(summary.counts.failed, 0);
    EXPECT_EQ(summary.termination,
              iterations == 1 ? Termination::kIterationLimit
                              : Termination::kConverged);
    if (iterations > 1)
      EXPECT_LT(summary.final_cost, 0.1 * summary.initial_cost);
    else
      EXPECT_EQ(summary.final_cost, summary.initial_cost);
  }
}

// On a cost that is rough every step is a whole simulation that helps nothing.
TEST_P(EveryTrustRegion, GivesUpAfterStepsThatDoNotHelp) {
  for (const int most : {1, 4}) {
    x_ = CeresSequence(1, 0);
    options_.refused_steps = most;
    UphillTerm term(CeresSequence(1, 0.3));
    const OptimizerSummary summary = Minimize(GetParam(), &term);
    EXPECT_EQ(summary.termination, Termination::kConverged);
    EXPECT_EQ(summary.reason,
              std::to_string(most) + " steps in a row did not lower the cost.");
    ASSERT_EQ(steps_.size(), most + 1u);
    for (int k = 1; k <= most; ++k) {
      EXPECT_FALSE(steps_[k].record.successful);
      // Of the point kept, not of the one tried.
      EXPECT_EQ(steps_[k].record.cost, summary.initial_cost);
      EXPECT_EQ(Moved(steps_[k].x, CeresSequence(1, 0)), 0);
      EXPECT_EQ(steps_[k].record.terms.data, steps_[0].record.terms.data);
    }
    EXPECT_EQ(summary.final_cost, summary.initial_cost);
    EXPECT_EQ(summary.counts.abandoned, most);
    EXPECT_EQ(summary.counts.failed, 0);
    EXPECT_EQ(Moved(x_, CeresSequence(1, 0)), 0);
  }
}

TEST_P(EveryTrustRegion, GoesOnWithoutALimitOfRefusedSteps) {
  options_.refused_steps = 0;
  options_.iterations = 12;
  UphillTerm term(CeresSequence(1, 0.3));
  const OptimizerSummary summary = Minimize(GetParam(), &term);
  EXPECT_EQ(summary.termination, Termination::kIterationLimit);
  EXPECT_EQ(steps_.size(), 13u);
}

// Refused ones count in a row: one that helps begins anew.
TEST_P(EveryTrustRegion, AStepThatHelpsForgivesThoseBefore) {
  options_.refused_steps = 2;
  options_.radius = 0.1;  // in many small steps
  EverySecondTerm term(CeresSequence(1, 0.3), Evaluation::kAbandoned);
  Minimize(GetParam(), &term);
  const auto refused =
      std::count_if(steps_.begin(), steps_.end(), [](const CeresStep& s) {
        return !s.record.successful;
      });
  EXPECT_GE(refused, 4);
  EXPECT_LT(LargestDifference(x_, CeresSequence(1, 0.3)), 1e-3);
}

// A trial that is worse needs no exact cost; a line search does.
TEST_P(EveryCeresOptimizer, OnlyATrustRegionGivesUpTrials) {
  OvershootingTerm term(CeresSequence(1, 0.3));
  options_.refused_steps = 0;  // until the trust region is small enough
  const OptimizerSummary summary = Minimize(GetParam(), &term);
  EXPECT_LT(summary.final_cost, 0.1 * summary.initial_cost);
  if (GetParam() == "lbfgs")
    EXPECT_EQ(summary.counts.abandoned, 0);
  else
    EXPECT_GT(summary.counts.abandoned, 0);
}

// What is asked of the objective later may cost anything.
TEST_P(EveryCeresOptimizer, LeavesNoLimitBehind) {
  ToyTerm term(CeresSequence(1, 0.3));
  Objective objective(priors_, free_, &term, &x_, ToyBody());
  const OptimizerSummary summary =
      Make(GetParam(), options_)->Run(&objective, {});
  x_.shape.setConstant(-7);
  double cost = 0;
  ASSERT_TRUE(objective.Evaluate(&cost, nullptr));
  EXPECT_GT(cost, summary.initial_cost);
  EXPECT_EQ(objective.counts().abandoned, summary.counts.abandoned);
}

// A step that lowers the cost by less than the tolerance is the last.
TEST_P(EveryCeresOptimizer, ATighterToleranceGoesFurther) {
  double loose = 0;
  for (const double tolerance : {0.2, 1e-14}) {
    x_ = CeresSequence(1, 0);
    options_.radius = 1;
    options_.function_tolerance = tolerance;
    FlooredTerm term(CeresSequence(1, 0.3));
    const OptimizerSummary summary = Minimize(GetParam(), &term);
    EXPECT_EQ(summary.termination, Termination::kConverged);
    const double above = summary.final_cost - FlooredTerm::kFloor;
    if (tolerance == 0.2)
      loose = above;
    else
      EXPECT_LT(above, 1e-3 * loose);
  }
}

TEST(CeresOptionsTable, NamesAndBoundsThem) {
  TrustRegionOptions options;
  OptionTable table;
  Describe(&table, &options);
  const auto read = [&](const std::string& text) {
    table.Read(Config::FromText(text, "f.toml"));
  };
  read(
      "iterations = 7\nfunction_tolerance = 1e-3\nparameter_tolerance = 1e-4\n"
      "gradient_tolerance = 1e-5\nrefused_steps = 2\nradius = 9.0\n");
  EXPECT_EQ(options.iterations, 7);
  EXPECT_EQ(options.function_tolerance, 1e-3);
  EXPECT_EQ(options.parameter_tolerance, 1e-4);
  EXPECT_EQ(options.gradient_tolerance, 1e-5);
  EXPECT_EQ(options.refused_steps, 2);
  EXPECT_EQ(options.radius, 9);
  for (const char* bad : {"iterations = -1",
                          "function_tolerance = -1e-3",
                          "refused_steps = -1",
                          "radius = 0.0"})
    EXPECT_THROW(read(bad), UsageError) << bad;
}

// What L-BFGS would not heed it does not take either.
TEST(CeresOptionsTable, OfALineSearchHasNothingOfATrustRegion) {
  OptionTable table;
  const auto choice = Optimizers().Choose("lbfgs");
  choice->AddOptions(&table);
  EXPECT_NO_THROW(table.Read(Config::FromText("iterations = 7\n", "f.toml")));
  for (const char* text : {"refused_steps = 2\n", "radius = 9.0\n"})
    EXPECT_THROW(table.Read(Config::FromText(text, "f.toml")), UsageError);
}

}  // namespace
}  // namespace invsim
