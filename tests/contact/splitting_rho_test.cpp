// SPDX-License-Identifier: Apache-2.0
#include "../../src/contact/splitting_rho.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace invsim {
namespace {

const Vector3d kNormal = Vector3d(1, 2, -2) / 3;
const Vector3d kAcross = kNormal.cross(Vector3d::UnitX()).normalized();

class SplittingRhoTest : public testing::Test {
 protected:
  SplittingRhoTest() {
    contact_.normal = kNormal;
    contact_.friction = 0.5;
  }
  Scaling Fitted(ContactMode mode, const Vector3d& r, const Vector3d& u) {
    return FittedRho(contact_, guess_, mode, r, u);
  }
  Contact contact_;
  const Scaling guess_{kNormal, 4, 0.5};
};

TEST_F(SplittingRhoTest, PowersAreThoseOfTheMatrix) {
  const SplittingRho rho(guess_);
  const Matrix3d m = guess_.matrix();
  EXPECT_LT((m * kNormal - 4 * kNormal).norm(), 1e-15);
  EXPECT_LT((m * kAcross - 0.5 * kAcross).norm(), 1e-15);
  EXPECT_LT((rho.inverse.matrix() - m.inverse()).norm(), 1e-14);
  EXPECT_LT((rho.root.matrix() * rho.root.matrix() - m).norm(), 1e-14);
  EXPECT_LT(
      (rho.inverse_root.matrix() * rho.root.matrix() - Matrix3d::Identity())
          .norm(),
      1e-14);
  const Vector3d x(0.3, -0.2, 0.7);
  EXPECT_LT((guess_ * x - m * x).norm(), 1e-15);
}

// Two vertices that share a contact by halves respond as two springs in line
// do: with the sum of the squares of their weights over their stiffnesses.
TEST_F(SplittingRhoTest, VerticesAloneRespondWithTheirOwnDiagonal) {
  BlockPatternBuilder builder(2);
  BlockMatrix a(builder.Build());
  a.diagonal(0) = 2 * Matrix3d::Identity();
  a.diagonal(1) = 5 * Matrix3d::Identity() + 3 * kNormal * kNormal.transpose();
  contact_.num_vertices = 2;
  contact_.vertex = {0, 1};
  contact_.weight = {0.5, 0.5};
  contact_.compliance = 0.01;
  const OwnCompliance own = ComplianceAlone(a, contact_);
  EXPECT_NEAR(own.normal, 0.01 + 0.25 / 2 + 0.25 / 8, 1e-15);
  EXPECT_NEAR(own.tangent, 0.01 + 0.25 / 2 + 0.25 / 5, 1e-15);
  EXPECT_NEAR(own.mean, 0.01 + 0.25 / 2 + 0.25 / 6, 1e-15);
  const Scaling once = GuessedRho(contact_, own, 1);
  const Scaling tenth = GuessedRho(contact_, own, 0.1);
  EXPECT_NEAR(once.normal / tenth.normal, 10, 1e-12);
  EXPECT_NEAR(once.tangent / tenth.tangent, 10, 1e-12);
}

TEST_F(SplittingRhoTest, WhatHoldsIsFirmAndWhatIsOpenIsNot) {
  const Vector3d r = 2 * kNormal;
  const Scaling stick = Fitted(ContactMode::kStick, r, Vector3d::Zero());
  EXPECT_GT(stick.normal, guess_.normal);
  EXPECT_GT(stick.tangent, guess_.tangent);
  const Scaling open =
      Fitted(ContactMode::kOpen, Vector3d::Zero(), 0.1 * kNormal);
  EXPECT_LT(open.normal, guess_.normal);
  EXPECT_LT(open.tangent, guess_.tangent);
}

// Friction of 1 N at a slip of 0.4 m/s turns as a spring of 2.5 kg/s would.
TEST_F(SplittingRhoTest, SlidingFrictionIsAsStiffAsItTurns) {
  const Vector3d r = 2 * kNormal - 1 * kAcross;
  const Scaling slide =
      Fitted(ContactMode::kSlide, r, 0.4 * kAcross + 0.3 * kNormal);
  EXPECT_NEAR(slide.tangent, 2.5, 1e-12);
  EXPECT_GT(slide.normal, guess_.normal);
}

TEST_F(SplittingRhoTest, StaysWithinBoundsAtAnySlip) {
  const Vector3d r = 2 * kNormal;
  const double stick = Fitted(ContactMode::kStick, r, Vector3d::Zero()).tangent;
  EXPECT_EQ(Fitted(ContactMode::kSlide, r, Vector3d::Zero()).tangent, stick);
  const Scaling fast = Fitted(ContactMode::kSlide, r, 1e9 * kAcross);
  EXPECT_GT(fast.tangent, 0.01 * guess_.tangent);
  EXPECT_LT(fast.tangent, guess_.tangent);
  contact_.friction = 0;
  EXPECT_EQ(Fitted(ContactMode::kSlide, r, kAcross).tangent, fast.tangent);
}

// A tenth of what the contact resists with itself, if that is more.
TEST_F(SplittingRhoTest, WhatIsStiffItselfIsHeldAccordingly) {
  const Vector3d r = 2 * kNormal;
  const Scaling exact = Fitted(ContactMode::kStick, r, Vector3d::Zero());
  contact_.compliance = 1e-5;
  const Scaling stiff = Fitted(ContactMode::kStick, r, Vector3d::Zero());
  EXPECT_NEAR(stiff.normal, 1e4, 1e-9);
  EXPECT_NEAR(stiff.tangent, 1e4, 1e-9);
  contact_.compliance = 1;
  const Scaling soft = Fitted(ContactMode::kStick, r, Vector3d::Zero());
  EXPECT_EQ(soft.normal, exact.normal);
  EXPECT_EQ(soft.tangent, exact.tangent);
}

TEST_F(SplittingRhoTest, PinsKeepTheirs) {
  contact_.kind = ContactKind::kPin;
  const Scaling pin =
      Fitted(ContactMode::kStick, Vector3d::Ones(), Vector3d::Zero());
  EXPECT_EQ(pin.normal, guess_.normal);
  EXPECT_EQ(pin.tangent, guess_.tangent);
}

}  // namespace
}  // namespace invsim
