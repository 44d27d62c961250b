// SPDX-License-Identifier: Apache-2.0
// Every registered effect, on every kind of material and state: force against
// energy, stiffness against its promise, tangent against differences.
#include "invsim/cloth/effect_registry.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <numbers>
#include <tuple>

#include "invsim/cloth/elastic_effect.h"
#include "test_cloth.h"

namespace invsim {
namespace {

constexpr double kCell = 0.03;  // m
constexpr double kStep = 1e-5 * kCell;

enum class Shape { kNoise, kTension, kCompression, kShear, kFold, kRest };

std::string NameOf(Shape shape) {
  switch (shape) {
    case Shape::kNoise:
      return "Noise";
    case Shape::kTension:
      return "Tension";
    case Shape::kCompression:
      return "Compression";
    case Shape::kShear:
      return "Shear";
    case Shape::kFold:
      return "Fold";
    case Shape::kRest:
      return "Rest";
  }
  return "";
}

// The sheet folded along its middle column by 0.97 of a half turn.
void Fold(double crease, Points* x) {
  const double angle = 0.97 * std::numbers::pi;
  for (int i = 0; i < x->cols(); ++i) {
    const double beyond = (*x)(0, i) - crease;
    if (beyond <= 1e-9) continue;
    (*x)(0, i) = crease + beyond * std::cos(angle);
    (*x)(2, i) += beyond * std::sin(angle);
  }
}

ClothState MakeState(const Garment& garment, Shape shape) {
  ClothState y;
  y.x = garment.placed;
  y.v = RandomPoints(garment.num_vertices(), 1.0, 7);
  const Points noise = RandomPoints(garment.num_vertices(), kCell, 8);
  switch (shape) {
    case Shape::kNoise:
      y.x += 0.15 * noise;
      break;
    case Shape::kTension:
      y.x.row(0) *= 1.12;
      y.x.row(1) *= 1.08;
      y.x += 0.02 * noise;
      break;
    case Shape::kCompression:
      y.x.row(0) *= 0.9;
      y.x.row(1) *= 0.85;
      y.x += 0.02 * noise;
      break;
    case Shape::kShear:
      y.x.row(0) += 0.3 * garment.placed.row(1);
      y.x += 0.02 * noise;
      break;
    case Shape::kFold:
      Fold(garment.placed.row(0).maxCoeff() / 2.0, &y.x);
      y.x += 0.02 * noise;
      break;
    case Shape::kRest:
      break;
  }
  return y;
}

Eigen::Matrix3d SomeRotation() {
  return Eigen::AngleAxisd(1.1, Vector3d(0.3, -0.7, 0.5).normalized())
      .toRotationMatrix();
}

double Scale(const MatrixXd& m) {
  return std::max(m.cwiseAbs().maxCoeff(), 0.);
}

using Param = std::tuple<std::string, int, Shape>;

class EveryEffect : public testing::TestWithParam<Param> {
 protected:
  EveryEffect()
      : garment_(Sheet(4, 2, kCell, 0.2)),
        material_(ExampleMaterials()[std::get<1>(GetParam())]),
        state_(MakeState(garment_, std::get<2>(GetParam()))),
        effect_(Effects()
                    .Choose(std::get<0>(GetParam()))
                    ->Make(garment_, material_)),
        pattern_(BindAlone(effect_.get(), garment_.num_vertices())) {}

  bool at_rest() const { return std::get<2>(GetParam()) == Shape::kRest; }

  // -df/dx or -df/dv by differences.
  MatrixXd MinusForceSlope(bool by_velocity) const {
    const Points& at = by_velocity ? state_.v : state_.x;
    return Jacobian(
        [&](const Points& p) -> VectorXd {
          ClothState y = state_;
          (by_velocity ? y.v : y.x) = p;
          return -Stacked(ForceOf(*effect_, y));
        },
        at,
        by_velocity ? 1e-4 : kStep);
  }

  // g(y) of Effect with dx, dv fixed.
  VectorXd G(const ClothState& y, const Points& dx, const Points& dv) const {
    return -Stacked(ForceOf(*effect_, y)) +
           StiffnessOf(*effect_, pattern_, y, 1.0, 0.0) * Stacked(dx) +
           StiffnessOf(*effect_, pattern_, y, 0.0, 1.0) * Stacked(dv);
  }

