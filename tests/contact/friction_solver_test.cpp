// SPDX-License-Identifier: Apache-2.0
#include "invsim/contact/friction_solver.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

namespace invsim {
namespace {

// A square of vertices joined by springs, all or some in contact with a plane.
class FrictionSolverTest : public testing::Test {
 protected:
  void Build(int n, double stiffness) {
    size_ = n * n;
    BlockPatternBuilder builder(size_);
    std::vector<std::array<int, 2>> springs;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        if (i + 1 < n) springs.push_back({i * n + j, (i + 1) * n + j});
        if (j + 1 < n) springs.push_back({i * n + j, i * n + j + 1});
        if (i + 1 < n && j + 1 < n)
          springs.push_back({i * n + j, (i + 1) * n + j + 1});
      }
    }
    for (const auto& s : springs) builder.AddStencil(s);
    pattern_ = builder.Build();
    a_ = BlockMatrix(pattern_);
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    for (const auto& s : springs) {
      const Vector3d d =
          Vector3d(normal(random), normal(random), normal(random)).normalized();
      const Matrix3d k = stiffness * d * d.transpose();
      for (int a : s)
        for (int b : s)
          a_.block(pattern_->Find(a, b)) += a == b ? k : Matrix3d(-k);
    }
    for (int i = 0; i < size_; ++i)
      a_.diagonal(i).diagonal().array() += kMass / kDt;
    weight_ = VectorXd::Constant(size_, kMass * kGravity);
    b_.setZero(3 * size_);
  }
  void AddGravity(const Vector3d& g) {
    for (int i = 0; i < size_; ++i) b_.segment<3>(3 * i) += kMass * g;
  }
  void AddContact(int vertex, const Vector3d& n, double mu) {
    Contact c;
    c.vertex[0] = vertex;
    c.normal = n;
    c.friction = mu;
    contacts_.push_back(c);
  }
  FrictionStats Solve(double tolerance = 1e-9) {
    FrictionOptions options;
    options.tolerance = tolerance;
    v_.setZero(3 * size_);
    forces_.assign(contacts_.size(), Vector3d::Zero());
    FrictionSolver solver(pattern_);
    const FrictionProblem problem{&a_, &b_, &contacts_, &weight_};
    return solver.Solve(problem, options, &v_, &forces_);
  }
  // Momentum and the contact law, evaluated anew.
  double Residual() const {
    VectorXd g = a_ * v_ - b_;
    double worst = 0;
    for (size_t k = 0; k < contacts_.size(); ++k) {
      contacts_[k].Scatter(-forces_[k], &g);
      const Contact& c = contacts_[k];
      const Vector3d u = c.Gather(v_) - c.velocity + c.compliance * forces_[k];
      worst = std::max(
          worst,
          FischerBurmeister(c.normal, c.friction, 1, forces_[k], u).norm());
    }
    return std::max(worst, g.lpNorm<Eigen::Infinity>()) / (kMass * kGravity);
  }

  static constexpr double kMass = 1e-4, kDt = 0.005, kGravity = 9.81;
  int size_ = 0;
  std::shared_ptr<const BlockPattern> pattern_;
  BlockMatrix a_;
  VectorXd b_, weight_, v_;
  std::vector<Contact> contacts_;
  std::vector<Vector3d> forces_;
};

// Held between two surfaces that close in on it, a vertex is pressed with far
// more than its weight, by which the residual is measured.
TEST_F(FrictionSolverTest, WhatIsSqueezedIsSolvedBySplitting) {
  Build(5, 3.0);
  AddGravity({0, -kGravity, 0});
  const int vertex = 12;
  constexpr double kClosing = 0.1, kCompliance = 1e-3;
  for (const double side : {1.0, -1.0}) {
    const Vector3d n(side, 0, 0);
    AddContact(vertex, n, 0.3);
    contacts_.back().velocity = kClosing * n;
    contacts_.back().compliance = kCompliance;
  }
  const FrictionStats stats = Solve(1e-6);
  EXPECT_TRUE(stats.converged);
  EXPECT_EQ(stats.newton_iterations, 0);
  EXPECT_LT(Residual(), 1e-5);
  EXPECT_NEAR(forces_[0].x(), kClosing / kCompliance, 1);
  EXPECT_NEAR(forces_[1].x(), -kClosing / kCompliance, 1);
}

TEST_F(FrictionSolverTest, FreeFallWithoutContact) {
  Build(5, 3.0);
  AddGravity({0, -kGravity, 0});
  const FrictionStats stats = Solve();
  EXPECT_TRUE(stats.converged);
  EXPECT_EQ(stats.factorizations, 1);
  for (int i = 0; i < size_; ++i)
    EXPECT_NEAR(v_[3 * i + 1], -kGravity * kDt, 1e-12);
}

// On an incline the block sticks below the friction angle and slides with
// acceleration g (sin a - mu cos a) above it.
TEST_F(FrictionSolverTest, BlockOnIncline) {
  const double mu = 0.4;
  for (double degrees : {10.0, 21.0, 22.5, 40.0}) {
    const double alpha = degrees * M_PI / 180;
    const Vector3d n(std::sin(alpha), std::cos(alpha), 0);
    const Vector3d down(std::cos(alpha), -std::sin(alpha), 0);
    contacts_.clear();
    Build(6, 0.0);
    for (int i = 0; i < size_; ++i) AddContact(i, n, mu);
    AddGravity({0, -kGravity, 0});
    ASSERT_TRUE(Solve().converged);
    const double slip = std::max(
        0.0, kGravity * (std::sin(alpha) - mu * std::cos(alpha)) * kDt);
    for (int i = 0; i < size_; ++i)
      EXPECT_LT((v_.segment<3>(3 * i) - slip * down).norm(), 1e-9);
  }
}

