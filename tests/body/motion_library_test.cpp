// SPDX-License-Identifier: Apache-2.0
#include "invsim/body/motion_library.h"

#include <gmock/gmock.h>

#include <cmath>

#include "invsim/base/error.h"
#include "invsim/body/mannequin.h"

namespace invsim {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class EveryMotion : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryMotion, HasTheLengthAskedForAndADescription) {
  const Motion motion = MakeMotion(GetParam(), 17, 25.0);
  EXPECT_EQ(motion.num_frames(), 17);
  EXPECT_EQ(motion.translations.size(), 17u);
  EXPECT_EQ(motion.frame_rate, 25.0);
  EXPECT_FALSE(MotionDescription(GetParam()).empty());
}

TEST_P(EveryMotion, DoesNotDependOnTheFrameRate) {
  const Motion slow = MakeMotion(GetParam(), 91, 30.0);
  const Motion fast = MakeMotion(GetParam(), 361, 120.0);
  for (int t = 0; t < 91; ++t) {
    EXPECT_LT((slow.poses[t] - fast.poses[4 * t]).norm(), 1e-12);
    EXPECT_LT((slow.translations[t] - fast.translations[4 * t]).norm(), 1e-12);
  }
}

// Nothing jumps: no vertex accelerates beyond 40 m/s^2 or starts off moving.
TEST_P(EveryMotion, IsSmoothAndStartsFromRest) {
  const double rate = 100.0;
  const Motion motion = MakeMotion(GetParam(), 501, rate);
  const BodyModel& body = Mannequin();
  Points before = body.Joints(motion.Frame(0));
  Points now = body.Joints(motion.Frame(1));
  EXPECT_LT((now - before).cwiseAbs().maxCoeff() * rate, 0.05);
  for (int t = 2; t < motion.num_frames(); ++t) {
    const Points next = body.Joints(motion.Frame(t));
    const Points acceleration = (next - 2.0 * now + before) * rate * rate;
    EXPECT_LT(acceleration.colwise().norm().maxCoeff(), 40.0) << t;
    before = now;
    now = next;
  }
}

TEST_P(EveryMotion, KeepsTheFeetOnTheFloor) {
  const Motion motion = MakeMotion(GetParam(), 100, 20.0);
  const BodyModel& body = Mannequin();
  const double floor = body.Vertices({}).row(1).minCoeff();
  for (int t = 0; t < motion.num_frames(); ++t) {
    EXPECT_NEAR(body.Vertices(motion.Frame(t)).row(1).minCoeff(), floor, 0.015)
        << t;
  }
}

INSTANTIATE_TEST_SUITE_P(All,
                         EveryMotion,
                         ::testing::ValuesIn(MotionNames()),
                         [](const auto& param) { return param.param; });

TEST(MotionLibrary, ArmsStartInTheTPose) {
  EXPECT_EQ(MakeMotion("arms_down_and_swing", 1).poses[0].norm(), 0.0);
}

TEST(MotionLibrary, TurnGoesRoundMoreThanOnce) {
  const Motion motion = MakeMotion("turn", 301);
  EXPECT_GT(motion.poses.back()[1], 4 * M_PI);
  EXPECT_NEAR(motion.poses[300][1] - motion.poses[270][1], M_PI / 2, 1e-9);
}

TEST(MotionLibrary, SquatGoesDown) {
  const Motion motion = MakeMotion("squat", 90);
  const BodyModel& body = Mannequin();
  const double standing = body.Joints(motion.Frame(0))(1, 0);
  const double low = body.Joints(motion.Frame(42))(1, 0);
  EXPECT_GT(standing - low, 0.25);
}

TEST(MotionLibrary, UnknownNamesAndLengthsAreRefused) {
  EXPECT_THAT([] { MakeMotion("sqat", 10); },
              ThrowsMessage<UsageError>(HasSubstr("squat")));
  EXPECT_THROW(MotionDescription("dance"), UsageError);
  EXPECT_THROW(MakeMotion("turn", 0), UsageError);
  EXPECT_THROW(MakeMotion("turn", 10, -1.0), UsageError);
}

}  // namespace
}  // namespace invsim
