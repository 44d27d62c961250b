// SPDX-License-Identifier: Apache-2.0
// The planes of contacts of the cloth with itself; that derivatives match
// differences is in cloth_contact_test.cpp.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "invsim/contact/cloth_contact.h"

namespace invsim {
namespace {

constexpr double kPairStep = 0.004;  // s
constexpr PairFeature kEveryFeature[] = {PairFeature::kVertexVertex,
                                         PairFeature::kVertexEdge,
                                         PairFeature::kVertexFace,
                                         PairFeature::kEdgeEdge};

ClothContact ContactOf(PairFeature feature, double side = 1) {
  return {.contact = 0,
          .feature = feature,
          .vertex = {0, 1, 2, 3},
          .side = side,
          .thickness = 0.001};
}

// A vertex, or an edge along x, 1.8 mm above the rest.
PairPoints Above(PairFeature feature) {
  PairPoints x;
  switch (feature) {
    case PairFeature::kVertexVertex:
      x << 0, 0, 0, 0, 0.0018, 0, 0, 0, 0, 0, 0, 0;
      break;
    case PairFeature::kVertexEdge:
      x << 0, 0, 0, 0, 0.0018, 0, 0, 0, 0, -0.005, 0.015, 0;
      break;
    case PairFeature::kVertexFace:
      x << 0, -0.01, 0, 0.01, 0.0018, 0, 0, 0, 0, -0.01, 0.02, -0.01;
      break;
    case PairFeature::kEdgeEdge:
      x << -0.01, 0.01, 0, 0, 0.0018, 0.0018, 0, 0, 0, 0, 0.01, -0.01;
      break;
  }
  return x;
}

int NumAbove(PairFeature feature) {
  return feature == PairFeature::kEdgeEdge ? 2 : 1;
}

TEST(ClothPlane, VertexOverAFaceHasItsBarycentricWeights) {
  const Vector3d a(0.01, 0, 0.02), b(0.01, 0, 0.05), c(0.06, 0, 0.02);
  const Vector3d foot = 0.5 * a + 0.3 * b + 0.2 * c;
  PairPoints x;
  x << foot + Vector3d(0, 0.0008, 0), a, b, c;
  const SelfContactOptions options;
  const ClothPlane front = EvaluateClothPlane(
      options, kPairStep, ContactOf(PairFeature::kVertexFace), x);
  EXPECT_TRUE(
      front.weights.isApprox(Eigen::Vector4d(1, -0.5, -0.3, -0.2), 1e-12));
  EXPECT_TRUE(front.normal.isApprox(Vector3d(0, 1, 0), 1e-12));
  EXPECT_NEAR(front.distance, 0.0008, 1e-15);
  // Of the other side it is 0.8 mm behind the face: back as fast as may be.
  const ClothPlane behind = EvaluateClothPlane(
      options, kPairStep, ContactOf(PairFeature::kVertexFace, -1), x);
  EXPECT_NEAR(behind.distance, -0.0008, 1e-15);
  EXPECT_TRUE(
      behind.velocity.isApprox(Vector3d(0, -options.recovery_speed, 0), 1e-12));
}

TEST(ClothPlane, EdgesThatCrossHaveTheSharesOfTheirNearestPoints) {
  PairPoints x;  // three quarters along the first, a fifth along the second
  x << -0.03, 0.01, 0, 0, 0.0005, 0.0005, 0, 0, 0, 0, -0.01, 0.04;
  const ClothPlane plane = EvaluateClothPlane(
      {}, kPairStep, ContactOf(PairFeature::kEdgeEdge, -1), x);
  EXPECT_TRUE(
      plane.weights.isApprox(Eigen::Vector4d(0.25, 0.75, -0.8, -0.2), 1e-12));
  EXPECT_TRUE(plane.normal.isApprox(Vector3d(0, 1, 0), 1e-12));
  EXPECT_NEAR(plane.distance, 0.0005, 1e-15);
}

// What may still be approached takes exactly one step; what is missing too,
// unless it takes longer at the recovery speed.
TEST(ClothPlane, MovingAsAllowedEndsAtTheThickness) {
  for (const PairFeature feature : kEveryFeature)
    for (const double thickness : {0.001, 0.002}) {
      const PairPoints start = Above(feature);
      ClothContact contact = ContactOf(feature);
      contact.thickness = thickness;
      const ClothPlane plane =
          EvaluateClothPlane({}, kPairStep, contact, start);
      EXPECT_NEAR(plane.distance, 0.0018, 1e-15);
      PairPoints end = start;
      end.leftCols(NumAbove(feature)).colwise() += kPairStep * plane.velocity;
      EXPECT_NEAR(EvaluateClothPlane({}, kPairStep, contact, end).distance,
                  thickness,
                  1e-15);
    }
}

// All vertices moved together change nothing; turned together they turn the
// plane and leave the weights.
TEST(ClothPlane, ItsDerivativeKnowsRigidMotions) {
  const Vector3d turn(0.3, -0.5, 0.8);
  const Matrix3d placed =
      Eigen::Quaterniond(0.4, 0.1, -0.7, 0.2).normalized().toRotationMatrix();
  for (const PairFeature feature : kEveryFeature) {
    const PairPoints x = placed * Above(feature);
    const ClothContact contact = ContactOf(feature);
    const ClothPlane plane = EvaluateClothPlane({}, kPairStep, contact, x);
    const ClothPlaneJacobian jacobian =
        DifferentiateClothPlane({}, kPairStep, contact, x);
    PairPoints moved, turned;
    for (int k = 0; k < 4; ++k) {
      moved.col(k) = turn;
      turned.col(k) = turn.cross(Vector3d(x.col(k)));
    }
    const double rounding = 1e-12 * MatrixXd(jacobian).norm();
    EXPECT_LT((jacobian * moved.reshaped()).norm(), rounding);
    Eigen::Matrix<double, 10, 1> expected;
    expected << turn.cross(plane.normal), turn.cross(plane.velocity),
        Eigen::Vector4d::Zero();
    EXPECT_LT((jacobian * turned.reshaped() - expected).norm(), rounding);
  }
}

}  // namespace
}  // namespace invsim
