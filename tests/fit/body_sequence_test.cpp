// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/body_sequence.h"

#include <gtest/gtest.h>

#include "invsim/base/random.h"
#include "invsim/body/rotation.h"

namespace invsim {
namespace {

BodySequence SteadyTurn(int frames) {
  BodySequence x;
  for (int t = 0; t < frames; ++t) {
    BodyParameters p;
    p.pose.head<3>() = Log(Exp(Vector3d(0, 0.3 * t, 0)));
    p.translation = Vector3d(0.01 * t, 0, 0.02 * t);
    x.Append(p);
  }
  return x;
}

double Difference(const BodySequence& a, const BodySequence& b) {
  double worst = 0;
  for (int t = 0; t < a.num_frames(); ++t) {
    for (int j = 0; j < kNumJoints; ++j)
      worst = std::max(worst,
                       GeodesicDistance(Exp(a.poses[t].segment<3>(3 * j)),
                                        Exp(b.poses[t].segment<3>(3 * j))));
    worst = std::max(worst, (a.translations[t] - b.translations[t]).norm());
  }
  return worst;
}

TEST(GaussianFilter, LeavesSteadyMotionThatWrapsAlone) {
  const BodySequence x = SteadyTurn(30);
  EXPECT_LT(Difference(GaussianFilter(x, 2), x), 1e-7);
}

TEST(GaussianFilter, TakesNoiseAway) {
  const BodySequence truth = SteadyTurn(60);
  BodySequence noisy = truth;
  Random random(4);
  const auto noise = [&] { return 0.03 * random.Normal(); };
  for (int t = 0; t < 60; ++t) {
    for (int j = 0; j < kNumJoints; ++j) {
      const Vector3d turn(noise(), noise(), noise());
      noisy.poses[t].segment<3>(3 * j) =
          Log(Exp(turn) * Exp(noisy.poses[t].segment<3>(3 * j)));
    }
    noisy.translations[t] += Vector3d(noise(), noise(), noise());
  }
  const BodySequence smooth = GaussianFilter(noisy, 2);
  double before = 0, after = 0;
  for (int t = 10; t < 50; ++t) {
    before += (noisy.translations[t] - truth.translations[t]).squaredNorm();
    after += (smooth.translations[t] - truth.translations[t]).squaredNorm();
    for (int j = 0; j < kNumJoints; ++j) {
      const Matrix3d r = Exp(truth.poses[t].segment<3>(3 * j));
      before += std::pow(
          GeodesicDistance(Exp(noisy.poses[t].segment<3>(3 * j)), r), 2);
      after += std::pow(
          GeodesicDistance(Exp(smooth.poses[t].segment<3>(3 * j)), r), 2);
    }
  }
  // A Gaussian of 2 frames averages 2 sqrt(pi) 2 = 7 independent frames.
  EXPECT_NEAR(after / before, 1 / 7.1, 0.03);
}

TEST(GaussianFilter, OfNoWidthChangesNothing) {
  const BodySequence x = SteadyTurn(5);
  EXPECT_EQ(Difference(GaussianFilter(x, 0), x), 0);
}

TEST(Canonicalize, KeepsTheRotationAndShortensTheVector) {
  PoseVector pose = PoseVector::Zero();
  pose.segment<3>(9) = Vector3d(4, 3, -2);
  const Matrix3d before = Exp(pose.segment<3>(9));
  Canonicalize(&pose);
  EXPECT_LE(pose.segment<3>(9).norm(), 3.15);
  EXPECT_LT(GeodesicDistance(before, Exp(pose.segment<3>(9))), 1e-7);
}

}  // namespace
}  // namespace invsim
