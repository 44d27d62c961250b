// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/gradient_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/sphere_scene.h"
#include "sim/test_scene.h"

namespace invsim {
namespace {

class GradientCheckTest : public testing::Test {
 protected:
  GradientCheckTest() : body_(BallBody()) {
    garment_ = Square(8, 0.3, kBallRadius + 0.01);
    SimulatorSetup setup =
        ClothSetup(garment_, {body_.Vertices({}), body_.faces()});
    setup.step.substeps = 2;
    setup.step.friction.tolerance = 1e-11;
    simulator_ = std::make_unique<Simulator>(std::move(setup));
    state_ = AtRest(garment_);
    const Points rest = body_.Vertices({});
    StepStats stats;
    for (int frame = 0; frame < 10; ++frame)
      EXPECT_TRUE(simulator_->Advance(rest, rest, 1 / 60.0, &state_, &stats));
    p_.translation << 0.003, 0.002, -0.001;
    p_.pose[2] = 0.02;
  }
  BodyModel body_;
  Garment garment_;
  std::unique_ptr<Simulator> simulator_;
  ClothState state_;
  BodyParameters p_;
};

TEST_F(GradientCheckTest, FindsTheDerivativeRight) {
  const GradientCheck check = CheckFrameGradient(
      {}, body_, body_.Vertices({}), p_, 1 / 60.0, state_, simulator_.get());
  // The ball has one shape direction, a root rotation and a translation.
  EXPECT_EQ(check.columns.size(), 7u);
  EXPECT_EQ(check.still, kNumBodyParameters - 7);
  EXPECT_LE(check.switched, 2);
  EXPECT_LT(check.worst, 1e-6);
  EXPECT_EQ(check.median_error.size(), check.steps.size());
}

TEST_F(GradientCheckTest, CountsColumnsWhoseContactsSwitch) {
  GradientCheckOptions options;
  options.steps = {0.02};  // contacts come and go
  const GradientCheck check = CheckFrameGradient(options,
                                                 body_,
                                                 body_.Vertices({}),
                                                 p_,
                                                 1 / 60.0,
                                                 state_,
                                                 simulator_.get());
  EXPECT_GE(check.switched, 4);
  EXPECT_GT(check.worst_switched, check.worst);
}

// As of a joint's vertices that are far from the cloth: what is compared of
// parameters that hardly move the body would be the solver's noise.
TEST_F(GradientCheckTest, WhatMovesLessThanTheNoiseIsStill) {
  const Points at = body_.Vertices(p_);
  const double moves[] = {1, 1e-9};
  MovableBody ball;
  ball.at = at;
  ball.parameters = 2;
  ball.moved = [&](int k, double step) {
    return Points(at.colwise() + step * moves[k] * Vector3d::UnitX());
  };
  ball.jacobian = [&](const std::vector<int>& vertices) {
    Columns columns = Columns::Zero(3 * vertices.size(), 2);
    for (size_t i = 0; i < vertices.size(); ++i)
      for (int k = 0; k < 2; ++k) columns(3 * i, k) = moves[k];
    return columns;
  };
  const auto check = [&](double noise) {
    GradientCheckOptions options;
    options.noise = noise;
    return CheckFrameGradient(
        options, ball, body_.Vertices({}), 1 / 60.0, state_, simulator_.get());
  };
  const GradientCheck told = check(1e-12), blind = check(0);
  EXPECT_EQ(told.still, 1);
  ASSERT_EQ(told.columns.size(), 1u);
  EXPECT_EQ(told.columns[0].parameter, 0);
  EXPECT_LT(told.worst, 1e-6);
  EXPECT_EQ(blind.still, 0);
  EXPECT_GT(blind.worst, 1e-6);
}

// A difference below the noise excuses no column above it.
TEST_F(GradientCheckTest, WhatClaimsToMoveTheClothAndDoesNotIsWrong) {
  const Points at = body_.Vertices(p_);
  MovableBody ball;
  ball.at = at;
  ball.parameters = 1;
  ball.moved = [&](int, double) { return at; };
  ball.jacobian = [&](const std::vector<int>& vertices) {
    Columns columns = Columns::Zero(3 * vertices.size(), 1);
    for (size_t i = 0; i < vertices.size(); ++i) columns(3 * i, 0) = 1;
    return columns;
  };
  GradientCheckOptions options;
  options.noise = 1e-12;
  options.floor = 1e-3;
  const GradientCheck check = CheckFrameGradient(
      options, ball, body_.Vertices({}), 1 / 60.0, state_, simulator_.get());
  ASSERT_EQ(check.compared(), 1);
  EXPECT_GT(check.worst, 1);
}

// A shift of the ball, with a derivative that is not a number.
TEST_F(GradientCheckTest, WhatIsNotANumberIsWorst) {
  const Points at = body_.Vertices(p_);
  MovableBody ball;
  ball.at = at;
  ball.parameters = 2;
  ball.moved = [&](int k, double step) {
    return Points(at.colwise() + step * Vector3d::Unit(k));
  };
  ball.jacobian = [&](const std::vector<int>& vertices) {
    Columns columns = Columns::Zero(3 * vertices.size(), 2);
    for (size_t i = 0; i < vertices.size(); ++i) {
      columns(3 * i, 0) = std::numeric_limits<double>::quiet_NaN();
      columns(3 * i + 1, 1) = 1;
    }
    return columns;
  };
  const GradientCheck check = CheckFrameGradient(
      {}, ball, body_.Vertices({}), 1 / 60.0, state_, simulator_.get());
  EXPECT_TRUE(std::isnan(check.worst) || std::isnan(check.worst_switched));
}

// Far above the ball nothing moves the cloth, and nothing was compared.
TEST_F(GradientCheckTest, WithoutContactNothingIsCompared) {
  state_.x.row(1).array() += 1;
  const GradientCheck check = CheckFrameGradient(
      {}, body_, body_.Vertices({}), p_, 1 / 60.0, state_, simulator_.get());
  EXPECT_EQ(check.compared(), 0);
  EXPECT_EQ(check.still, kNumBodyParameters);
}

}  // namespace
}  // namespace invsim
