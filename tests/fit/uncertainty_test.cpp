// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>

#include "toy_term.h"

namespace invsim {
namespace {

// Unknown k of a frame is measured with precision weight[k], and nothing else
// is known about it.
class DiagonalTerm : public DataTerm {
 public:
  DiagonalTerm(int frames, const VectorXd& weight) : weights(frames, weight) {}
  int num_frames() const override { return static_cast<int>(weights.size()); }
  Evaluation Evaluate(const BodySequence&,
                      double,
                      std::vector<double>* costs) override {
    costs->assign(num_frames(), 0);
    return Evaluation::kDone;
  }
  bool Linearize(std::vector<FrameBlock>* blocks) override {
    blocks->resize(num_frames());
    for (int t = 0; t < num_frames(); ++t) {
      (*blocks)[t].residual.setZero(kNumBodyParameters);
      (*blocks)[t].jacobian = weights[t].cwiseSqrt().asDiagonal();
    }
    return true;
  }

  std::vector<VectorXd> weights;  // of each frame
};

VectorXd Precision(double all) {
  return VectorXd::Constant(kNumBodyParameters, all);
}

BodySequence Frames(int frames) {
  BodySequence x;
  for (int t = 0; t < frames; ++t) x.Append({});
  return x;
}

Uncertainty Find(const PriorOptions& priors, DiagonalTerm* term) {
  BodySequence x = Frames(term->num_frames());
  Objective objective(priors, {}, term, &x, ToyBody());
  return FindUncertainty(&objective);
}

// Joints that are open in most frames.
std::vector<int> OpenJoints(const Uncertainty& u) {
  std::vector<int> open;
  for (int j = 0; j < kNumJoints; ++j)
    if (u.undetermined_joints[j] > 0.5) open.push_back(j);
  return open;
}

constexpr int kManyFrames = 30;
constexpr int kHead = 15, kLeftElbow = 18;

// Independent measurements and prior: precisions add up.
TEST(Uncertainty, IsThatOfIndependentMeasurements) {
  DiagonalTerm term(2, Precision(400));
  const PriorOptions priors;
  const Uncertainty u = Find(priors, &term);
  ASSERT_EQ(u.failure, "");
  // Both frames measure the shape.
  for (const double d : u.shape_deviation)
    EXPECT_NEAR(
        d,
        1 / std::sqrt(2 * 400 + priors.shape + std::pow(kBroadShape, -2)),
        1e-12);
  ASSERT_EQ(u.pose_deviation.size(), 2u);
  PosePriorVector slope;
  PosePrior(PoseVector::Zero(), &slope);
  for (int i = 3; i < kNumPose; ++i) {
    const double prior = std::pow(slope[2 * (i - 3) + 1], 2) +
                         std::pow(slope[2 * (i - 3)], 2) +
                         std::pow(kBroadAngle, -2);
    EXPECT_NEAR(u.pose_deviation[0][i], 1 / std::sqrt(400 + prior), 1e-12);
  }
  EXPECT_NEAR(u.translation_deviation[1][2],
              1 / std::sqrt(400 + std::pow(kBroadPlace, -2)),
              1e-12);
  EXPECT_EQ(u.undetermined_directions, 0);
  for (const double share : u.undetermined_joints) EXPECT_EQ(share, 0);
  EXPECT_GT(u.seconds, 0);
}

TEST(Uncertainty, NamesWhatTheDataLeaveOpen) {
  VectorXd weight = Precision(1e4);
  weight[4] = 0;  // of the shape
  weight.segment<3>(kNumShape + 3 * kHead).setConstant(1e-6);
  DiagonalTerm term(2, weight);
  const PriorOptions priors;
  const Uncertainty u = Find(priors, &term);
  ASSERT_EQ(u.failure, "");
  EXPECT_EQ(u.undetermined_directions, 1);
  EXPECT_NEAR(std::abs(u.shape_directions(4, 0)), 1, 1e-9);
  EXPECT_NEAR(u.direction_deviation[0],
              1 / std::sqrt(priors.shape + std::pow(kBroadShape, -2)),
              1e-9);
  for (int j = 0; j < kNumJoints; ++j)
    EXPECT_EQ(u.undetermined_joints[j], j == kHead ? 1 : 0) << j;
}

// Smoothness over many frames makes the deviation of a joint small that no
// frame says anything about.
TEST(Uncertainty, IsNotFooledBySmoothness) {
  VectorXd weight = Precision(1e4);
  weight.segment<3>(kNumShape + 3 * kHead).setZero();
  DiagonalTerm term(kManyFrames, weight);
  PriorOptions priors;
  priors.smoothness = 10;
  const Uncertainty u = Find(priors, &term);
  ASSERT_EQ(u.failure, "");
  EXPECT_LT(u.pose_deviation[kManyFrames / 2][3 * kHead], 0.7 * 0.35);
  EXPECT_EQ(OpenJoints(u), std::vector<int>{kHead});
  EXPECT_EQ(u.undetermined_joints[kHead], 1);
  EXPECT_TRUE(u.undetermined_axes[kHead].isZero());
}

// What is seen before and after needs not be seen in between.
TEST(Uncertainty, LetsNeighbouringFramesDetermineAJoint) {
  DiagonalTerm term(kManyFrames, Precision(1e4));
  for (const int t : {10, 11})
    term.weights[t].segment<3>(kNumShape + 3 * kHead).setZero();
  EXPECT_EQ(Find({}, &term).undetermined_joints[kHead], 0);
}

// A twist that points cannot tell is one axis of three.
TEST(Uncertainty, NamesTheAxisIfOnlyThatIsOpen) {
  VectorXd weight = Precision(1e4);
  weight[kNumShape + 3 * kLeftElbow] = 0;
  DiagonalTerm term(kManyFrames, weight);
  const Uncertainty u = Find({}, &term);
  EXPECT_EQ(OpenJoints(u), std::vector<int>{kLeftElbow});
  EXPECT_LT((u.undetermined_axes[kLeftElbow] - Vector3d::UnitX()).norm(), 1e-6);
}

// Without priors nothing is known but what the points say.
TEST(Uncertainty, NeedsNoPriors) {
  PriorOptions none;
  none.shape = none.pose = none.smoothness = 0;
  DiagonalTerm nothing(3, Precision(0));
  const Uncertainty all = Find(none, &nothing);
  ASSERT_EQ(all.failure, "");
  EXPECT_EQ(OpenJoints(all).size(), static_cast<size_t>(kNumJoints));
  EXPECT_EQ(all.undetermined_directions, kNumShape);
  EXPECT_NEAR(all.pose_deviation[0][7], kBroadAngle, 1e-9);

  VectorXd weight = Precision(1e4);
  weight[4] = 0;
  weight.segment<3>(kNumShape + 3 * kHead).setZero();
  DiagonalTerm most(kManyFrames, weight);
  for (const double smoothness : {0, 1}) {
    none.smoothness = smoothness;
    const Uncertainty u = Find(none, &most);
    ASSERT_EQ(u.failure, "");
    EXPECT_EQ(OpenJoints(u), std::vector<int>{kHead});
    EXPECT_EQ(u.undetermined_directions, 1);
  }
}

}  // namespace
}  // namespace invsim
