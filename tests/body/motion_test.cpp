// SPDX-License-Identifier: Apache-2.0
#include "invsim/body/motion.h"

#include <gmock/gmock.h>

#include <Eigen/LU>
#include <numbers>

#include "invsim/base/error.h"
#include "invsim/body/rotation.h"
#include "test_bodies.h"

namespace invsim {
namespace {

constexpr double kHalfTurn = std::numbers::pi;

Motion RandomMotion(int frames, std::mt19937* rng) {
  Motion motion;
  motion.shape = RandomMatrix(kNumShape, 1, 1.0, rng);
  for (int t = 0; t < frames; ++t) {
    motion.poses.push_back(RandomMatrix(kNumPose, 1, 0.6, rng));
    motion.translations.push_back(RandomMatrix(3, 1, 1.0, rng));
  }
  return motion;
}

double PoseDistance(const PoseVector& a, const PoseVector& b) {
  double largest = 0.0;
  for (int j = 0; j < kNumJoints; ++j) {
    largest = std::max(
        largest,
        GeodesicDistance(Exp(a.segment<3>(3 * j)), Exp(b.segment<3>(3 * j))));
  }
  return largest;
}

// One joint turning evenly about y by `step` radians a frame, its vectors
// wrapped to at most half a turn as recordings keep them.
Motion WrappingMotion(int frames, double step) {
  Motion motion;
  motion.frame_rate = 10.0;
  for (int t = 0; t < frames; ++t) {
    PoseVector pose = PoseVector::Zero();
    pose.head<3>() = Log(Exp(Vector3d(0, step * t, 0)));
    motion.poses.push_back(pose);
    motion.translations.emplace_back(t, 0, -2.0 * t);
  }
  return motion;
}

TEST(Motion, TurnedWorldTurnsEveryVertex) {
  std::mt19937 rng(1);
  const BodyModel body(RandomBodyData(60, true, &rng));
  const Motion motion = RandomMotion(4, &rng);
  Motion turned = motion;
  const Matrix3d r = Exp(Vector3d(0.3, -1.2, 0.8));
  TurnWorld(r, body, &turned);
  for (int t = 0; t < motion.num_frames(); ++t) {
    const Points expected = r * body.Vertices(motion.Frame(t));
    EXPECT_LT((body.Vertices(turned.Frame(t)) - expected).norm(), 1e-12);
  }
}

TEST(Motion, ZUpTurnsToYUp) {
  const Matrix3d r = YUpFrom(UpAxis::kZ);
  EXPECT_EQ(Vector3d(r * Vector3d::UnitZ()), Vector3d::UnitY());
  EXPECT_EQ(Vector3d(r * -Vector3d::UnitY()), Vector3d::UnitZ());
  EXPECT_EQ(r.determinant(), 1.0);
  EXPECT_EQ(YUpFrom(UpAxis::kY), Matrix3d::Identity());
}

TEST(Motion, InterpolateTurnsEvenlyTheShortWay) {
  std::mt19937 rng(4);
  const Motion motion = RandomMotion(2, &rng);
  const PoseVector from = motion.poses[0], to = motion.poses[1];
  const PoseVector at =
      Interpolate(motion.Frame(0), motion.Frame(1), 0.25).pose;
  for (int j = 0; j < kNumJoints; ++j) {
    const Matrix3d a = Exp(from.segment<3>(3 * j));
    const Matrix3d b = Exp(to.segment<3>(3 * j));
    const Matrix3d middle = Exp(at.segment<3>(3 * j));
    const double whole = GeodesicDistance(a, b);
    EXPECT_NEAR(GeodesicDistance(a, middle), 0.25 * whole, 1e-9);
    EXPECT_NEAR(GeodesicDistance(middle, b), 0.75 * whole, 1e-9);
  }
  BodyParameters left, right;
  left.pose[1] = 3.0;
  right.pose[1] = -3.0;  // 0.283 rad further, not 6 back
  EXPECT_NEAR(
      std::abs(Interpolate(left, right, 0.5).pose[1]), kHalfTurn, 1e-12);
}

TEST(Motion, InterpolateMeetsBothEnds) {
  std::mt19937 rng(2);
  const BodyParameters a = RandomParameters(0.5, &rng);
  const BodyParameters b = RandomParameters(0.5, &rng);
  EXPECT_LT(PoseDistance(Interpolate(a, b, 0.0).pose, a.pose), 1e-14);
  EXPECT_LT(PoseDistance(Interpolate(a, b, 1.0).pose, b.pose), 1e-14);
  EXPECT_LT((Interpolate(a, b, 1.0).shape - b.shape).norm(), 1e-15);
  EXPECT_LT((Interpolate(a, b, 0.25).translation -
             (0.75 * a.translation + 0.25 * b.translation))
                .norm(),
            1e-15);
}

TEST(Motion, ResampledRotationsRunEvenlyThroughAWrap) {
  const double step = 0.7;
  const Motion motion = WrappingMotion(12, step);
  const Motion fine = Resample(motion, 40.0);
  EXPECT_EQ(fine.frame_rate, 40.0);
  ASSERT_EQ(fine.num_frames(), 45);  // 1.1 s
  for (int k = 0; k < fine.num_frames(); ++k) {
    const Matrix3d expected = Exp(Vector3d(0, step * k / 4.0, 0));
    EXPECT_LT(GeodesicDistance(Exp(fine.poses[k].head<3>()), expected), 1e-13);
    EXPECT_LT((fine.translations[k] - Vector3d(k / 4.0, 0, -k / 2.0)).norm(),
              1e-13);
  }
}

TEST(Motion, ResampledToItsOwnOrALowerRateKeepsFrames) {
  const Motion motion = WrappingMotion(7, 0.3);
  const Motion same = Resample(motion, 10.0);
  ASSERT_EQ(same.num_frames(), 7);
  EXPECT_EQ(same.poses, motion.poses);
  const Motion half = Resample(motion, 5.0);
  ASSERT_EQ(half.num_frames(), 4);
  EXPECT_EQ(half.poses[3], motion.poses[6]);
  // A rate that does not divide: the last frame is not after the old one's.
  EXPECT_EQ(Resample(motion, 7.0).num_frames(), 5);
  EXPECT_THROW(Resample(motion, 0.0), UsageError);
}

TEST(Motion, UnwrappedPosesAreTheSameRotationsWithoutJumps) {
  const Motion motion = WrappingMotion(40, 0.4);
  Motion smooth = motion;
  UnwrapPoses(&smooth);
  for (int t = 0; t < motion.num_frames(); ++t) {
    EXPECT_LT(PoseDistance(smooth.poses[t], motion.poses[t]), 1e-12);
    EXPECT_NEAR(smooth.poses[t][1], 0.4 * t, 1e-12);
  }
  EXPECT_GT(smooth.poses.back()[1], 4 * kHalfTurn);
}

}  // namespace
}  // namespace invsim
