// SPDX-License-Identifier: Apache-2.0
#include "../../src/fit/prior_costs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "invsim/base/random.h"
#include "invsim/body/mannequin.h"
#include "invsim/body/rotation.h"

namespace invsim {
namespace {

// A cost as Ceres sees it, by blocks of unknowns.
class PriorCost {
 public:
  explicit PriorCost(ceres::CostFunction* cost) : cost_(cost) {}

  VectorXd operator()(const std::vector<VectorXd>& x) const {
    return Evaluate(x, nullptr);
  }
  // Asked for the one block only, as of a frame whose neighbours are fixed.
  VertexRows Derivative(const std::vector<VectorXd>& x, size_t block) const {
    VertexRows j(cost_->num_residuals(), x[block].size());
    std::vector<double*> wanted(x.size(), nullptr);
    wanted[block] = j.data();
    EXPECT_LE((Evaluate(x, wanted.data()) - (*this)(x)).norm(),
              1e-12 * (*this)(x).norm());
    return j;
  }
  void ExpectDerivativesOfDifferences(const std::vector<VectorXd>& x) const {
    constexpr double kStep = 1e-6;
    for (size_t b = 0; b < x.size(); ++b) {
      const VertexRows j = Derivative(x, b);
      for (Eigen::Index i = 0; i < x[b].size(); ++i) {
        std::vector<VectorXd> up = x, down = x;
        up[b][i] += kStep;
        down[b][i] -= kStep;
        const VectorXd d = ((*this)(up) - (*this)(down)) / (2 * kStep);
        EXPECT_LT((j.col(i) - d).norm(), 1e-7 * (1 + j.norm()))
            << b << " " << i;
      }
    }
  }

 private:
  VectorXd Evaluate(const std::vector<VectorXd>& x, double** jacobians) const {
    std::vector<const double*> blocks;
    for (const VectorXd& block : x) blocks.push_back(block.data());
    VectorXd residuals(cost_->num_residuals());
    EXPECT_TRUE(cost_->Evaluate(blocks.data(), residuals.data(), jacobians));
    return residuals;
  }

