// SPDX-License-Identifier: Apache-2.0
#include "../../src/sim/energy_balance.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>

#include "cloth/test_cloth.h"
#include "invsim/cloth/effects/air_drag.h"
#include "invsim/cloth/effects/gravity.h"
#include "invsim/cloth/effects/mass_damping.h"
#include "invsim/cloth/effects/membrane.h"

namespace invsim {
namespace {

constexpr double kPull = 9.8;      // m/s^2
constexpr double kBriefly = 0.01;  // s

// A square of cloth in the plane z = 0, and the steps it might make.
class EnergyBalanceTest : public testing::Test {
 protected:
  EnergyBalanceTest()
      : sheet_(Sheet(3, 3, 0.05)),
        mass_(VectorXd::Constant(sheet_.num_vertices(), 2e-3)),
        start_{sheet_.placed, Points::Zero(3, sheet_.num_vertices())} {}

  void AddMembrane() {
    effects_.push_back(
        std::make_unique<Membrane>(sheet_, IsotropicStretch{200, 0.3}));
  }
  void AddGravity() {
    effects_.push_back(std::make_unique<Gravity>(
        mass_, GravityOptions{.acceleration = Vector3d(0, -kPull, 0)}));
  }
  // All vertices leave with this velocity, however they came by it.
  ClothState Leaving(const Vector3d& v) const {
    ClothState end = start_;
    end.v.colwise() = v;
    end.x += kBriefly * end.v;
    return end;
  }
  SubstepRecord Record(const ClothState& end) const {
    SubstepRecord sub;
    sub.dt = kBriefly;
    sub.start = start_;
    // The first was not the last word.
    sub.linearizations.resize(2);
    sub.linearizations[0].v = -3 * Stacked(end.v);
    sub.linearizations[1].v = Stacked(end.v);
    return sub;
  }
  double Gain(const ClothState& end) const {
    return EnergyGain(mass_, effects_, Record(end), end);
  }

