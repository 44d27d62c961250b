// SPDX-License-Identifier: Apache-2.0
// What gradient descent does beyond what every optimiser does, for which see
// optimizer_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "invsim/fit/optimizer.h"
#include "toy_term.h"

namespace invsim {
namespace {

constexpr int kDescentFrames = 2;

// The slope of a ToyTerm's cost by one unknown that is `d` off.
double ToySlope(double d) {
  return 100 * (d + 0.1 * std::sin(d)) * (1 + 0.1 * std::cos(d));
}

double Norm(const std::vector<double>& v) {
  return Eigen::Map<const VectorXd>(v.data(), v.size()).norm();
}

// Unknowns that all start off the truth by the same.
class GradientDescentTest : public ::testing::Test {
 protected:
  GradientDescentTest() : term_(Sequence(0.3)), x_(Sequence(0)) {
    options_.function_tolerance = 0;
  }

  static BodySequence Sequence(double value) {
    BodySequence x;
    x.shape.setConstant(value);
    for (int t = 0; t < kDescentFrames; ++t)
      x.Append(
          {x.shape, PoseVector::Constant(value), Vector3d::Constant(value)});
    return x;
  }
  OptimizerSummary Descend(
      DataTerm* term,
      const std::function<void(const IterationRecord&, Objective*)>& see = {}) {
    PriorOptions no_priors;
    no_priors.smoothness = no_priors.shape = no_priors.pose = 0;
    Objective objective(no_priors, free_, term, &x_, ToyBody());
    return MakeGradientDescent(options_)->Run(
        &objective, [&](const IterationRecord& record) {
          if (see) see(record, &objective);
          return true;
        });
  }
  void FixStep(double step) {
    options_.step = step;
    options_.backtracking = false;
  }

