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
constexpr double kVelocityStep = 1e-4;  // m/s

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
      y.v.setZero();
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

// One effect on one material in one state.
class Case {
 public:
  Case(const std::string& name, const Material& material, Shape shape)
      : shape_(shape),
        garment_(Sheet(4, 2, kCell, 0.2)),
        state_(MakeState(garment_, shape)),
        effect_(Effects().Choose(name)->Make(garment_, material)),
        pattern_(BindAlone(effect_.get(), garment_.num_vertices())) {}

  bool at_rest() const { return shape_ == Shape::kRest; }
  Shape shape() const { return shape_; }
  const ClothState& state() const { return state_; }
  const Effect& effect() const { return *effect_; }
  // Null if the effect is not elastic.
  const ElasticEffect* elastic() const {
    return dynamic_cast<const ElasticEffect*>(effect_.get());
  }
  int num_vertices() const { return garment_.num_vertices(); }

  BlockMatrix ZeroMatrix() const {
    BlockMatrix a(pattern_);
    a.SetZero();
    return a;
  }
  Points Force() const { return ForceOf(*effect_, state_); }
  MatrixXd K() const {
    return StiffnessOf(*effect_, pattern_, state_, 1.0, 0.0);
  }
  MatrixXd D() const {
    return StiffnessOf(*effect_, pattern_, state_, 0.0, 1.0);
  }

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
        by_velocity ? kVelocityStep : kStep);
  }

  // g(y) of Effect with dx, dv fixed.
  VectorXd G(const ClothState& y, const Points& dx, const Points& dv) const {
    return -Stacked(ForceOf(*effect_, y)) +
           StiffnessOf(*effect_, pattern_, y, 1.0, 0.0) * Stacked(dx) +
           StiffnessOf(*effect_, pattern_, y, 0.0, 1.0) * Stacked(dv);
  }

  void ExpectTangent(const Points& dx, const Points& dv) const {
    BlockMatrix h_x = ZeroMatrix(), h_v = ZeroMatrix();
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
        kVelocityStep);
    // Measured laws go by the size of the strain and drag by that of the
    // stream. Both have a kink at rest: the differences are then right to
    // first order only.
    const double relative = at_rest() ? 1e-4 : 2e-8;
    const double absolute = at_rest() ? 1e-8 : 1e-12;
    EXPECT_LE(Scale(Dense(h_x) - 2.0 * by_x),
              relative * Scale(by_x) + absolute);
    EXPECT_LE(Scale(Dense(h_v) - 2.0 * by_v),
              relative * Scale(by_v) + absolute);
  }

 private:
  Shape shape_;
  Garment garment_;
  ClothState state_;
  std::unique_ptr<Effect> effect_;
  std::shared_ptr<const BlockPattern> pattern_;
};

using Param = std::tuple<std::string, int>;

class EveryEffect : public testing::TestWithParam<Param> {
 protected:
  template <typename Check>
  void InEveryShape(const Check& check) {
    const auto& [name, material] = GetParam();
    for (const Shape shape : {Shape::kNoise,
                              Shape::kTension,
                              Shape::kCompression,
                              Shape::kShear,
                              Shape::kFold,
                              Shape::kRest}) {
      SCOPED_TRACE(NameOf(shape));
      check(Case(name, ExampleMaterials()[material], shape));
    }
  }
};

TEST_P(EveryEffect, KnowsItsName) {
  InEveryShape([&](const Case& c) {
    EXPECT_EQ(c.effect().name(), std::get<0>(GetParam()));
  });
}

TEST_P(EveryEffect, ForceIsMinusEnergySlope) {
  InEveryShape([](const Case& c) {
    if (!c.effect().conservative()) {
      EXPECT_EQ(c.effect().Energy(c.state()), 0.0);
      return;
    }
    const MatrixXd slope = Jacobian(
        [&](const Points& x) {
          return VectorXd::Constant(1, c.effect().Energy({x, c.state().v}));
        },
        c.state().x,
        1e-3 * kCell);
    const Points force = c.Force();
    EXPECT_LE(Scale(slope.transpose() + Stacked(force)),
              1e-8 * Scale(force) + 1e-10);
  });
}

TEST_P(EveryEffect, StiffnessIsSymmetricPositiveSemidefinite) {
  InEveryShape([](const Case& c) {
    for (const MatrixXd& k : {c.K(), c.D()}) {
      const double scale = Scale(k);
      EXPECT_LE(Scale(k - k.transpose()), 1e-13 * scale);
      const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(k);
      EXPECT_GE(eigen.eigenvalues().minCoeff(), -1e-10 * scale);
    }
  });
}

TEST_P(EveryEffect, StiffnessAddsScaled) {
  InEveryShape([](const Case& c) {
    BlockMatrix a = c.ZeroMatrix();
    c.effect().AddStiffness(c.state(), 2.0, 0.0, &a);
    c.effect().AddStiffness(c.state(), 0.0, 3.0, &a);
    c.effect().AddStiffness(c.state(), 0.5, -1.0, &a);
    const MatrixXd expected = 2.5 * c.K() + 2.0 * c.D();
    EXPECT_LE(Scale(Dense(a) - expected), 1e-12 * Scale(expected));
  });
}

