// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/loss.h"

#include <ceres/loss_function.h>
#include <gtest/gtest.h>

#include <cmath>

namespace invsim {
namespace {

class EveryLoss : public ::testing::TestWithParam<std::string> {};

// rho(s) at s and its two derivatives by central differences of rho and rho'.
TEST_P(EveryLoss, DerivativesMatchDifferences) {
  for (const double a : {0.01, 0.3}) {
    const auto loss = MakeLoss({GetParam(), a});
    for (const double share : {0.2, 0.7, 1.8}) {
      const double s = share * a * a;
      const double h = 1e-5 * s;
      double at[3], up[3], down[3];
      loss->Evaluate(s, at);
      loss->Evaluate(s + h, up);
      loss->Evaluate(s - h, down);
      EXPECT_NEAR(at[1], (up[0] - down[0]) / (2 * h), 1e-6);
      EXPECT_NEAR(at[2] * a * a, (up[1] - down[1]) / (2 * h) * a * a, 1e-5);
    }
  }
}

TEST_P(EveryLoss, CostsNothingAtZeroAndNeverLess) {
  const auto loss = MakeLoss({GetParam(), 0.02});
  double before = 0;
  for (double s = 0; s < 0.01; s += 1e-5) {
    double rho[3];
    loss->Evaluate(s, rho);
    if (s == 0) {
      EXPECT_NEAR(rho[0], 0, 1e-15);
    }
    EXPECT_GE(rho[0], before - 1e-15);
    EXPECT_GE(rho[1], 0);
    before = rho[0];
  }
}

INSTANTIATE_TEST_SUITE_P(Registered,
                         EveryLoss,
                         ::testing::ValuesIn(Losses().names()));

TEST(Loss, BendsAtItsScale) {
  double rho[3];
  MakeLoss({"huber", 0.5})->Evaluate(1.0, rho);
  EXPECT_DOUBLE_EQ(rho[0], 2 * 0.5 * 1 - 0.25);
  MakeLoss({"cauchy", 2})->Evaluate(4.0, rho);
  EXPECT_DOUBLE_EQ(rho[0], 4 * std::log(2.0));
  MakeLoss({"tukey", 2})->Evaluate(5.0, rho);
  EXPECT_EQ(rho[1], 0);
}

TEST(Loss, RefusesUnknownNamesAndScales) {
  try {
    MakeLoss({"cauchi", 1});
    FAIL();
  } catch (const UsageError& e) {
    EXPECT_NE(std::string(e.what()).find("cauchy"), std::string::npos);
  }
  EXPECT_THROW(MakeLoss({"huber", 0}), UsageError);
  EXPECT_THROW(MakeLoss({"huber", NAN}), UsageError);
}

}  // namespace
}  // namespace invsim
