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
  explicit DiagonalTerm(VectorXd weight) : weight_(std::move(weight)) {}
  int num_frames() const override { return 2; }
  Evaluation Evaluate(const BodySequence&,
                      double,
                      std::vector<double>* costs) override {
    costs->assign(2, 0);
    return Evaluation::kDone;
  }
  bool Linearize(std::vector<FrameBlock>* blocks) override {
    FrameBlock block;
    block.residual.setZero(kNumBodyParameters);
    block.jacobian = weight_.cwiseSqrt().asDiagonal();
    blocks->assign(2, block);
    return true;
  }

 private:
  VectorXd weight_;
};

BodySequence TwoFrames() {
  BodySequence x;
  x.Append({});
  x.Append({});
  return x;
}

// Independent measurements and prior: precisions add up.
TEST(Uncertainty, IsThatOfIndependentMeasurements) {
  VectorXd weight = VectorXd::Constant(kNumBodyParameters, 400);
  DiagonalTerm term(weight);
  PriorOptions priors;
  BodySequence x = TwoFrames();
  Objective objective(priors, {}, &term, &x, ToyBody());
  const Uncertainty u = FindUncertainty(priors, &objective);
  ASSERT_EQ(u.failure, "");
  // Both frames measure the shape.
  for (const double d : u.shape_deviation)
    EXPECT_NEAR(d, 1 / std::sqrt(2 * 400 + priors.shape), 1e-12);
  ASSERT_EQ(u.pose_deviation.size(), 2u);
  PosePriorVector slope;
  PosePrior(x.poses[0], &slope);
  for (int i = 3; i < kNumPose; ++i) {
    const double prior =
        std::pow(slope[2 * (i - 3) + 1], 2) + std::pow(slope[2 * (i - 3)], 2);
    EXPECT_NEAR(u.pose_deviation[0][i], 1 / std::sqrt(400 + prior), 1e-12);
  }
  EXPECT_NEAR(u.translation_deviation[1][2], 1 / 20.0, 1e-12);
  EXPECT_EQ(u.undetermined_directions, 0);
  for (const double share : u.undetermined_joints) EXPECT_EQ(share, 0);
}

TEST(Uncertainty, NamesWhatTheDataLeaveOpen) {
  VectorXd weight = VectorXd::Constant(kNumBodyParameters, 1e4);
  weight[4] = 0;                                            // of the shape
  weight.segment<3>(kNumShape + 3 * 15).setConstant(1e-6);  // the head
  DiagonalTerm term(weight);
  PriorOptions priors;
  BodySequence x = TwoFrames();
  Objective objective(priors, {}, &term, &x, ToyBody());
  const Uncertainty u = FindUncertainty(priors, &objective);
  ASSERT_EQ(u.failure, "");
  EXPECT_EQ(u.undetermined_directions, 1);
  EXPECT_NEAR(std::abs(u.shape_directions(4, 0)), 1, 1e-9);
  EXPECT_NEAR(u.direction_deviation[0], 1 / std::sqrt(priors.shape), 1e-9);
  for (int j = 1; j < kNumJoints; ++j)
    EXPECT_NEAR(u.undetermined_joints[j], j == 15 ? 1 : 0, 1e-9) << j;
}

TEST(Uncertainty, SaysSoWhenNothingDeterminesAnUnknown) {
  DiagonalTerm term(VectorXd::Zero(kNumBodyParameters));
  PriorOptions priors;
  priors.shape = priors.pose = priors.smoothness = 0;
  BodySequence x = TwoFrames();
  Objective objective(priors, {}, &term, &x, ToyBody());
  EXPECT_NE(FindUncertainty(priors, &objective).failure, "");
}

}  // namespace
}  // namespace invsim
