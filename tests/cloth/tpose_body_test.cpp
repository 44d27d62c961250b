// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/tpose_body.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cloth/capsule_body.h"
#include "invsim/base/error.h"

namespace invsim {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class TPoseBodyTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { good_ = new TPoseBody(CapsuleBody()); }
  static void TearDownTestSuite() { delete good_; }

  void ExpectError(const std::string& text) {
    EXPECT_THAT([&] { ValidateTPoseBody(body_); },
                ThrowsMessage<InputError>(HasSubstr(text)));
  }
  static TPoseBody* good_;
  TPoseBody body_ = *good_;
};
TPoseBody* TPoseBodyTest::good_ = nullptr;

TEST_F(TPoseBodyTest, GoodBodyPasses) {
  EXPECT_NO_THROW(ValidateTPoseBody(body_));
}

TEST_F(TPoseBodyTest, FacesBelongToTheirLimbs) {
  const auto arm = FacesOf(body_, {16, 18, 20, 22});
  const auto trunk = FacesOf(body_, {0, 9, 12, 13, 14});
  int arms = 0;
  for (int f = 0; f < body_.faces.cols(); ++f) {
    if (!arm[f]) continue;
    ++arms;
    EXPECT_FALSE(trunk[f]);
    for (int c = 0; c < 3; ++c)
      EXPECT_GT(body_.vertices(0, body_.faces(c, f)), 0.1);
  }
  EXPECT_GT(arms, 100);
}

TEST_F(TPoseBodyTest, WrongAxis) {
  body_.vertices.row(1).swap(body_.vertices.row(2));
  body_.vertices.row(1) *= -1.0;
  body_.joints.row(1).swap(body_.joints.row(2));
  body_.joints.row(1) *= -1.0;
  ExpectError("expected a body standing along +y");
}
TEST_F(TPoseBodyTest, FacingBackwards) {
  body_.vertices.row(0) *= -1.0;
  body_.vertices.row(2) *= -1.0;
  body_.joints.row(0) *= -1.0;
  ExpectError("left arm is not along +x");
}
TEST_F(TPoseBodyTest, ArmsDown) {
  body_.joints.col(20) = body_.joints.col(16) + Vector3d(0.1, -0.4, 0);
  ExpectError("left arm is not along +x, expected the T-pose");
}
TEST_F(TPoseBodyTest, InsideOut) {
  body_.faces.row(0).swap(body_.faces.row(1));
  ExpectError("faces point inwards");
}
TEST_F(TPoseBodyTest, OpenMesh) {
  body_.faces = body_.faces.leftCols(body_.faces.cols() - 1).eval();
  ExpectError("expected a closed mesh");
}
TEST_F(TPoseBodyTest, JointsMissing) {
  body_.joints = body_.joints.leftCols(22).eval();
  ExpectError("22 joints, expected 24");
}
TEST_F(TPoseBodyTest, WeightsOfAnotherBody) {
  body_.weights = body_.weights.topRows(100).eval();
  ExpectError("weights are 100 x 24");
}

}  // namespace
}  // namespace invsim
