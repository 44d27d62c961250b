// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/disturbance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "invsim/body/rotation.h"

namespace invsim {
namespace {

BodySequence True() {
  BodySequence x;
  x.shape.setConstant(0.5);
  for (int t = 0; t < 3; ++t) {
    BodyParameters p;
    p.pose.setConstant(0.1 * t);
    x.Append(p);
  }
  return x;
}

TEST(Disturb, TurnsShiftsAndTakesTheShapeByAsMuchAsAsked) {
  const BodySequence truth = True();
  const BodySequence x = Disturb(truth, {0.1, 0.03, 1}, 1);
  EXPECT_EQ(x.shape, ShapeVector::Zero());
  double squares = 0;
  for (int t = 0; t < 3; ++t) {
    EXPECT_NEAR(
        (x.translations[t] - truth.translations[t]).norm(), 0.03, 1e-12);
    for (int j = 0; j < kNumJoints; ++j)
      squares +=
          std::pow(GeodesicDistance(Exp(x.poses[t].segment<3>(3 * j)),
                                    Exp(truth.poses[t].segment<3>(3 * j))),
                   2);
  }
  EXPECT_NEAR(std::sqrt(squares / (3 * kNumJoints)), 0.1, 0.03);
}

TEST(Disturb, IsRepeatableAndCanDoNothing) {
  EXPECT_EQ(Disturb(True(), {}, 7).poses, Disturb(True(), {}, 7).poses);
  EXPECT_NE(Disturb(True(), {}, 7).poses, Disturb(True(), {}, 8).poses);
  const BodySequence same = Disturb(True(), {0, 0, 0}, 7);
  EXPECT_EQ(same.shape, True().shape);
  EXPECT_NEAR((same.poses[2] - True().poses[2]).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace invsim
