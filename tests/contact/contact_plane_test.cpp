// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>

#include "invsim/contact/body_contact.h"

namespace invsim {
namespace {

constexpr double kPlaneStep = 0.005;

TEST(ContactPlane, RestingAboveAFaceAtRest) {
  BodyContactOptions options;
  Matrix3d corners;
  corners << 0, 0, 1, 0, 0, 0, 0, 1, 0;  // in the plane y = 0, facing up
  const ContactPlane plane = EvaluateContactPlane(options,
                                                  kPlaneStep,
                                                  TriangleFeature::kFace,
                                                  1,
                                                  {0.2, 0.005, 0.3},
                                                  corners,
                                                  corners);
  EXPECT_LT((plane.normal - Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_NEAR(plane.distance, 0.005, 1e-15);
  // It may fall by 3 mm within the step, no faster.
  EXPECT_LT((plane.velocity - Vector3d(0, -0.003 / kPlaneStep, 0)).norm(),
            1e-12);
}

TEST(ContactPlane, MovesRigidlyWithTheFace) {
  BodyContactOptions options;
  Matrix3d corners;
  corners << 0, 0, 1, 0, 0, 0, 0, 1, 0;
  const Vector3d velocity(0.3, -1.2, 0.7);
  const Matrix3d moved = corners.colwise() + Vector3d(kPlaneStep * velocity);
  const ContactPlane plane = EvaluateContactPlane(options,
                                                  kPlaneStep,
                                                  TriangleFeature::kFace,
                                                  1,
                                                  {0.2, options.thickness, 0.3},
                                                  corners,
                                                  moved);
  EXPECT_LT((plane.velocity - velocity).norm(), 1e-12);
}

TEST(ContactPlane, LeadsOutNoFasterThanTheRecoverySpeed) {
  BodyContactOptions options;
  Matrix3d corners;
  corners << 0, 0, 1, 0, 0, 0, 0, 1, 0;
  const ContactPlane plane = EvaluateContactPlane(options,
                                                  kPlaneStep,
                                                  TriangleFeature::kFace,
                                                  -1,
                                                  {0.2, -0.03, 0.3},
                                                  corners,
                                                  corners);
  EXPECT_NEAR(plane.distance, -0.03, 1e-15);
  EXPECT_NEAR(plane.velocity.y(), options.recovery_speed, 1e-15);
}

class ContactPlaneDerivative : public testing::TestWithParam<TriangleFeature> {
};

TEST_P(ContactPlaneDerivative, MatchesDifferences) {
  BodyContactOptions options;
  options.recovery_speed = 100;
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const TriangleFeature feature = GetParam();
  for (int trial = 0; trial < 10; ++trial) {
    Eigen::Matrix<double, 21, 1> z, dz;
    for (int k = 0; k < 21; ++k) z[k] = 0.1 * normal(random);
    for (int k = 0; k < 9; ++k) z[12 + k] = z[3 + k] + 0.005 * normal(random);
    for (int k = 0; k < 21; ++k) dz[k] = normal(random);
    const auto evaluate = [&](double s) {
      const Eigen::Matrix<double, 21, 1> p = z + s * dz;
      const ContactPlane plane =
          EvaluateContactPlane(options,
                               kPlaneStep,
                               feature,
                               1,
                               p.head<3>(),
                               Eigen::Map<const Matrix3d>(p.data() + 3),
                               Eigen::Map<const Matrix3d>(p.data() + 12));
      Eigen::Matrix<double, 6, 1> out;
      out << plane.normal, plane.velocity;
      return out;
    };
    const ContactPlaneJacobian jacobian =
        DifferentiateContactPlane(options,
                                  kPlaneStep,
                                  feature,
                                  1,
                                  z.head<3>(),
                                  Eigen::Map<const Matrix3d>(z.data() + 3),
                                  Eigen::Map<const Matrix3d>(z.data() + 12));
    const double h = 1e-6;
    const Eigen::Matrix<double, 6, 1> numeric =
        (8 * (evaluate(h) - evaluate(-h)) -
         (evaluate(2 * h) - evaluate(-2 * h))) /
        (12 * h);
    EXPECT_LT((jacobian * dz - numeric).norm(), 1e-6 * numeric.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(Features,
                         ContactPlaneDerivative,
                         testing::Values(TriangleFeature::kVertex1,
                                         TriangleFeature::kEdge0,
                                         TriangleFeature::kEdge2,
                                         TriangleFeature::kFace));

}  // namespace
}  // namespace invsim
