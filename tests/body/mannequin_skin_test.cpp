// SPDX-License-Identifier: Apache-2.0
#include "../../src/body/mannequin_skin.h"

#include <gtest/gtest.h>

#include "invsim/body/mannequin.h"

namespace invsim {
namespace {

TEST(MannequinSkin, WeightsAreFewPositiveAndSmooth) {
  const BodyModel& body = Mannequin();
  const MatrixXd& weights = body.data().weights;
  EXPECT_EQ((weights.array() > 0.0).rowwise().count().maxCoeff(), 4);
  EXPECT_GE(weights.minCoeff(), 0.0);
  EXPECT_LT((weights.rowwise().sum().array() - 1.0).abs().maxCoeff(), 1e-14);
  // Per centimetre along the surface no joint gains more than three tenths.
  const Points rest = body.Vertices({});
  for (const Edge& edge : Edges(body.faces())) {
    const double length = (rest.col(edge.a) - rest.col(edge.b)).norm();
    const double change =
        (weights.row(edge.a) - weights.row(edge.b)).cwiseAbs().maxCoeff();
    EXPECT_LT(change, 30.0 * length) << rest.col(edge.a).transpose();
  }
}

TEST(MannequinSkin, EveryJointCarriesSkin) {
  EXPECT_GT(Mannequin().data().weights.colwise().maxCoeff().minCoeff(), 0.8);
}

TEST(MannequinSkin, WeightsFollowTheLimbs) {
  const BodyModel& body = Mannequin();
  const MatrixXd& weights = body.data().weights;
  const Points rest = body.Vertices({});
  for (int i = 0; i < body.num_vertices(); ++i) {
    const double x = rest(0, i);
    const double y = rest(1, i);
    if (x > .30 && x < .34) {
      EXPECT_GT(weights(i, 16), 0.95);
    }
    if (x > .53 && x < .62) {
      EXPECT_GT(weights(i, 18), 0.95);
    }
    if (x > .84) {
      EXPECT_GT(weights(i, 22), 0.95);
    }
    if (x < 0 && y > -.9 && y < -.75) {
      EXPECT_GT(weights(i, 5), 0.95);
    }
    if (y > .5) {
      EXPECT_GT(weights(i, 15), 0.95);
    }
    // No skin of one side hangs on a limb of the other, but in the middle.
    if (x > .05) {
      EXPECT_LT(weights(i, 2) + weights(i, 17) + weights(i, 14), 0.05);
    }
  }
}

TEST(MannequinSkin, JointsAreWhereTheyWereMeant) {
  EXPECT_LT((Mannequin().Joints({}) - MannequinJoints()).cwiseAbs().maxCoeff(),
            1e-12);
  EXPECT_GE(Mannequin().data().joint_regressor.minCoeff(), 0.0);
}

TEST(MannequinSkin, SharesSplitTheBody) {
  EXPECT_EQ(ArmShare({-.5, .25, 0}), 1.0);
  EXPECT_EQ(ArmShare({.15, .1, 0}), 0.0);
  EXPECT_EQ(LeftLegShare({.12, -.6, 0}), 1.0);
  EXPECT_EQ(LeftLegShare({-.12, -.6, 0}), 0.0);
  EXPECT_EQ(LeftLegShare({.80, .25, 0}), 0.0);
  EXPECT_EQ(HeadShare({0, .5, 0}), 1.0);
}

}  // namespace
}  // namespace invsim
