// SPDX-License-Identifier: Apache-2.0
#include "invsim/contact/friction_jacobian.h"

#include <gtest/gtest.h>

#include <random>

#include "algebra/random_matrix.h"
#include "invsim/contact/friction_solver.h"

namespace invsim {
namespace {

constexpr int kContacts = 5;

// Nine vertices, four of them pressed against planes: with friction one
// sticks and one slides, without it all slide; the last pair shares a
// vertex. A last contact is of three vertices with each other.
class FrictionJacobianTest : public testing::TestWithParam<double> {
 protected:
  FrictionJacobianTest() : a_(RandomMatrix(3, 0, 5)) {
    b_ = VectorXd::Zero(27);
    for (int i = 0; i < 9; ++i) b_[3 * i + 1] = -10;
    b_[3 * 4] = 90;  // dragged along its plane
    weight_ = VectorXd::Ones(9);
    for (const int vertex : {0, 4, 8, 8}) {
      Contact c;
      c.vertex[0] = vertex;
      c.friction = GetParam();
      c.velocity = Vector3d(0.02, 0.1, -0.03);
      contacts_.push_back(c);
    }
    contacts_[2].normal = Vector3d(1, 1, 0).normalized();
    contacts_[2].compliance = contacts_[3].compliance = 1e-2;
    Contact pair;  // of vertices that A does not couple
    pair.num_vertices = 3;
    pair.vertex = {6, 1, 2, -1};
    pair.weight = {1, -0.3, -0.7, 0};
    pair.normal = Vector3d(0.6, 0, 0.8);
    pair.velocity = 1.5 * pair.normal;
    pair.friction = GetParam();
    pair.compliance = 1e-2;
    contacts_.push_back(pair);
  }
  VectorXd Solve(const VectorXd& b, const std::vector<Contact>& contacts) {
    VectorXd v = VectorXd::Zero(27);
    forces_.assign(contacts.size(), Vector3d::Zero());
    FrictionOptions options;
    options.tolerance = 1e-12;
    FrictionSolver solver(a_.shared_pattern());
    const FrictionProblem problem{&a_, &b, &contacts, &weight_};
    stats_ = solver.Solve(problem, options, &v, &forces_);
    EXPECT_TRUE(stats_.converged) << stats_.residual;
    return v;
  }
  static Columns Random(int rows, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    return Columns::NullaryExpr(rows, 1, [&] { return normal(random); });
  }

  BlockMatrix a_;
  VectorXd b_, weight_;
  std::vector<Contact> contacts_;
  std::vector<Vector3d> forces_;
  FrictionStats stats_;
};

TEST_P(FrictionJacobianTest, ForwardIsTheDerivativeOfTheSolution) {
  const VectorXd v = Solve(b_, contacts_);
  if (GetParam() > 0) {
    EXPECT_GT(stats_.stick, 0);
    EXPECT_GT(stats_.slide, 0);
  }
  FrictionJacobian jacobian(a_.shared_pattern());
  ASSERT_TRUE(jacobian.Factor(a_, contacts_, v, forces_));
  EXPECT_EQ(jacobian.symmetric(), GetParam() == 0);
  const Columns db = Random(27, 1), dw = Random(3 * kContacts, 2);
  Columns dn = Random(3 * kContacts, 3);
  for (int k = 0; k < kContacts; ++k) {  // a normal stays of length one
    const Vector3d n = contacts_[k].normal;
    const Vector3d d = dn.block<3, 1>(3 * k, 0);
    dn.block<3, 1>(3 * k, 0) = d - n * n.dot(d);
  }
  Columns derivative = db;
  jacobian.Forward(dn, dw, &derivative);
  const auto moved = [&](double h) {
    std::vector<Contact> contacts = contacts_;
    for (int k = 0; k < kContacts; ++k) {
      contacts[k].velocity += h * dw.block<3, 1>(3 * k, 0);
      contacts[k].normal =
          (contacts[k].normal + h * dn.block<3, 1>(3 * k, 0)).normalized();
    }
    return Solve(b_ + h * db, contacts);
  };
  const double h = 1e-5;
  const VectorXd difference = (moved(h) - moved(-h)) / (2 * h);
  EXPECT_LT((VectorXd(derivative) - difference).norm(),
            1e-7 * difference.norm());
}

TEST_P(FrictionJacobianTest, AdjointIsTheTranspose) {
  const VectorXd v = Solve(b_, contacts_);
  FrictionJacobian jacobian(a_.shared_pattern());
  ASSERT_TRUE(jacobian.Factor(a_, contacts_, v, forces_));
  const Columns db = Random(27, 4), dn = Random(3 * kContacts, 5),
                dw = Random(3 * kContacts, 6);
  const Columns weights = Random(27, 7);
  Columns forward = db;
  jacobian.Forward(dn, dw, &forward);
  Columns z = weights, n = Columns::Zero(3 * kContacts, 1),
          w = Columns::Zero(3 * kContacts, 1);
  jacobian.Adjoint(&z, &n, &w);
  const double one = weights.cwiseProduct(forward).sum();
  const double other = z.cwiseProduct(db).sum() + n.cwiseProduct(dn).sum() +
                       w.cwiseProduct(dw).sum();
  EXPECT_NEAR(one, other, 1e-12 * weights.norm() * forward.norm());
}

INSTANTIATE_TEST_SUITE_P(Friction,
                         FrictionJacobianTest,
                         testing::Values(0.0, 0.4));

}  // namespace
}  // namespace invsim
