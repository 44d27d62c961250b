// SPDX-License-Identifier: Apache-2.0
#include "invsim/sim/scene_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/test_scene.h"

namespace invsim {
namespace {

constexpr double kMotionRate = 30;  // frames per second

// The ball as a whole, at the given places along x.
std::vector<BodyParameters> AlongX(const std::vector<double>& places) {
  std::vector<BodyParameters> motion(places.size());
  for (size_t t = 0; t < places.size(); ++t)
    motion[t].translation.x() = places[t];
  return motion;
}

class MeasureMotionTest : public ::testing::Test {
 protected:
  SceneMotion Measure(const std::vector<BodyParameters>& motion) {
    return MeasureMotion(
        {body_, sheet_, motion, kMotionRate}, relaxation_, 0.002);
  }

  BodyModel body_ = BallBody();
  Garment sheet_ = SheetAboveBall(6, 0.1);
  RelaxationOptions relaxation_;
};

TEST_F(MeasureMotionTest, OfABodyInFreeFallIsThatOfTheFall) {
  std::vector<double> places;
  for (int t = 0; t < 10; ++t)
    places.push_back(4.9 * t * t / kMotionRate / kMotionRate);
  relaxation_.lead_in_seconds = 0.1;  // so that it does not set out from rest
  const SceneMotion m = Measure(AlongX(places));
  EXPECT_NEAR(m.acceleration, 9.8, 1e-9);
  EXPECT_NEAR(m.speed, 4.9 * (81 - 64) / kMotionRate, 1e-9);
  EXPECT_EQ(m.frames_per_second, kMotionRate);
}

TEST_F(MeasureMotionTest, SettingOutFromRestIsAnAcceleration) {
  const SceneMotion m = Measure(AlongX({0, 0.02, 0.04}));
  EXPECT_NEAR(m.speed, 0.02 * kMotionRate, 1e-9);
  EXPECT_NEAR(m.acceleration, 0.02 * kMotionRate * kMotionRate, 1e-9);
}

TEST_F(MeasureMotionTest, StandingStillIsNone) {
  const SceneMotion m = Measure(AlongX({1, 1, 1}));
  EXPECT_NEAR(m.speed, 0, 1e-12);
  EXPECT_NEAR(m.acceleration, 0, 1e-9);
  // Neither is there anything to dress: where it stands does not count.
  EXPECT_NEAR(m.dressing_acceleration, 0, 1e-6);
}

// The ball swells by a tenth of its radius r in the time T of the dressing, by
// 10 s^3 - 15 s^4 + 6 s^5, whose second derivative is at most 10 / sqrt(3).
TEST_F(MeasureMotionTest, DressingAcceleratesAsItsSmoothPath) {
  std::vector<BodyParameters> motion = AlongX({0, 0});
  for (BodyParameters& frame : motion) frame.shape[0] = 1;
  const double most = 0.1 * kBallRadius * 10 / std::sqrt(3.0) /
                      std::pow(relaxation_.move_seconds, 2);
  EXPECT_NEAR(Measure(motion).dressing_acceleration, most, 0.03 * most);
}

// A tight sheet on a plate cannot reach itself; once the plate is folded so
// that its halves face each other 3 mm apart, it can.
TEST(LayersCanMeet, WhereTheBodyBringsThemTogether) {
  const Garment sheet = Sheet(10, 2, 0.02);
  const VectorXd slack = VectorXd::Constant(sheet.num_vertices(), 0.001);
  Points folded = sheet.placed;
  for (int i = 0; i < folded.cols(); ++i)
    if (folded(0, i) > 0.1) {
      folded(0, i) = 0.2 - folded(0, i);
      folded(2, i) = 0.003;
    }
  EXPECT_FALSE(LayersCanMeet(sheet, {sheet.placed}, slack, 0.002));
  EXPECT_TRUE(LayersCanMeet(sheet, {sheet.placed, folded}, slack, 0.002));
  EXPECT_FALSE(LayersCanMeet(sheet, {sheet.placed, folded}, slack, 0.0005));
}

TEST(LayersCanMeet, WhereTheClothIsLoose) {
  const Garment sheet = Sheet(10, 2, 0.02);
  VectorXd slack = VectorXd::Constant(sheet.num_vertices(), 0.03);
  EXPECT_FALSE(LayersCanMeet(sheet, {sheet.placed}, slack, 0.002));
  slack.setConstant(0.05);
  EXPECT_TRUE(LayersCanMeet(sheet, {sheet.placed}, slack, 0.002));
}

}  // namespace
}  // namespace invsim
