// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/effects/bending_curve.h"

#include <gtest/gtest.h>

#include "../test_cloth.h"

namespace invsim {
namespace {

const std::array<double, 5> kNodes = {2.0, 3.0, 1.0, 5.0, 4.0};

TEST(BendingCurve, InterpolatesTheNodes) {
  const BendingCurve curve(kNodes, 0.5);
  EXPECT_DOUBLE_EQ(curve.At(0.0).stiffness, 2.0);
  EXPECT_DOUBLE_EQ(curve.At(0.5).stiffness, 3.0);
  EXPECT_DOUBLE_EQ(curve.At(-0.75).stiffness, 2.0);
  EXPECT_DOUBLE_EQ(curve.At(2.0).stiffness, 4.0);
  EXPECT_DOUBLE_EQ(curve.At(9.0).stiffness, 4.0);
  EXPECT_DOUBLE_EQ(curve.At(0.75).slope, -4.0);
  EXPECT_DOUBLE_EQ(curve.At(-0.75).slope, 4.0);
  EXPECT_DOUBLE_EQ(curve.At(9.0).slope, 0.0);
  EXPECT_DOUBLE_EQ(curve.At(std::nan("")).stiffness, 4.0);
}

TEST(BendingCurve, EnergyIsTheIntegralOfTheMoment) {
  const BendingCurve curve(kNodes, 0.5);
  for (const double bend : {0.2, -0.8, 1.3, 1.9, -2.7}) {
    const double slope = Derivative(
        [&](double s) { return VectorXd::Constant(1, curve.Energy(bend + s)); },
        1e-3)[0];
    EXPECT_NEAR(slope, curve.At(bend).stiffness * bend, 1e-10);
  }
  EXPECT_EQ(curve.Energy(0.0), 0.0);
  // A straight line: 1/2 k phi^2.
  EXPECT_NEAR(BendingCurve({3, 3, 3, 3, 3}, 0.1).Energy(-0.73),
              0.5 * 3.0 * 0.73 * 0.73,
              1e-14);
}

TEST(MakeBendingCurve, ReadsTheMeasuredTable) {
  const MeasuredBending fabric = ExampleBendingTable();
  HingeRest rest{0.03, 0.0009, {{1.0, 0.0}, {-2.0, 0.0}}};
  const double shape = rest.length * rest.length / rest.area / 4.0;
  // Curvature |phi| l / area of 20 and 25 per metre, edge along axis 1.
  const double bend = 20.0 * rest.area / rest.length;
  const BendingCurve along = MakeBendingCurve(fabric, rest);
  EXPECT_NEAR(along.At(bend).stiffness, shape * 35e-6, 1e-18);
  EXPECT_NEAR(along.At(-1.25 * bend).stiffness, shape * 37.5e-6, 1e-18);
  // Edges at 45 degrees either way, and at 90.
  rest.directions[0] = Vector2d(1.0, -1.0);
  rest.directions[1] = Vector2d(-1.0, 1.0);
  EXPECT_NEAR(
      MakeBendingCurve(fabric, rest).At(bend).stiffness, shape * 16e-6, 1e-18);
  rest.directions[0] = rest.directions[1] = Vector2d(0.0, -1.0);
  EXPECT_NEAR(
      MakeBendingCurve(fabric, rest).At(bend).stiffness, shape * 15e-6, 1e-18);
  // At 22.5 degrees, midway between the rows.
  rest.directions[0] = rest.directions[1] =
      Vector2d(std::cos(std::atan(1.0) / 2), std::sin(std::atan(1.0) / 2));
  EXPECT_NEAR(
      MakeBendingCurve(fabric, rest).At(0.0).stiffness, shape * 22.5e-6, 1e-18);
  // A seam of edges along 1 and along 2: the softer of both.
  rest.directions[0] = Vector2d(1.0, 0.0);
  rest.directions[1] = Vector2d(0.0, 1.0);
  EXPECT_NEAR(
      MakeBendingCurve(fabric, rest).At(0.0).stiffness, shape * 14e-6, 1e-18);
}

}  // namespace
}  // namespace invsim
