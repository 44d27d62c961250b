// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/optimizer.h"

#include <gtest/gtest.h>

#include "toy_term.h"

namespace invsim {
namespace {

BodySequence Truth(int frames) {
  BodySequence x;
  x.shape.setConstant(0.2);
  for (int t = 0; t < frames; ++t) {
    BodyParameters p;
    p.pose.setConstant(0.1);
    p.translation = Vector3d(1, 0.5, 0);
    x.Append(p);
  }
  return x;
}

BodySequence Start(int frames) {
  BodySequence x;
  for (int t = 0; t < frames; ++t) x.Append({});
  return x;
}

PriorOptions NoPriors() {
  PriorOptions priors;
  priors.smoothness = priors.shape = priors.pose = 0;
  return priors;
}

std::unique_ptr<Optimizer> Make(const std::string& name,
                                const std::string& settings) {
  const auto choice = Optimizers().Choose(name);
  OptionTable table;
  choice->AddOptions(&table);
  table.Read(Config::FromText(settings, "test"));
  return choice->Make();
}

class EveryOptimizer : public ::testing::TestWithParam<std::string> {
 protected:
  std::string Settings() const {
    return GetParam() == "gradient_descent"
               ? "step = 1e-3\nfunction_tolerance = 1e-14\n"
               : "function_tolerance = 1e-14\n";
  }
};

TEST_P(EveryOptimizer, FindsTheMinimum) {
  ToyTerm term(Truth(3));
  BodySequence x = Start(3);
  Objective objective(NoPriors(), {}, &term, &x, ToyBody());
  int seen = 0;
  const OptimizerSummary summary =
      Make(GetParam(), Settings())
          ->Run(&objective, [&](const IterationRecord&) {
            ++seen;
            return true;
          });
  EXPECT_TRUE(summary.usable());
  EXPECT_EQ(summary.termination, Termination::kConverged);
  EXPECT_LT(summary.final_cost, 1e-10 * summary.initial_cost);
  EXPECT_LT((x.poses[1] - Truth(3).poses[1]).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_EQ(seen, static_cast<int>(summary.iterations.size()));
  EXPECT_GT(summary.counts.linearizations, 0);
  for (size_t i = 1; i < summary.iterations.size(); ++i)
    EXPECT_LE(summary.iterations[i].cost, summary.iterations[i - 1].cost);
}

TEST_P(EveryOptimizer, StopsWhenAsked) {
  ToyTerm term(Truth(3));
  BodySequence x = Start(3);
  Objective objective(NoPriors(), {}, &term, &x, ToyBody());
  const OptimizerSummary summary =
      Make(GetParam(), Settings())
          ->Run(&objective,
                [](const IterationRecord& r) { return r.iteration < 1; });
  EXPECT_EQ(summary.termination, Termination::kInterrupted);
  EXPECT_EQ(summary.iterations.size(), 2u);
}

TEST_P(EveryOptimizer, NamesTheIterationLimit) {
  ToyTerm term(Truth(3));
  BodySequence x = Start(3);
  Objective objective(NoPriors(), {}, &term, &x, ToyBody());
  const OptimizerSummary summary =
      Make(GetParam(), Settings() + "iterations = 1\n")->Run(&objective, {});
  EXPECT_EQ(summary.termination, Termination::kIterationLimit);
  EXPECT_LT(summary.final_cost, summary.initial_cost);
}

// The minimum lies behind a wall of points that cannot be evaluated. Ceres
// creeps up to it and calls that convergence.
TEST_P(EveryOptimizer, CallsAStallAStall) {
  ToyTerm term(Truth(3));
  term.wall = 0.6;
  BodySequence x = Start(3);
  Objective objective(NoPriors(), {}, &term, &x, ToyBody());
  const OptimizerSummary summary =
      Make(GetParam(), Settings() + "iterations = 300\n")->Run(&objective, {});
  EXPECT_LE(x.translations[0][0], 0.6);
  EXPECT_GT(summary.counts.failed, 0);
  EXPECT_EQ(summary.termination, Termination::kStalled) << summary.reason;
}

// A better point without a derivative is no point to go on from, and none to
// end at: the one kept is that of the cost reported.
TEST_P(EveryOptimizer, KeepsThePointBeforeOneWithoutDerivative) {
  ToyTerm term(Truth(3));
  term.cliff = 0.6;
  BodySequence x = Start(3);
  Objective objective(NoPriors(), {}, &term, &x, ToyBody());
  const OptimizerSummary summary =
      Make(GetParam(), Settings() + "iterations = 300\n")->Run(&objective, {});
  EXPECT_LE(x.translations[0][0], 0.6);
  EXPECT_GT(summary.counts.no_derivative, 0);
  EXPECT_EQ(summary.counts.no_derivative, summary.counts.failed);
  EXPECT_EQ(summary.termination, Termination::kStalled) << summary.reason;
  double cost = 0;
  ASSERT_TRUE(objective.Evaluate(&cost, nullptr));
  EXPECT_NEAR(cost, summary.final_cost, 1e-9 * cost);
}

TEST_P(EveryOptimizer, FailsIfTheStartCannotBeEvaluated) {
  ToyTerm term(Truth(3));
  term.wall = -1;
  BodySequence x = Start(3);
  Objective objective(NoPriors(), {}, &term, &x, ToyBody());
  const OptimizerSummary summary =
      Make(GetParam(), Settings())->Run(&objective, {});
  EXPECT_EQ(summary.termination, Termination::kFailed);
  EXPECT_FALSE(summary.usable());
}

INSTANTIATE_TEST_SUITE_P(Registered,
                         EveryOptimizer,
                         ::testing::ValuesIn(Optimizers().names()));

// The paper's descent: every step has the given length, uphill or not.
TEST(GradientDescent, FixedStepFollowsTheGradient) {
  ToyTerm term(Truth(1));
  BodySequence x = Start(1);
  Objective objective(NoPriors(), {}, &term, &x, ToyBody());
  double cost = 0;
  std::vector<double> gradient;
  objective.Evaluate(&cost, &gradient);
  double norm = 0;
  for (const double g : gradient) norm += g * g;
  Make("gradient_descent",
       "step = 1e-4\nbacktracking = false\niterations = 1\n")
      ->Run(&objective, {});
  double moved = x.shape.squaredNorm() + x.poses[0].squaredNorm() +
                 x.translations[0].squaredNorm();
  EXPECT_NEAR(std::sqrt(moved), 1e-4 * std::sqrt(norm), 1e-12);
}

}  // namespace
}  // namespace invsim