  ToyTerm term_;
  BodySequence x_;
  FreeParameters free_;
  GradientDescentOptions options_;
};

// The paper's x <- x - step * gradient, number by number. The frames share
// the shape.
TEST_F(GradientDescentTest, AFixedStepIsThePapers) {
  FixStep(1e-3);
  options_.iterations = 6;
  double shape = 0, other = 0;
  const OptimizerSummary summary =
      Descend(&term_, [&](const IterationRecord& record, Objective* objective) {
        if (record.iteration > 0) {
          shape -= options_.step * kDescentFrames * ToySlope(shape - 0.3);
          other -= options_.step * ToySlope(other - 0.3);
        }
        for (const double value : objective->x()->shape)
          EXPECT_NEAR(value, shape, 1e-13);
        for (int t = 0; t < kDescentFrames; ++t) {
          for (const double value : objective->x()->poses[t])
            EXPECT_NEAR(value, other, 1e-13);
          for (const double value : objective->x()->translations[t])
            EXPECT_NEAR(value, other, 1e-13);
        }
      });
  EXPECT_EQ(summary.iterations.size(), 7u);
  EXPECT_GT(other, 0.1);
}

TEST_F(GradientDescentTest, AFixedStepThatIsTooLongGoesUphill) {
  FixStep(0.03);  // beyond the minimum by more than it was before it
  options_.iterations = 3;
  const OptimizerSummary summary = Descend(&term_);
  EXPECT_EQ(summary.termination, Termination::kIterationLimit);
  for (int k = 0; k < 3; ++k)
    EXPECT_GT(summary.iterations[k + 1].cost, summary.iterations[k].cost);
}

// Into a wall of what cannot be evaluated: it stays at the last point before.
TEST_F(GradientDescentTest, AFixedStepIntoAWallIsTakenBack) {
  FixStep(1e-3);
  term_.wall = 0.1;
  BodySequence last;
  const OptimizerSummary summary = Descend(
      &term_, [&](const IterationRecord&, Objective* o) { last = *o->x(); });
  EXPECT_EQ(summary.termination, Termination::kStalled);
  EXPECT_EQ(x_.shape, last.shape);
  EXPECT_EQ(x_.poses, last.poses);
  EXPECT_EQ(x_.translations, last.translations);
  EXPECT_GT(x_.translations[0][0], 0.05);
}

// Armijo: the cost falls by a ten-thousandth of what the gradient promises at
// least, in steps of which each is twice another or half of it.
TEST_F(GradientDescentTest, BacktrackingNeverRaisesTheCost) {
  for (const double first : {10.0, 1e-6}) {
    x_ = Sequence(0);
    options_.step = first;
    options_.iterations = 60;
    double cost = 0, norm = 0, step = 0;
    const OptimizerSummary summary = Descend(
        &term_, [&](const IterationRecord& record, Objective* objective) {
          if (norm > 0) {
            step = record.step_norm / norm;
            EXPECT_LT(record.cost, cost - 0.9999e-4 * step * norm * norm);
            const double halvings = std::log2(first / step);
            EXPECT_NEAR(halvings, std::round(halvings), 1e-6);
          }
          std::vector<double> gradient;
          ASSERT_TRUE(objective->Evaluate(&cost, &gradient));
          norm = Norm(gradient);
        });
    EXPECT_LT(summary.final_cost, 1e-6 * summary.initial_cost);
    // About the reciprocal of the curvature, wherever it began.
    EXPECT_GT(step, 1e-3);
    EXPECT_LT(step, 0.1);
  }
}

TEST_F(GradientDescentTest, StepsDoubleWhileTheyAreTakenAtOnce) {
  options_.step = 1e-7;
  options_.iterations = 8;
  double norm = 0;
  Descend(&term_, [&](const IterationRecord& record, Objective* objective) {
    if (record.iteration > 0) {
      EXPECT_NEAR(record.step_norm / norm,
                  options_.step * std::pow(2, record.iteration - 1),
                  1e-9 * options_.step);
    }
    double cost;
    std::vector<double> gradient;
    ASSERT_TRUE(objective->Evaluate(&cost, &gradient));
    norm = Norm(gradient);
  });
}

// Trials that are refused cost as little as can be.
TEST_F(GradientDescentTest, OnlyPointsThatAreKeptAreLinearised) {
  options_.step = 10;
  options_.iterations = 8;
  const OptimizerSummary summary = Descend(&term_);
  const int kept = static_cast<int>(summary.iterations.size());
  EXPECT_EQ(kept, 9);
  EXPECT_EQ(summary.counts.linearizations, kept);
  EXPECT_GT(summary.counts.abandoned, 5);  // of the first step alone
  EXPECT_EQ(summary.counts.evaluations, kept + summary.counts.abandoned);
  EXPECT_EQ(summary.counts.failed, 0);
}

// Its gradient leads uphill, as that of a rough cost may.
class WrongWayTerm : public ToyTerm {
 public:
  using ToyTerm::ToyTerm;
  bool Linearize(std::vector<FrameBlock>* blocks) override {
    if (!ToyTerm::Linearize(blocks)) return false;
    for (FrameBlock& block : *blocks) block.residual *= -1;
    return true;
  }
};

TEST_F(GradientDescentTest, GivesUpWhereNoStepLowersTheCost) {
  WrongWayTerm term(Sequence(0.3));
  x_ = Sequence(0.1);
  const OptimizerSummary summary = Descend(&term);
  EXPECT_EQ(summary.termination, Termination::kConverged);
  EXPECT_EQ(summary.reason, "No step along the gradient lowers the cost.");
  EXPECT_EQ(summary.iterations.size(), 1u);
  EXPECT_EQ(summary.final_cost, summary.initial_cost);
  EXPECT_EQ(x_.shape, Sequence(0.1).shape);
  EXPECT_EQ(x_.poses, Sequence(0.1).poses);
}

TEST_F(GradientDescentTest, StaysAtAMinimum) {
  x_ = Sequence(0.3);
  for (const bool backtracking : {true, false}) {
    options_.backtracking = backtracking;
    const OptimizerSummary summary = Descend(&term_);
    EXPECT_EQ(summary.termination, Termination::kConverged);
    EXPECT_LE(summary.iterations.size(), 2u);
    EXPECT_EQ(x_.poses, Sequence(0.3).poses);
  }
}

// Of noise, which stays whatever the body does.
class NoisyTerm : public ToyTerm {
 public:
  using ToyTerm::ToyTerm;
  Evaluation Evaluate(const BodySequence& x,
                      double cost_limit,
                      std::vector<double>* costs) override {
    const Evaluation outcome = ToyTerm::Evaluate(x, cost_limit, costs);
    for (double& cost : *costs) cost += kNoise;
    return outcome;
  }
  bool Linearize(std::vector<FrameBlock>* blocks) override {
    const bool done = ToyTerm::Linearize(blocks);
    for (FrameBlock& block : *blocks) block.cost += kNoise;
    return done;
  }

 private:
  static constexpr double kNoise = 100;
};

TEST_F(GradientDescentTest, EndsOnceTheCostChangesByLessThanTheTolerance) {
  NoisyTerm term(Sequence(0.3));
  FixStep(1e-3);
  options_.function_tolerance = 1e-3;
  const OptimizerSummary summary = Descend(&term);
  EXPECT_EQ(summary.termination, Termination::kConverged);
  std::vector<double> costs;
  for (const IterationRecord& i : summary.iterations) costs.push_back(i.cost);
  EXPECT_EQ(costs.back(), summary.final_cost);
  ASSERT_GT(costs.size(), 5u);
  for (size_t k = 1; k < costs.size(); ++k)
    EXPECT_EQ(costs[k - 1] - costs[k] <= 1e-3 * costs[k - 1],
              k + 1 == costs.size())
        << k;
}

// Joints that are held do not move by a bit, and those beside them move as if
// all were free.
TEST_F(GradientDescentTest, FixedJointsStay) {
  free_.shape = free_.translation = false;
  for (int j = 0; j < kNumJoints; ++j) free_.joints[j] = j % 3 == 1;
  FixStep(1e-3);
  options_.iterations = 1;
  Descend(&term_);
  EXPECT_EQ(x_.shape, Sequence(0).shape);
  EXPECT_EQ(x_.translations, Sequence(0).translations);
  for (const PoseVector& pose : x_.poses)
    for (int i = 0; i < kNumPose; ++i) {
      const bool moves = i / 3 % 3 == 1;
      EXPECT_NEAR(pose[i], moves ? 1e-3 * ToySlope(0.3) : 0, moves ? 1e-13 : 0);
    }
}

}  // namespace
}  // namespace invsim
