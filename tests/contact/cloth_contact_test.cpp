// SPDX-License-Identifier: Apache-2.0
#include "invsim/contact/cloth_contact.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>

namespace invsim {
namespace {

constexpr double kStep = 0.005;

ClothContact Source(PairFeature feature) {
  ClothContact source;
  source.feature = feature;
  source.vertex = {0, 1, 2, 3};
  source.side = 1;
  source.thickness = 0.001;
  return source;
}

// Four points whose feature's nearest points lie well within it, 0.8 mm apart.
PairPoints Near(PairFeature feature, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  PairPoints x;
  if (feature == PairFeature::kEdgeEdge) {
    x << -0.01, 0.012, 0.001, -0.002,  //
        0.0008, 0.0008, 0, 0,          //
        0.001, -0.001, -0.011, 0.009;
  } else {
    x << 0.001, -0.01, 0.012, 0,  //
        0.0008, 0, 0, 0,          //
        0.002, -0.004, -0.005, 0.012;
  }
  const Matrix3d turn =
      Eigen::Quaterniond(
          normal(random), normal(random), normal(random), normal(random))
          .normalized()
          .toRotationMatrix();
  return turn *
         (x + 2e-4 * PairPoints::NullaryExpr([&] { return normal(random); }));
}

class ClothPlaneTest : public testing::TestWithParam<PairFeature> {};

TEST_P(ClothPlaneTest, NormalWeightsAndGap) {
  const SelfContactOptions options;
  ClothContact source = Source(GetParam());
  const PairPoints x = Near(GetParam(), 3);
  ClothPlane plane = EvaluateClothPlane(options, kStep, source, x);
  if (plane.distance < 0) {
    source.side = -1;
    plane = EvaluateClothPlane(options, kStep, source, x);
  }
  EXPECT_NEAR(plane.weights.sum(), 0, 1e-14);
  EXPECT_NEAR(plane.normal.norm(), 1, 1e-14);
  EXPECT_GT(plane.distance, 0);
  // The offset is all along the normal: the points are the nearest.
  EXPECT_LT((x * plane.weights - plane.distance * plane.normal).norm(), 1e-15);
  const double approach =
      std::min((0.001 - plane.distance) / kStep, options.recovery_speed);
  EXPECT_LT((plane.velocity - approach * plane.normal).norm(), 1e-12);
}

TEST_P(ClothPlaneTest, DerivativeMatchesDifferences) {
  for (const double recovery : {10.0, 0.001}) {
    const SelfContactOptions options = {.recovery_speed = recovery};
    const ClothContact source = Source(GetParam());
    const PairPoints x = Near(GetParam(), 5);
    const ClothPlaneJacobian jacobian =
        DifferentiateClothPlane(options, kStep, source, x);
    const auto values = [&](const PairPoints& at) {
      const ClothPlane p = EvaluateClothPlane(options, kStep, source, at);
      Eigen::Matrix<double, 10, 1> v;
      v << p.normal, p.velocity, p.weights;
      return v;
    };
    const double h = 1e-7;
    for (int k = 0; k < 12; ++k) {
      PairPoints d = PairPoints::Zero();
      d(k % 3, k / 3) = h;
      const auto once = ((values(x + d) - values(x - d)) / (2 * h)).eval();
      const auto twice =
          ((values(x + 2 * d) - values(x - 2 * d)) / (4 * h)).eval();
      EXPECT_LT((jacobian.col(k) - (4 * once - twice) / 3).norm(),
                1e-6 * (1 + MatrixXd(jacobian).norm()))
          << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Features,
                         ClothPlaneTest,
                         testing::Values(PairFeature::kVertexVertex,
                                         PairFeature::kVertexEdge,
                                         PairFeature::kVertexFace,
                                         PairFeature::kEdgeEdge));

// Two triangles 0.6 mm over each other, the upper one turned.
class ClothContactDetectorTest : public testing::Test {
 protected:
  ClothContactDetectorTest() {
    garment_.placed.resize(3, 6);
    garment_.placed << -0.02, 0.02, 0, -0.015, 0.018, 0.001,  //
        0, 0, 0, 0.0006, 0.0006, 0.0006,                      //
        -0.01, -0.01, 0.02, 0.012, 0.011, -0.017;
    garment_.faces.resize(3, 2);
    garment_.faces << 0, 3, 2, 4, 1, 5;
  }
  void Detect(const Points& v0, const SelfContactOptions& options = {}) {
    detector_ =
        std::make_unique<ClothContactDetector>(SelfContact(garment_, options),
                                               garment_.faces,
                                               VectorXd::Constant(6, 1e-4));
    detector_->Detect(kStep, garment_.placed, v0, &contacts_, &sources_);
  }
  int Count(PairFeature feature) const {
    return static_cast<int>(
        std::ranges::count(sources_, feature, &ClothContact::feature));
  }

  Garment garment_;
  std::unique_ptr<ClothContactDetector> detector_;
  std::vector<Contact> contacts_;
  std::vector<ClothContact> sources_;
};

// A star of six points: every side crosses two sides of the other.
TEST_F(ClothContactDetectorTest, FindsFacesAndEdgesThatAreNear) {
  Detect(Points::Zero(3, 6));
  EXPECT_EQ(Count(PairFeature::kEdgeEdge), 6);
  EXPECT_EQ(Count(PairFeature::kVertexFace), 0);
  EXPECT_EQ(detector_->crossings(), 0);
  ASSERT_EQ(contacts_.size(), sources_.size());
  for (const ClothContact& source : sources_) {
    const Contact& c = contacts_[source.contact];
    EXPECT_FALSE(c.exact());
    EXPECT_NEAR(std::abs(c.normal.y()), 1, 1e-12);
    // 0.4 mm are missing, which at 0.1 m/s takes 4 ms.
    EXPECT_NEAR(c.normal.dot(c.velocity), 0.08, 1e-12);
    // From one triangle to the other, whichever comes first.
    const Vector3d offset = c.Gather(Stacked(garment_.placed));
    EXPECT_NEAR(offset.dot(c.normal), 0.0006, 1e-15);
  }
}

TEST_F(ClothContactDetectorTest, ReachGrowsWithRelativeSpeedOnly) {
  garment_.placed.rightCols(3).row(1).setConstant(0.006);
  Points v0 = Points::Zero(3, 6);
  v0.row(1).setConstant(-3);
  Detect(v0);
  EXPECT_TRUE(contacts_.empty());
  v0.leftCols(3).setZero();
  Detect(v0);
  EXPECT_EQ(contacts_.size(), 6u);
}

TEST_F(ClothContactDetectorTest, SweepFindsWhatWasOutOfReach) {
  garment_.placed.rightCols(3).row(1).setConstant(0.05);
  Detect(Points::Zero(3, 6));
  EXPECT_TRUE(contacts_.empty());
  Points x1 = garment_.placed;
  x1.rightCols(3).row(1).setConstant(0.002);
  EXPECT_EQ(detector_->Sweep(x1, &contacts_, &sources_), 0);
  x1.rightCols(3).row(1).setConstant(-0.2);
  EXPECT_EQ(detector_->Sweep(x1, &contacts_, &sources_), 6);
  EXPECT_EQ(contacts_.size(), 6u);
  // Asked again it renews them.
  EXPECT_EQ(detector_->Sweep(x1, &contacts_, &sources_), 6);
  EXPECT_EQ(contacts_.size(), 6u);
  for (const ClothContact& source : sources_) {
    EXPECT_TRUE(source.swept);
    const Contact& c = contacts_[source.contact];
    // To go on down to the thickness is allowed, no further.
    EXPECT_NEAR(c.normal.dot(c.velocity), -(0.05 - 0.001) / kStep, 1e-6);
  }
  const VectorXd share = detector_->Stop(x1);
  EXPECT_LE(share.maxCoeff(), 0.2);
  EXPECT_GT(share.maxCoeff(), 0.1);
}

// What goes further than it was thought to is stopped as well, though no sweep
// has looked at the way it takes in the end.
TEST_F(ClothContactDetectorTest, StopsWhatNoSweepHasSeen) {
  garment_.placed.rightCols(3).row(1).setConstant(0.05);
  Detect(Points::Zero(3, 6));
  Points x1 = garment_.placed;
  x1.rightCols(3).row(1).setConstant(-0.2);
  const VectorXd share = detector_->Stop(x1);
  const double end = 0.05 - 0.25 * share.tail(3).maxCoeff();
  EXPECT_GT(end, 0);
}

// Pressed together again and again by what no contact force withstands: only
// stopping keeps the layers apart, and does.
TEST_F(ClothContactDetectorTest, StoppingHoldsStepAfterStep) {
  for (int step = 0; step < 400; ++step) {
    Detect(Points::Zero(3, 6));
    ASSERT_EQ(detector_->crossings(), 0) << step;
    Points x1 = garment_.placed;
    for (int i = 3; i < 6; ++i) x1(1, i) -= 0.003;
    const VectorXd share = detector_->Stop(x1);
    for (int i = 3; i < 6; ++i) garment_.placed(1, i) -= 0.003 * share[i];
  }
  const double left = garment_.placed(1, 3);
  EXPECT_GT(left, 1e-8);
  EXPECT_LT(left, 1e-5);
}

TEST_F(ClothContactDetectorTest, LeavesOutWhatCrossesAtTheStart) {
  garment_.placed.rightCols(3).row(1) << -0.01, 0.012, 0.011;
  Detect(Points::Zero(3, 6));
  EXPECT_EQ(detector_->crossings(), 1);
  EXPECT_TRUE(contacts_.empty());
  Points x1 = garment_.placed;
  x1.rightCols(3).row(1).array() += 0.1;
  EXPECT_EQ(detector_->Sweep(x1, &contacts_, &sources_), 0);
}

}  // namespace
}  // namespace invsim
