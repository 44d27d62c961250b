// SPDX-License-Identifier: Apache-2.0
#include "invsim/sim/body_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "invsim/body/rotation.h"
#include "sim/test_scene.h"

namespace invsim {
namespace {

BodyParameters RandomBody(unsigned seed, double pose_scale) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  BodyParameters p;
  for (double& b : p.shape) b = normal(random);
  for (double& a : p.pose) a = pose_scale * normal(random);
  for (double& t : p.translation) t = normal(random);
  return p;
}

TEST(Heading, IsTheTurnAboutTheVertical) {
  EXPECT_LT((Heading({0, 2, 0}) - Vector3d(0, 2, 0)).norm(), 1e-12);
  EXPECT_LT((Heading({0, 4, 0}) - Vector3d(0, 4 - 2 * M_PI, 0)).norm(), 1e-12);
  EXPECT_LT(Heading({0.7, 0, 0}).norm(), 1e-12);
  EXPECT_EQ(Heading({0, 0, 0}), Vector3d::Zero());
  EXPECT_EQ(Heading({M_PI, 0, 0}), Vector3d::Zero());  // on its head
  // A lean after a turn does not change the heading.
  const Vector3d both = Log(Exp({0, 1.2, 0}) * Exp({0.5, 0, 0}));
  EXPECT_LT((Heading(both) - Vector3d(0, 1.2, 0)).norm(), 1e-12);
}

TEST(PlaceAtStart, KeepsThePelvisAndMovesGarmentWithBody) {
  const BodyModel model = BallBody();
  const BodyParameters first = RandomBody(3, 0.8);
  ShapeVector shape = ShapeVector::Zero();
  shape[0] = 0.5;
  const StartingPlace start = PlaceAtStart(model, first, shape);
  EXPECT_LT(
      (model.Joints(start.body).col(0) - model.Joints(first).col(0)).norm(),
      1e-12);
  EXPECT_LT(start.body.pose.tail<kNumPose - 3>().norm(), 1e-15);
  BodyParameters made;
  made.shape = shape;
  const Points moved =
      (start.rotation * model.Vertices(made)).colwise() + start.translation;
  EXPECT_LT((moved - model.Vertices(start.body)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(BeforeFirst, ArrivesWithTheSpeedOfTheMotionFromAStandstill) {
  std::vector<BodyParameters> motion(2, RandomBody(4, 0.3));
  motion[1].translation += Vector3d(0.03, 0, 0.01);
  motion[1].pose[1] += 0.05;
  const double fps = 30, lead_in = 0.4;
  const auto at = [&](double t) {
    return BeforeFirst(motion, fps, lead_in, t);
  };
  EXPECT_EQ(at(0).pose, motion[0].pose);
  const Vector3d v = fps * (motion[1].translation - motion[0].translation);
  const double h = 1e-5;
  EXPECT_LT(
      ((at(0).translation - at(-h).translation) / h - v).norm() / v.norm(),
      2 * h / lead_in);
  const Vector3d slow =
      (at(-lead_in + h).translation - at(-lead_in).translation) / h;
  EXPECT_LT(slow.norm() / v.norm(), 2 * h / lead_in);
  // Half the way that the full speed would have made.
  EXPECT_LT(
      (at(-lead_in).translation - motion[0].translation + 0.5 * lead_in * v)
          .norm(),
      1e-12);
  EXPECT_EQ(at(-1).translation, at(-lead_in).translation);
}

TEST(BeforeFirst, StandsStillWithoutLeadInOrSecondFrame) {
  std::vector<BodyParameters> motion = {RandomBody(5, 1), RandomBody(6, 1)};
  EXPECT_EQ(BeforeFirst(motion, 30, 0, -0.1).pose, motion[0].pose);
  motion.pop_back();
  EXPECT_EQ(BeforeFirst(motion, 30, 1, -0.1).pose, motion[0].pose);
}

}  // namespace
}  // namespace invsim
