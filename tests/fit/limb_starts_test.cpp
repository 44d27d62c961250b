// SPDX-License-Identifier: Apache-2.0
#include "../../src/fit/limb_starts.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "invsim/body/mannequin.h"

namespace invsim {
namespace {

constexpr int kAnkle[2] = {7, 8}, kWrist[2] = {20, 21};

// Where joints are in a start from the T-pose, relative to the pelvis.
Points JointsOf(const LimbStart& start) {
  const Points joints = Mannequin().Joints(start.From(BodyParameters{}));
  const Vector3d pelvis = joints.col(0);
  return joints.colwise() - pelvis;
}

bool Moves(const Limb& limb, int joint) {
  return std::count(limb.joints.begin(), limb.joints.end(), joint) > 0;
}

TEST(LimbStarts, TurnOnlyJointsThatMayMove) {
  for (const Limb& limb : Limbs())
    for (const LimbStart& start : limb.starts)
      for (const LimbStart::Turn& turn : start.turns)
        EXPECT_TRUE(Moves(limb, turn.joint)) << turn.joint;
}

TEST(LimbStarts, LeaveTheRestOfTheBodyAsItWas) {
  BodyParameters body;
  body.pose.setConstant(0.2);
  for (const Limb& limb : Limbs())
    for (const LimbStart& start : limb.starts) {
      const PoseVector pose = start.From(body).pose;
      for (int j = 0; j < kNumJoints; ++j) {
        if (Moves(limb, j)) continue;
        EXPECT_EQ(pose.segment<3>(3 * j), body.pose.segment<3>(3 * j));
      }
    }
}

// Left and right are mirror images: what one arm does alone, the other does.
TEST(LimbStarts, SidesAreMirrorImages) {
  const std::vector<Limb> limbs = Limbs();
  int pairs = 0;
  for (const Limb& left : limbs)
    for (const Limb& right : limbs)
      for (const int* end : {kAnkle, kWrist}) {
        if (!Moves(left, end[0]) || Moves(left, end[1])) continue;
        if (!Moves(right, end[1]) || Moves(right, end[0])) continue;
        ++pairs;
        ASSERT_EQ(left.starts.size(), right.starts.size());
        for (size_t k = 0; k < left.starts.size(); ++k) {
          Vector3d mirrored = JointsOf(right.starts[k]).col(end[1]);
          mirrored.x() = -mirrored.x();
          EXPECT_LT((JointsOf(left.starts[k]).col(end[0]) - mirrored).norm(),
                    1e-3);
        }
      }
  EXPECT_EQ(pairs, 2);
}

// Legs that took each other's place need a start with either one in front.
TEST(LimbStarts, BothLegsStrideEitherWay) {
  bool forward[2] = {false, false};
  for (const Limb& limb : Limbs()) {
    if (!Moves(limb, kAnkle[0]) || !Moves(limb, kAnkle[1])) continue;
    EXPECT_TRUE(Moves(limb, 0));
    for (const LimbStart& start : limb.starts) {
      const Points joints = JointsOf(start);
      const double ahead = joints(2, kAnkle[0]) - joints(2, kAnkle[1]);
      if (std::abs(ahead) > 0.3) forward[ahead < 0] = true;
    }
  }
  EXPECT_TRUE(forward[0] && forward[1]);
}

}  // namespace
}  // namespace invsim