TEST_F(FrictionSolverTest, CoupledAndMixedModes) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (double mu : {0.0, 0.3, 1.0}) {
    contacts_.clear();
    Build(12, 3.0);
    for (int i = 0; i < size_; i += 2)
      AddContact(
          i, Vector3d(normal(random), 3, normal(random)).normalized(), mu);
    AddGravity({0, -kGravity, 0});
    for (double& x : b_.reshaped()) x += 3 * kMass * kGravity * normal(random);
    const FrictionStats stats = Solve();
    EXPECT_TRUE(stats.converged) << "mu " << mu << " " << stats.residual;
    EXPECT_LT(Residual(), 1e-8);
    EXPECT_GT(stats.open, 0);
    EXPECT_GT(stats.slide, 0);
    if (mu > 0) {
      EXPECT_GT(stats.stick, 0);
    }
  }
}

TEST_F(FrictionSolverTest, SharedAndTwoSidedContacts) {
  Build(8, 3.0);
  const double compliance = 0.001 * kDt / kMass;
  // A vertex in a groove, one squeezed between opposite walls that overlap,
  // and a contact between two cloth vertices.
  AddContact(10, Vector3d(1, 1, 0).normalized(), 0.3);
  AddContact(10, Vector3d(-1, 1, 0).normalized(), 0.3);
  AddContact(30, Vector3d::UnitX(), 0.3);
  AddContact(30, -Vector3d::UnitX(), 0.3);
  contacts_[2].velocity = 0.1 * Vector3d::UnitX();
  contacts_[3].velocity = -0.1 * Vector3d::UnitX();
  Contact pair;
  pair.num_vertices = 2;
  pair.vertex = {11, 12, -1, -1};
  pair.weight = {1, -1, 0, 0};
  pair.friction = 0.3;
  pair.velocity = 0.05 * Vector3d::UnitY();
  contacts_.push_back(pair);
  for (Contact& c : contacts_) c.compliance = compliance;
  AddContact(40, Vector3d::UnitY(), 0.3);
  AddGravity({0, -kGravity, 0});
  const FrictionStats stats = Solve();
  EXPECT_TRUE(stats.converged) << stats.residual;
  EXPECT_LT(Residual(), 1e-8);
  EXPECT_NEAR(v_[3 * 30], 0, 1e-3);  // half way between the walls
  EXPECT_NEAR(v_[3 * 11 + 1] - v_[3 * 12 + 1] + compliance * forces_[4].y(),
              0.05,
              1e-9);
}

// Contacts between vertices that no effect couples: a sheet whose halves are
// pressed onto each other. What one half gains the other loses.
TEST_F(FrictionSolverTest, ContactsCoupleVerticesThatAreNoNeighbours) {
  const int n = 8;
  Build(n, 3.0);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n / 2 - 1; ++j) {
      Contact c;
      c.num_vertices = 3;
      const int across = i * n + n - 1 - j;
      c.vertex = {i * n + j, across, across - 1, -1};
      c.weight = {1, -0.4, -0.6, 0};
      c.friction = 0.3;
      c.compliance = 0.001 * kDt / kMass;
      contacts_.push_back(c);
    }
  }
  for (int i = 0; i < size_; ++i)
    b_.segment<3>(3 * i) =
        kMass * kGravity * Vector3d(0.2 * (i % 3), i % n < n / 2 ? -1 : 1, 0);
  const FrictionStats stats = Solve();
  EXPECT_TRUE(stats.converged) << stats.residual;
  EXPECT_LT(Residual(), 1e-8);
  EXPECT_GT(stats.stick + stats.slide, n);
  VectorXd sum = VectorXd::Zero(3 * size_);
  for (size_t k = 0; k < contacts_.size(); ++k)
    contacts_[k].Scatter(forces_[k], &sum);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(
        Eigen::Map<Points>(sum.data(), 3, size_).row(c).sum(), 0, 1e-12);
}

TEST_F(FrictionSolverTest, PinsHoldAgainstAnyForce) {
  Build(4, 3.0);
  Contact pin;
  pin.kind = ContactKind::kPin;
  pin.vertex[0] = 3;
  pin.velocity = Vector3d(0.1, 0.2, 0.3);
  contacts_.push_back(pin);
  AddGravity({0, -100 * kGravity, 0});
  EXPECT_TRUE(Solve().converged);
  EXPECT_LT((v_.segment<3>(9) - pin.velocity).norm(), 1e-10);
}

TEST_F(FrictionSolverTest, IndefiniteMatrixIsReported) {
  Build(4, 0.0);
  a_.diagonal(3) *= -1;
  const FrictionStats stats = Solve();
  EXPECT_FALSE(stats.converged);
  EXPECT_TRUE(stats.factorization_failed);
}

}  // namespace
}  // namespace invsim
