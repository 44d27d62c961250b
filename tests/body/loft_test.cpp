// SPDX-License-Identifier: Apache-2.0
#include "../../src/body/loft.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../../src/body/smooth_step.h"

namespace invsim {
namespace {

// A cylinder of radius 0.1 along y from -0.5 to 0.5 with half spheres on it.
Loft Capsule() {
  return Loft(1,
              {{-.5, 0, 0, .1, .1, .1, .1},
               {.0, 0, 0, .1, .1, .1, .1},
               {.5, 0, 0, .1, .1, .1, .1}},
              .1,
              .1);
}

TEST(Loft, RoundSectionsGiveTheDistance) {
  const Loft loft = Capsule();
  EXPECT_NEAR(loft.Distance({.15, .2, 0}), .05, 1e-12);
  EXPECT_NEAR(loft.Distance({0, -.3, .06}), -.04, 1e-12);
  EXPECT_NEAR(loft.Distance({0, .65, 0}), .05, 1e-12);
  EXPECT_NEAR(loft.Distance({.1 * std::sqrt(.5), .5 + .1 * std::sqrt(.5), 0}),
              0.0,
              1e-12);
}

TEST(Loft, FarAwayIsTheDistanceOfItsBox) {
  EXPECT_NEAR(Capsule().Distance({3.1, 0, 0}), 3.0, 1e-12);
}

TEST(Loft, PassesThroughItsStations) {
  const Loft loft(0,
                  {{.0, .1, .2, .03, .04, .05, .06},
                   {.1, .1, .3, .04, .05, .06, .07, 3.0},
                   {.3, .2, .3, .02, .02, .02, .02}},
                  .02,
                  .02);
  EXPECT_NEAR(loft.Distance({.1, .14, .3}), 0.0, 1e-12);
  EXPECT_NEAR(loft.Distance({.1, .05, .3}), 0.0, 1e-12);
  EXPECT_NEAR(loft.Distance({.1, .1, .36}), 0.0, 1e-12);
  EXPECT_NEAR(loft.Distance({.1, .1, .23}), 0.0, 1e-12);
  // Exponent 3: |a|^3 + |b|^3 = 1.
  const double third = std::cbrt(.5);
  EXPECT_NEAR(
      loft.Distance({.1, .1 + .04 * third, .3 + .06 * third}), 0.0, 1e-12);
  EXPECT_NEAR(loft.Distance({.0, .13, .2}), 0.0, 1e-12);
}

TEST(Loft, CentreLineIsInside) { EXPECT_LT(Capsule().Distance({0, .1, 0}), 0); }

TEST(SmoothMin, RoundsTheCornerOnly) {
  EXPECT_EQ(SmoothMin(1.0, 2.0, .5), 1.0);
  EXPECT_EQ(SmoothMin(2.0, 1.0, .5), 1.0);
  EXPECT_EQ(SmoothMin(1.0, 1.0, .4), 0.9);
  EXPECT_EQ(SmoothMin(1.0, 1.1, .4), SmoothMin(1.1, 1.0, .4));
}

TEST(SmoothStep, StepsFromZeroToOne) {
  EXPECT_EQ(SmoothStep(1, 2, .9), 0.0);
  EXPECT_EQ(SmoothStep(1, 2, 1.5), 0.5);
  EXPECT_EQ(SmoothStep(1, 2, 2.1), 1.0);
  EXPECT_EQ(SmoothStep(2, 1, 2.1), 0.0);
  EXPECT_EQ(Bump(0, 1, 2, 3, 1.5), 1.0);
  EXPECT_EQ(Bump(0, 1, 2, 3, 3.5), 0.0);
}

TEST(SmoothStep, EvenStepIsStraightBetweenItsCorners) {
  EXPECT_EQ(EvenStep(1, 3, .1, .8), 0.0);
  EXPECT_NEAR(EvenStep(1, 3, .1, 2.0), 0.5, 1e-15);
  EXPECT_NEAR(EvenStep(1, 3, .1, 2.5) - EvenStep(1, 3, .1, 1.5), 0.5, 1e-15);
  EXPECT_NEAR(EvenStep(1, 3, .1, 7.0), 1.0, 1e-15);
}

}  // namespace
}  // namespace invsim