TEST_P(EveryEffect, StiffnessIsExactUnlessSaidOtherwise) {
  InEveryShape([](const Case& c) {
    const MatrixXd f_x = c.MinusForceSlope(false);
    const MatrixXd f_v = c.MinusForceSlope(true);
    const bool exact = Scale(c.K() - f_x) <= 1e-7 * Scale(f_x) + 1e-10 &&
                       Scale(c.D() - f_v) <= 1e-7 * Scale(f_v) + 1e-10;
    if (!c.effect().stiffness_is_approximate()) {
      EXPECT_TRUE(exact);
    } else if (c.shape() == Shape::kNoise) {
      EXPECT_FALSE(exact);
    }
  });
}

TEST_P(EveryEffect, SaysWhetherItDependsOnVelocity) {
  InEveryShape([](const Case& c) {
    if (c.at_rest()) return;
    const bool depends =
        Scale(c.D()) > 0.0 || Scale(c.MinusForceSlope(true)) > 1e-12;
    EXPECT_EQ(depends, c.effect().depends_on_velocity());
  });
}

TEST_P(EveryEffect, TangentIsExact) {
  InEveryShape([](const Case& c) {
    const int n = c.num_vertices();
    const Points zero = Points::Zero(3, n);
    c.ExpectTangent(zero, zero);
    // At zero stress the tensile part has a kink, and with it K.
    if (c.at_rest()) return;
    c.ExpectTangent(RandomPoints(n, 0.1 * kCell, 11), RandomPoints(n, 1.0, 13));
  });
}

TEST_P(EveryEffect, ElasticForcesFollowRigidMotion) {
  InEveryShape([](const Case& c) {
    if (!c.elastic()) return;
    const Matrix3d r = SomeRotation();
    ClothState moved = c.state();
    moved.x = (r * c.state().x).colwise() + Vector3d(1.0, -2.0, 0.5);
    const Points f = c.Force();
    const Points f_moved = ForceOf(c.effect(), moved);
    const double size = c.at_rest() ? 0.0 : Scale(f);
    EXPECT_LE(Scale(f_moved - r * f), 1e-11 * size + 1e-11);
    if (c.at_rest()) {
      EXPECT_LE(Scale(f_moved), 1e-11);
    }
    const double energy = c.effect().Energy(c.state());
    EXPECT_NEAR(c.effect().Energy(moved), energy, 1e-12 * energy + 1e-18);
    // Neither push nor turn on the whole.
    Vector3d turn = Vector3d::Zero();
    for (int i = 0; i < f.cols(); ++i)
      turn += c.state().x.col(i).cross(f.col(i));
    EXPECT_LE(f.rowwise().sum().norm(), 1e-12 * (Scale(f) + 1.0));
    EXPECT_LE(turn.norm(), 1e-12 * (Scale(f) + 1.0));
  });
}

TEST_P(EveryEffect, ElasticProductsAgreeWithStiffness) {
  InEveryShape([](const Case& c) {
    if (!c.elastic()) return;
    const Points w = RandomPoints(c.num_vertices(), 1.0, 17);
    const auto product = [&](const Points& x) -> VectorXd {
      Points p = Points::Zero(3, x.cols());
      c.elastic()->AddStiffnessProduct(x, w, 1.5, &p);
      return Stacked(p);
    };
    const VectorXd expected = 1.5 * c.K() * Stacked(w);
    EXPECT_LE(Scale(product(c.state().x) - expected), 1e-12 * Scale(expected));
    if (c.at_rest()) return;
    BlockMatrix h = c.ZeroMatrix();
    c.elastic()->AddStiffnessProductTangent(c.state().x, w, 1.5, &h);
    const MatrixXd slope = Jacobian(product, c.state().x, kStep);
    EXPECT_LE(Scale(Dense(h) - slope), 1e-8 * Scale(slope) + 1e-12);
  });
}

INSTANTIATE_TEST_SUITE_P(All,
                         EveryEffect,
                         testing::Combine(testing::ValuesIn(Effects().names()),
                                          testing::Range(0, 3)),
                         [](const testing::TestParamInfo<Param>& p) {
                           return std::get<0>(p.param) + "_" +
                                  ExampleMaterials()[std::get<1>(p.param)].name;
                         });

TEST(EffectRegistry, EveryEffectAndOptionIsExplained) {
  for (const auto& entry : Effects().entries()) {
    EXPECT_FALSE(entry.doc.empty()) << entry.name;
    const auto choice = entry.choose();
    OptionTable table;
    table.AddSection(entry.name, choice.get());
    for (const auto& option : table.options())
      EXPECT_FALSE(option.info.doc.empty()) << option.key;
  }
}

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