  void ExpectTangent(const Points& dx, const Points& dv) const {
    BlockMatrix h_x(pattern_), h_v(pattern_);
    h_x.SetZero();
    h_v.SetZero();
    effect_->AddTangent(state_, dx, dv, 2.0, &h_x, &h_v);
    const MatrixXd by_x = Jacobian(
        [&](const Points& x) {
          return G({x, state_.v}, dx, dv);
        },
        state_.x,
        kStep);
    const MatrixXd by_v = Jacobian(
        [&](const Points& v) {
          return G({state_.x, v}, dx, dv);
        },
        state_.v,
        1e-4);
    // A measured law goes by the size of the strain, which has a kink at
    // rest: the differences are then right to first order only.
    const double tolerance = at_rest() ? 1e-4 : 2e-8;
    EXPECT_LE(Scale(Dense(h_x) - 2.0 * by_x), tolerance * Scale(by_x) + 1e-12);
    EXPECT_LE(Scale(Dense(h_v) - 2.0 * by_v), 2e-8 * Scale(by_v) + 1e-12);
  }

  Garment garment_;
  Material material_;
  ClothState state_;
  std::unique_ptr<Effect> effect_;
  std::shared_ptr<const BlockPattern> pattern_;
};

TEST_P(EveryEffect, KnowsItsName) {
  EXPECT_EQ(effect_->name(), std::get<0>(GetParam()));
}

TEST_P(EveryEffect, ForceIsMinusEnergySlope) {
  if (!effect_->conservative()) {
    EXPECT_EQ(effect_->Energy(state_), 0.0);
    return;
  }
  const MatrixXd slope = Jacobian(
      [&](const Points& x) {
        return VectorXd::Constant(1, effect_->Energy({x, state_.v}));
      },
      state_.x,
      1e-3 * kCell);
  const VectorXd force = Stacked(ForceOf(*effect_, state_));
  EXPECT_LE(Scale(slope.transpose() + force), 1e-8 * Scale(force) + 1e-10);
}

TEST_P(EveryEffect, StiffnessIsSymmetricPositiveSemidefinite) {
  for (const bool damping : {false, true}) {
    const MatrixXd k = StiffnessOf(
        *effect_, pattern_, state_, damping ? 0.0 : 1.0, damping ? 1.0 : 0.0);
    const double scale = Scale(k);
    EXPECT_LE(Scale(k - k.transpose()), 1e-13 * scale);
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(k);
    EXPECT_GE(eigen.eigenvalues().minCoeff(), -1e-10 * scale);
  }
}

TEST_P(EveryEffect, StiffnessAddsScaled) {
  BlockMatrix a(pattern_);
  a.SetZero();
  effect_->AddStiffness(state_, 2.0, 0.0, &a);
  effect_->AddStiffness(state_, 0.0, 3.0, &a);
  effect_->AddStiffness(state_, 0.5, -1.0, &a);
  const MatrixXd expected =
      2.5 * StiffnessOf(*effect_, pattern_, state_, 1.0, 0.0) +
      2.0 * StiffnessOf(*effect_, pattern_, state_, 0.0, 1.0);
  EXPECT_LE(Scale(Dense(a) - expected), 1e-12 * Scale(expected));
}

TEST_P(EveryEffect, StiffnessIsExactUnlessSaidOtherwise) {
  const MatrixXd k = StiffnessOf(*effect_, pattern_, state_, 1.0, 0.0);
  const MatrixXd d = StiffnessOf(*effect_, pattern_, state_, 0.0, 1.0);
  const MatrixXd f_x = MinusForceSlope(false);
  const MatrixXd f_v = MinusForceSlope(true);
  const bool exact = Scale(k - f_x) <= 1e-7 * Scale(f_x) + 1e-10 &&
                     Scale(d - f_v) <= 1e-7 * Scale(f_v) + 1e-10;
  if (!effect_->stiffness_is_approximate()) {
    EXPECT_TRUE(exact);
  } else if (std::get<2>(GetParam()) == Shape::kNoise) {
    EXPECT_FALSE(exact);
  }
}

TEST_P(EveryEffect, SaysWhetherItDependsOnVelocity) {
  const bool depends =
      Scale(StiffnessOf(*effect_, pattern_, state_, 0.0, 1.0)) > 0.0 ||
      Scale(MinusForceSlope(true)) > 1e-12;
  EXPECT_EQ(depends, effect_->depends_on_velocity());
}

TEST_P(EveryEffect, TangentIsExact) {
  const int n = garment_.num_vertices();
  const Points zero = Points::Zero(3, n);
  ExpectTangent(zero, zero);
  // At zero stress the tensile part has a kink, and with it K.
  if (at_rest()) return;
  ExpectTangent(RandomPoints(n, 0.1 * kCell, 11), RandomPoints(n, 1.0, 13));
}

TEST_P(EveryEffect, ElasticForcesFollowRigidMotion) {
  const auto* elastic = dynamic_cast<const ElasticEffect*>(effect_.get());
  if (!elastic) return;
  const Eigen::Matrix3d r = SomeRotation();
  ClothState moved = state_;
  moved.x = (r * state_.x).colwise() + Vector3d(1.0, -2.0, 0.5);
  const Points f = ForceOf(*effect_, state_);
  const Points f_moved = ForceOf(*effect_, moved);
  const double size = at_rest() ? 0.0 : Scale(f);
  EXPECT_LE(Scale(f_moved - r * f), 1e-11 * size + 1e-11);
  if (at_rest()) {
    EXPECT_LE(Scale(f_moved), 1e-11);
  }
  const double energy = effect_->Energy(state_);
  EXPECT_NEAR(effect_->Energy(moved), energy, 1e-12 * energy + 1e-18);
  // Neither push nor turn on the whole.
  Vector3d push = f.rowwise().sum(), turn = Vector3d::Zero();
  for (int i = 0; i < f.cols(); ++i) turn += state_.x.col(i).cross(f.col(i));
  EXPECT_LE(push.norm(), 1e-12 * (Scale(f) + 1.0));
  EXPECT_LE(turn.norm(), 1e-12 * (Scale(f) + 1.0));
}

TEST_P(EveryEffect, ElasticProductsAgreeWithStiffness) {
  const auto* elastic = dynamic_cast<const ElasticEffect*>(effect_.get());
  if (!elastic) return;
  const Points w = RandomPoints(garment_.num_vertices(), 1.0, 17);
  const auto product = [&](const Points& x) -> VectorXd {
    Points p = Points::Zero(3, x.cols());
    elastic->AddStiffnessProduct(x, w, 1.5, &p);
    return Stacked(p);
  };
  const MatrixXd k = StiffnessOf(*effect_, pattern_, state_, 1.0, 0.0);
  const VectorXd expected = 1.5 * k * Stacked(w);
  EXPECT_LE(Scale(product(state_.x) - expected), 1e-12 * Scale(expected));
  if (at_rest()) return;
  BlockMatrix h(pattern_);
  h.SetZero();
  elastic->AddStiffnessProductTangent(state_.x, w, 1.5, &h);
  const MatrixXd slope = Jacobian(product, state_.x, kStep);
  EXPECT_LE(Scale(Dense(h) - slope), 1e-8 * Scale(slope) + 1e-12);
}

INSTANTIATE_TEST_SUITE_P(
    All,
    EveryEffect,
    testing::Combine(testing::ValuesIn(Effects().names()),
                     testing::Range(0, 3),
                     testing::Values(Shape::kNoise,
                                     Shape::kTension,
                                     Shape::kCompression,
                                     Shape::kShear,
                                     Shape::kFold,
                                     Shape::kRest)),
    [](const testing::TestParamInfo<Param>& p) {
      return std::get<0>(p.param) + "_" +
             ExampleMaterials()[std::get<1>(p.param)].name + "_" +
             NameOf(std::get<2>(p.param));
    });

TEST(EffectRegistry, NamesAreRefusedWithTheNearest) {
  try {
    Effects().Choose("membrain");
    FAIL() << "accepted";
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("membrane"), std::string::npos);
  }
}

}  // namespace
}  // namespace invsim