  Garment sheet_;
  VectorXd mass_;
  ClothState start_;
  EffectList effects_;
};

TEST_F(EnergyBalanceTest, EnergiesOfASheetThatFlies) {
  AddGravity();
  AddMembrane();  // which moves without strain
  const ClothState end = Leaving(Vector3d(1, 2, -2));
  const double mass = 16 * 2e-3;
  EXPECT_NEAR(KineticEnergy(mass_, end), 0.5 * mass * 9, 1e-12);
  EXPECT_NEAR(
      PotentialEnergy(effects_, end) - PotentialEnergy(effects_, start_),
      mass * kPull * 2 * kBriefly,
      1e-12);
}

// Implicit Euler loses m g^2 dt^2 / 2 in every step of a fall, whatever the
// speed; little of what a fast sheet has.
TEST_F(EnergyBalanceTest, AFallLosesAsMuchAsTheSchemeDoes) {
  AddGravity();
  for (const double speed : {0.0, 0.5, 5.0}) {
    start_.v.colwise() = Vector3d(0, -speed, 0);
    const double after = speed + kBriefly * kPull;
    const double lost = 0.5 * std::pow(kBriefly * kPull, 2);
    const double turnover = 0.001 * kStandardGravity + 0.5 * after * after;
    EXPECT_NEAR(Gain(Leaving(Vector3d(0, -after, 0))), -lost / turnover, 1e-12);
  }
}

TEST_F(EnergyBalanceTest, MotionFromNowhereIsNearlyAllGain) {
  EXPECT_GT(Gain(Leaving(Vector3d(0, 3, 0))), 0.99);
  EXPECT_LE(Gain(Leaving(Vector3d(0, 3, 0))), 1);
  EXPECT_EQ(Gain(Leaving(Vector3d::Zero())), 0);
  // A hundredth of a millimetre's fall is too little to speak of.
  EXPECT_LT(Gain(Leaving(Vector3d(0, std::sqrt(2 * kPull * 1e-5), 0))), 0.01);
}

// Though nothing moves in the end.
TEST_F(EnergyBalanceTest, StrainFromNowhereIsNearlyAllGain) {
  AddMembrane();
  ClothState end = start_;
  end.x *= 1.2;
  EXPECT_GT(Gain(end), 0.99);
  EXPECT_LE(Gain(end), 1);
}

// A share knows neither how heavy the cloth is nor how it lies.
TEST_F(EnergyBalanceTest, DoesNotDependOnTheWeightOfTheCloth) {
  const double gain = Gain(Leaving(Vector3d(0, 0.1, 0.2)));
  EXPECT_GT(gain, 0.1);
  mass_ *= 30;
  EXPECT_NEAR(Gain(Leaving(Vector3d(0.2, 0, -0.1))), gain, 1e-12);
}

// A vertex that is pushed leaves with what the push gave; the same motion with
// half of it recorded is a gain of the rest.
TEST_F(EnergyBalanceTest, WhatContactsGiveIsNoGain) {
  ClothState end = start_;
  end.v.col(5) = Vector3d(0, 2, 1);
  end.x += kBriefly * end.v;
  SubstepRecord sub = Record(end);
  Contact contact;
  contact.vertex[0] = 5;
  contact.weight[0] = 1;
  sub.contacts = {contact};
  const auto gain = [&](double share) {
    // The mean velocity is half of the last, so this is the work done.
    sub.linearizations[0].forces = {Vector3d::Zero()};
    sub.linearizations[1].forces = {share * 0.5 * mass_[5] / kBriefly *
                                    Vector3d(end.v.col(5))};
    return EnergyGain(mass_, effects_, sub, end);
  };
  const double energy = 0.5 * mass_[5] * 5;
  const double lift = 0.001 * kStandardGravity * mass_.sum();
  EXPECT_NEAR(gain(1), 0, 1e-12);
  EXPECT_NEAR(gain(0.5), 0.5 * energy / (lift + 1.5 * energy), 1e-12);
  EXPECT_LT(gain(2), 0);
  // One that brakes takes: what is left has come from elsewhere.
  EXPECT_NEAR(gain(-1), 2 * energy / (lift + 2 * energy), 1e-12);
}

TEST_F(EnergyBalanceTest, WhatTheWindGivesIsNoGain) {
  const ClothState end = Leaving(Vector3d(0, 0, 0.01));
  const double calm = Gain(end);
  EXPECT_GT(calm, 0);
  AirDragOptions options;
  options.wind = Vector3d(0, 0, 10);
  effects_.push_back(std::make_unique<AirDrag>(sheet_.faces, options));
  EXPECT_LT(Gain(end), 0);
  // Against the wind it would have to be pushed.
  EXPECT_NEAR(Gain(Leaving(Vector3d(0, 0, -0.01))), calm, 1e-12);
}

// What damping takes is not counted: it must not hide a gain, nor make one.
TEST_F(EnergyBalanceTest, DampingChangesNothing) {
  const ClothState end = Leaving(Vector3d(1, 0, 2));
  const double without = Gain(end);
  effects_.push_back(
      std::make_unique<MassDamping>(mass_, MassDampingOptions{.rate = 50}));
  EXPECT_EQ(Gain(end), without);
}

// Vertices of a sheet that spins leave along their tangents, which stretches
// it: nothing of note in a small turn, energy from nowhere in a large one.
TEST_F(EnergyBalanceTest, SeesTheStrainOfAStepThatTurnsTooFar) {
  AddMembrane();
  const Vector3d middle = sheet_.placed.rowwise().mean();
  double gain[2];
  for (const int far : {0, 1}) {
    const double rate = far ? 40 : 4;  // rad/s
    for (int i = 0; i < start_.x.cols(); ++i)
      start_.v.col(i) = Vector3d(0, 0, rate).cross(start_.x.col(i) - middle);
    ClothState end = start_;
    end.x += kBriefly * end.v;
    gain[far] = Gain(end);
  }
  EXPECT_GT(gain[0], 0);
  EXPECT_LT(gain[0], 5e-3);
  EXPECT_GT(gain[1], 0.1);
}

}  // namespace
}  // namespace invsim
