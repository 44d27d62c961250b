// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/priors.h"

#include <gtest/gtest.h>

#include "invsim/base/random.h"
#include "invsim/body/rotation.h"

namespace invsim {
namespace {

PoseVector RandomPose(Random* random, double size) {
  PoseVector pose;
  for (double& angle : pose) angle = size * random->Normal();
  return pose;
}

TEST(LaplacianOfRotations, DerivativeMatchesDifferences) {
  Random random(1);
  const PoseVector middle = RandomPose(&random, 0.8);
  PoseVector pose[3] = {middle + RandomPose(&random, 0.3),
                        middle,
                        middle + RandomPose(&random, 0.3)};
  pose[1].segment<3>(6).setZero();  // no rotation at all
  const RotationLaplacian at = LaplacianOfRotations(pose[0], pose[1], pose[2]);
  for (int f = 0; f < 3; ++f) {
    for (int i = 0; i < kNumPose; ++i) {
      const double h = 1e-6;
      PoseVector value[2];
      for (const int side : {0, 1}) {
        PoseVector moved[3] = {pose[0], pose[1], pose[2]};
        moved[f][i] += side ? h : -h;
        value[side] = LaplacianOfRotations(moved[0], moved[1], moved[2]).value;
      }
      const PoseVector column = (value[1] - value[0]) / (2 * h);
      PoseVector expected = PoseVector::Zero();
      expected.segment<3>(3 * (i / 3)) = at.derivative[f][i / 3].col(i % 3);
      const VectorXd difference = column - expected;
      EXPECT_LT(difference.norm(), 1e-8) << f << " " << i;
    }
  }
}

// A joint that turns steadily past half a turn, where its vector jumps.
TEST(LaplacianOfRotations, SteadyTurnCostsNothingThoughVectorsWrap) {
  PoseVector pose[3];
  const double angles[3] = {3.0, 3.1, 3.2};
  for (int f = 0; f < 3; ++f) {
    pose[f].setZero();
    pose[f].head<3>() = Log(Exp(Vector3d(0, angles[f], 0)));
  }
  EXPECT_LT(pose[2][1], 0);  // it did wrap
  EXPECT_LT(LaplacianOfRotations(pose[0], pose[1], pose[2]).value.norm(),
            1e-12);
}

TEST(PosePrior, DerivativeMatchesDifferences) {
  Random random(2);
  const PoseVector pose = RandomPose(&random, 1.2);
  PosePriorVector slope;
  PosePrior(pose, &slope);
  for (int i = 3; i < kNumPose; ++i) {
    const double h = 1e-6;
    PoseVector up = pose, down = pose;
    up[i] += h;
    down[i] -= h;
    const VectorXd d =
        (PosePrior(up, nullptr) - PosePrior(down, nullptr)) / (2 * h);
    for (int r = 0; r < kNumPosePrior; ++r)
      EXPECT_NEAR(d[r], 3 + r / 2 == i ? slope[r] : 0, 1e-5);
  }
}

// Flexing a knee or an elbow costs little, over-stretching it costs much; left
// and right alike.
TEST(PosePrior, JointsBendOneWay) {
  const auto cost = [](int index, double angle) {
    PoseVector pose = PoseVector::Zero();
    pose[index] = angle;
    return PosePrior(pose, nullptr).squaredNorm();
  };
  for (const int knee : {4, 5})
    EXPECT_LT(cost(3 * knee, 1.5) + 50, cost(3 * knee, -1.5));
  EXPECT_LT(cost(3 * 18 + 1, -1.5) + 50, cost(3 * 18 + 1, 1.5));
  EXPECT_LT(cost(3 * 19 + 1, 1.5) + 50, cost(3 * 19 + 1, -1.5));
  EXPECT_DOUBLE_EQ(cost(3 * 18 + 1, -1.5), cost(3 * 19 + 1, 1.5));
}

// The root is not a joint of the body: it may face anywhere.
TEST(PosePrior, RootIsFree) {
  PoseVector pose = PoseVector::Zero();
  const double still = PosePrior(pose, nullptr).squaredNorm();
  pose.head<3>() = Vector3d(0.3, 3.0, 0);
  EXPECT_EQ(PosePrior(pose, nullptr).squaredNorm(), still);
}

}  // namespace
}  // namespace invsim
