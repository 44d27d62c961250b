// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/objective.h"

#include <ceres/problem.h>
#include <gtest/gtest.h>

#include "invsim/base/random.h"
#include "toy_term.h"

namespace invsim {
namespace {

BodySequence RandomSequence(int frames, double size, std::uint64_t seed) {
  Random random(seed);
  BodySequence x;
  for (double& b : x.shape) b = size * random.Normal();
  for (int t = 0; t < frames; ++t) {
    BodyParameters p;
    for (double& a : p.pose) a = size * random.Normal();
    for (double& a : p.translation) a = size * random.Normal();
    x.Append(p);
  }
  return x;
}

TEST(Objective, GradientMatchesDifferencesInEveryBlock) {
  ToyTerm term(RandomSequence(4, 0.3, 1));
  BodySequence x = RandomSequence(4, 0.3, 2);
  Objective objective({}, {}, &term, &x, ToyBody());
  double cost = 0;
  std::vector<double> gradient;
  ASSERT_TRUE(objective.Evaluate(&cost, &gradient));
  size_t at = 0;
  for (double* block : objective.blocks()) {
    const int size = objective.problem()->ParameterBlockSize(block);
    for (int i = 0; i < size; ++i, ++at) {
      const double kept = block[i], h = 1e-5;
      double up = 0, down = 0;
      block[i] = kept + h;
      ASSERT_TRUE(objective.Evaluate(&up, nullptr));
      block[i] = kept - h;
      ASSERT_TRUE(objective.Evaluate(&down, nullptr));
      block[i] = kept;
      EXPECT_NEAR(gradient[at],
                  (up - down) / (2 * h),
                  1e-6 * std::max(1.0, std::abs(gradient[at])) + 1e-4);
    }
  }
  EXPECT_EQ(at, gradient.size());
}

TEST(Objective, TermsAddUpToTheCostWithAndWithoutDerivatives) {
  ToyTerm term(RandomSequence(5, 0.3, 3));
  BodySequence x = RandomSequence(5, 0.5, 4);
  Objective objective({}, {}, &term, &x, ToyBody());
  double alone = 0, with = 0;
  std::vector<double> gradient;
  ASSERT_TRUE(objective.Evaluate(&alone, nullptr));
  ASSERT_TRUE(objective.Evaluate(&with, &gradient));
  EXPECT_NEAR(alone, with, 1e-12 * alone);
  EXPECT_NEAR(objective.terms().total(), alone, 1e-12 * alone);
  EXPECT_GT(objective.terms().smoothness, 0);
  EXPECT_GT(objective.terms().pose, 0);
}

TEST(Objective, FixedUnknownsHaveNoGradient) {
  ToyTerm term(RandomSequence(2, 0.3, 3));
  BodySequence x = RandomSequence(2, 0.5, 4);
  FreeParameters free;
  free.shape = false;
  for (int j = 3; j < kNumJoints; ++j) free.joints[j] = false;
  Objective objective({}, free, &term, &x, ToyBody());
  double cost = 0;
  std::vector<double> gradient;
  ASSERT_TRUE(objective.Evaluate(&cost, &gradient));
  EXPECT_EQ(gradient.size(), 2u * (9 + 3));
}

TEST(Objective, SaysWhenItCannotBeEvaluated) {
  ToyTerm term(RandomSequence(3, 0.1, 3));
  BodySequence x = RandomSequence(3, 0.1, 4);
  term.wall = x.translations[0][0] - 1;
  Objective objective({}, {}, &term, &x, ToyBody());
  double cost = 0;
  EXPECT_FALSE(objective.Evaluate(&cost, nullptr));
  EXPECT_EQ(objective.counts().failed, 1);
  EXPECT_EQ(objective.counts().evaluations, 1);
}

// One or two frames have no second difference.
TEST(Objective, WorksWithFewerFramesThanSmoothnessNeeds) {
  for (const int frames : {1, 2}) {
    ToyTerm term(RandomSequence(frames, 0.1, 3));
    BodySequence x = RandomSequence(frames, 0.1, 4);
    Objective objective({}, {}, &term, &x, ToyBody());
    double cost = 0;
    EXPECT_TRUE(objective.Evaluate(&cost, nullptr));
    EXPECT_EQ(objective.terms().smoothness, 0);
  }
}

}  // namespace
}  // namespace invsim