  std::unique_ptr<ceres::CostFunction> cost_;
};

VectorXd RandomVector(int size, double deviation, std::uint64_t seed) {
  Random random(seed);
  VectorXd v(size);
  for (double& value : v) value = deviation * random.Normal();
  return v;
}

// Three frames of random poses, not far from each other.
std::vector<VectorXd> RandomFrames() {
  const VectorXd pose = RandomVector(kNumPose, 0.7, 1);
  return {pose + RandomVector(kNumPose, 0.2, 2),
          pose,
          pose + RandomVector(kNumPose, 0.2, 3)};
}

// The left forearm through the chest.
std::vector<VectorXd> ArmInChest() {
  VectorXd pose = RandomVector(kNumPose, 0.02, 4);
  pose[3 * 16 + 2] = -1.2;
  pose[3 * 18 + 2] = -1.6;
  return {RandomVector(kNumShape, 0.5, 5), pose};
}

TEST(PriorCosts, DerivativesMatchDifferences) {
  PriorCost(NewRotationSmoothness(3))
      .ExpectDerivativesOfDifferences(RandomFrames());
  PriorCost(NewTranslationSmoothness(3))
      .ExpectDerivativesOfDifferences({RandomVector(3, 1, 1),
                                       RandomVector(3, 1, 2),
                                       RandomVector(3, 1, 3)});
  PriorCost(NewShapePrior(3))
      .ExpectDerivativesOfDifferences({RandomVector(kNumShape, 1, 1)});
  PriorCost(NewPosePrior(3))
      .ExpectDerivativesOfDifferences({RandomVector(kNumPose, 1, 1)});
}

TEST(PriorCosts, DerivativesOfTheOverlapMatchDifferences) {
  const BodyOverlap overlap(Mannequin());
  const PriorCost cost(NewOverlapCost(3, &Mannequin(), &overlap));
  EXPECT_GT(cost(ArmInChest()).maxCoeff(), 3 * 0.03);
  cost.ExpectDerivativesOfDifferences(ArmInChest());
}

// Parts of a body that turns as a whole stay as deep in each other.
TEST(PriorCosts, OverlapDoesNotChangeWithTheHeading) {
  const BodyOverlap overlap(Mannequin());
  const PriorCost cost(NewOverlapCost(1, &Mannequin(), &overlap));
  const std::vector<VectorXd> x = ArmInChest();
  EXPECT_LT(cost.Derivative(x, 1).leftCols(3).norm(), 1e-12);
  std::vector<VectorXd> turned = x;
  turned[1].head<3>() = Vector3d(0.4, 2.5, -0.7);
  EXPECT_LT((cost(turned) - cost(x)).norm(), 1e-12);
}

TEST(PriorCosts, ConstantAccelerationIsWhatSmoothnessMeasures) {
  const Vector3d start(1, 2, 3), velocity(0.1, -0.2, 0.3), a(0.01, 0, -0.02);
  std::vector<VectorXd> places, poses;
  const Vector3d axis = Vector3d(1, 2, -2) / 3;
  for (const double t : {-1.0, 0.0, 1.0}) {
    places.push_back(start + t * velocity + 0.5 * t * t * a);
    poses.push_back(VectorXd::Zero(kNumPose));
    poses.back().segment<3>(3 * 7) = (0.5 + 0.3 * t + 0.02 * t * t) * axis;
  }
  EXPECT_TRUE(
      PriorCost(NewTranslationSmoothness(5))(places).isApprox(5 * a, 1e-12));
  VectorXd expected = VectorXd::Zero(kNumPose);
  expected.segment<3>(3 * 7) = 5 * 0.04 * axis;
  EXPECT_TRUE(
      PriorCost(NewRotationSmoothness(5))(poses).isApprox(expected, 1e-9));
}

// Every joint turns on past half a turn about an axis of its own, where
// vectors jump to the other side.
TEST(PriorCosts, RotationsThatWrapCostNothing) {
  std::vector<VectorXd> poses(3, VectorXd(kNumPose));
  for (int j = 0; j < kNumJoints; ++j) {
    const Vector3d axis = RandomVector(3, 1, j).normalized();
    for (int f = 0; f < 3; ++f)
      poses[f].segment<3>(3 * j) = Log(Exp((3.0 + 0.1 * f) * axis));
  }
  EXPECT_GT((poses[2] - poses[1]).norm(), 20);  // they do jump
  EXPECT_LT(PriorCost(NewRotationSmoothness(1))(poses).norm(), 1e-12);
}

// Nor does it matter where a body faces, or which way time runs.
TEST(PriorCosts, SmoothnessKnowsNoDirectionInSpaceOrTime) {
  const PriorCost cost(NewRotationSmoothness(1));
  std::vector<VectorXd> x = RandomFrames();
  const VectorXd before = cost(x);
  for (VectorXd& pose : x)
    pose.head<3>() =
        Log(Exp(Vector3d(0.4, 2.5, -0.7)) * Exp(Vector3d(pose.head<3>())));
  std::swap(x[0], x[2]);
  EXPECT_LT((cost(x) - before).norm(), 1e-12);
}

// Knees bend up to 2.6 rad; 0.05 rad is one deviation from a limit. Within all
// limits only what is usual costs.
TEST(PriorCosts, LimitsCostWhatIsBeyondThem) {
  const PriorCost cost(NewPosePrior(1));
  VectorXd pose = VectorXd::Zero(kNumPose);
  constexpr int kLeftKneeBend = 3 * 4;
  const int row = 2 * (kLeftKneeBend - 3);
  for (const double bend : {0.3, 2.6, 2.7}) {
    pose[kLeftKneeBend] = bend;
    VectorXd limits = cost({pose}).reshaped(2, kNumPosePrior / 2).row(0);
    EXPECT_NEAR(limits[row / 2], std::max(0.0, (bend - 2.6) / 0.05), 1e-12);
    limits[row / 2] = 0;
    EXPECT_EQ(limits.norm(), 0);
  }
}

// Left and right exchanged: in the mirror y and z change sign.
TEST(PriorCosts, AMirroredPoseCostsTheSame) {
  constexpr int kMirrored[kNumJoints] = {0,  2,  1,  3,  5,  4,  6,  8,
                                         7,  9,  11, 10, 12, 14, 13, 15,
                                         17, 16, 19, 18, 21, 20, 23, 22};
  const PriorCost cost(NewPosePrior(1));
  const VectorXd pose = RandomVector(kNumPose, 1, 6);
  VectorXd mirrored(kNumPose);
  for (int j = 0; j < kNumJoints; ++j)
    mirrored.segment<3>(3 * kMirrored[j]) =
        pose.segment<3>(3 * j).cwiseProduct(Vector3d(1, -1, -1));
  const double norm = cost({pose}).norm();
  EXPECT_GT(norm, 50);  // limits are exceeded
  EXPECT_NEAR(cost({mirrored}).norm(), norm, 1e-12 * norm);
}

// Coefficients are of deviation one.
TEST(PriorCosts, ShapesCostTheirDeviations) {
  const VectorXd beta = RandomVector(kNumShape, 1, 7);
  EXPECT_TRUE(PriorCost(NewShapePrior(1))({beta}).isApprox(beta, 1e-15));
  EXPECT_TRUE(PriorCost(NewShapePrior(2))({beta}).isApprox(2 * beta, 1e-15));
}

}  // namespace
}  // namespace invsim
