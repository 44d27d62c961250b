// SPDX-License-Identifier: Apache-2.0
#include "invsim/contact/coulomb.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

namespace invsim {
namespace {

struct Pair {
  Vector3d r, u;
};

class CoulombTest : public testing::Test {
 protected:
  Vector3d Random() {
    return {normal_(random_), normal_(random_), normal_(random_)};
  }
  Vector3d Normal() { return Random().normalized(); }
  // A force and a velocity that satisfy the law in the given mode.
  Pair Solution(ContactMode mode, const Vector3d& n, double mu) {
    const Vector3d t = n.cross(Random()).normalized();
    const double a = std::abs(normal_(random_)) + 0.1;
    const double b = std::abs(normal_(random_)) + 0.1;
    if (mode == ContactMode::kOpen) return {Vector3d::Zero(), a * n + b * t};
    if (mode == ContactMode::kStick)
      return {a * n + 0.9 * mu * a * t, Vector3d::Zero()};
    return {a * n - mu * a * t, b * t};
  }
  std::mt19937 random_{7};
  std::normal_distribution<double> normal_;
};

constexpr ContactMode kModes[] = {
    ContactMode::kOpen, ContactMode::kStick, ContactMode::kSlide};

TEST_F(CoulombTest, BothFormsVanishExactlyAtSolutions) {
  for (double mu : {0.0, 0.3, 1.0, 5.0}) {
    for (ContactMode mode : kModes) {
      if (mode == ContactMode::kStick && mu == 0) continue;
      for (int k = 0; k < 20; ++k) {
        const Vector3d n = Normal();
        const Pair s = Solution(mode, n, mu);
        const double rho = 0.7;
        EXPECT_LT(FischerBurmeister(n, mu, rho, s.r, s.u).norm(), 1e-13);
        const ContactLinearization l =
            LinearizeAlartCurnier(n, mu, rho, s.r, s.u);
        EXPECT_EQ(l.mode, mode);
        EXPECT_LT(l.residual.norm(), 1e-13);
      }
    }
  }
}

// Near the cone's surface a difference of squares would leave the root of the
// rounding, 1e-8, in place of the rounding itself.
TEST_F(CoulombTest, FischerBurmeisterIsPreciseNearTheCone) {
  for (const double mu : {0.05, 0.3, 1.0, 5.0}) {
    for (const double small : {1e-3, 1e-6, 1e-9, 1e-12, 0.0}) {
      for (int k = 0; k < 20; ++k) {
        const Vector3d n = Normal();
        const Vector3d t = n.cross(Random()).normalized();
        // Slides ever slower; sticks ever nearer to sliding.
        const Vector3d slides = FischerBurmeister(
            n, mu, 0.7, Vector3d(n - mu * t), Vector3d(small * t));
        const Vector3d sticks = FischerBurmeister(
            n, mu, 0.7, Vector3d(n - mu * (1 - small) * t), Vector3d::Zero());
        EXPECT_LT(slides.norm(), 1e-14 * (1 + mu)) << mu << " " << small;
        EXPECT_LT(sticks.norm(), 1e-14 * (1 + mu)) << mu << " " << small;
      }
    }
  }
}

// Where the law is broken a little, Phi is of that size.
TEST_F(CoulombTest, FischerBurmeisterMeasuresSmallViolations) {
  const Vector3d n = Normal(), t = n.unitOrthogonal();
  for (const double mu : {0.3, 1.0}) {
    for (const double small : {1e-4, 1e-8, 1e-12}) {
      const Vector3d out = FischerBurmeister(
          n, mu, 1, Vector3d(n + mu * (1 + small) * t), Vector3d::Zero());
      EXPECT_GT(out.norm(), 0.1 * mu * small);
      EXPECT_LT(out.norm(), 3 * mu * small + 1e-15);
    }
  }
}

TEST_F(CoulombTest, FischerBurmeisterSeesEveryViolation) {
  const Vector3d n = Normal();
  const Vector3d t = n.unitOrthogonal();
  const double mu = 0.4;
  const auto phi = [&](const Vector3d& r, const Vector3d& u) {
    return FischerBurmeister(n, mu, 1, r, u).norm();
  };
  const Vector3d zero = Vector3d::Zero();
  EXPECT_GT(phi(zero, -0.1 * n), 0.03);        // sinks in
  EXPECT_GT(phi(-0.1 * n, zero), 0.03);        // pulls
  EXPECT_GT(phi(n, 0.1 * n), 0.03);            // lifts off under force
  EXPECT_GT(phi(n + 0.5 * t, zero), 0.03);     // sticks outside the cone
  EXPECT_GT(phi(n - 0.2 * t, 0.5 * t), 0.03);  // slides inside the cone
  EXPECT_GT(phi(n + 0.4 * t, 0.5 * t), 0.03);  // friction pushes along
}

// The Newton matrices are the derivative of the residual.
TEST_F(CoulombTest, AlartCurnierLinearizationMatchesDifferences) {
  const double mu = 0.5, rho = 1.3, h = 1e-6;
  int checked = 0;
  for (int k = 0; k < 200; ++k) {
    const Vector3d n = Normal(), dr = Random(), du = Random();
    const Vector3d r = Random() + 0.5 * n, u = Random();
    const auto at = [&](double s) {
      return LinearizeAlartCurnier(n, mu, rho, r + s * dr, u + s * du);
    };
    const ContactLinearization c = at(0), plus = at(h), minus = at(-h);
    if (plus.mode != c.mode || minus.mode != c.mode) continue;
    const Vector3d trial = r - rho * u;
    // Sliding rows hold in the frame (n, t, s) of the current slip: compare
    // the vector form r_T - mu lambda t, of which they are the components.
    const auto residual = [&](double s) -> Vector3d {
      const Vector3d rr = r + s * dr, uu = u + s * du;
      if (c.mode != ContactMode::kSlide) return at(s).residual;
      const Vector3d tau = rr - rho * uu;
      const Vector3d tangent = tau - n.dot(tau) * n;
      return rho * n.dot(uu) * n + (rr - n.dot(rr) * n) -
             mu * n.dot(tau) * tangent.normalized();
    };
    const Vector3d numeric = (residual(h) - residual(-h)) / (2 * h);
    EXPECT_LT((c.p * dr + c.q * du - numeric).norm(),
              1e-7 * (1 + numeric.norm()))
        << "trial " << trial.transpose();
    ++checked;
  }
  EXPECT_GT(checked, 150);
}

// Moving n at a solution, the law's solutions move as p, q and n say.
TEST_F(CoulombTest, NormalDerivativeFollowsSolutions) {
  const double mu = 0.5, rho = 1.3, h = 1e-6;
  for (ContactMode mode : kModes) {
    for (int k = 0; k < 20; ++k) {
      const Vector3d n = Normal();
      const Vector3d turn = n.cross(Random());  // dn, perpendicular to n
      const Pair s = Solution(mode, n, mu);
      // A solution for the turned normal: rotate r and u along.
      const Vector3d axis = n.cross(turn);
      const auto rotate = [&](double angle, const Vector3d& x) -> Vector3d {
        return Eigen::AngleAxisd(angle * axis.norm(), axis.normalized()) * x;
      };
      const Vector3d dn = (rotate(h, n) - rotate(-h, n)) / (2 * h);
      const Vector3d dr = (rotate(h, s.r) - rotate(-h, s.r)) / (2 * h);
      const Vector3d du = (rotate(h, s.u) - rotate(-h, s.u)) / (2 * h);
      const ContactLinearization l =
          LinearizeAlartCurnier(n, mu, rho, s.r, s.u);
      EXPECT_LT((l.p * dr + l.q * du + l.n * dn).norm(), 1e-8);
    }
  }
}

TEST_F(CoulombTest, ModeOfAForceIsThatOfTheSolution) {
  for (int trial = 0; trial < 100; ++trial)
    for (ContactMode mode : kModes) {
      const Vector3d n = Normal();
      EXPECT_EQ(ModeOf(n, 0.3, Solution(mode, n, 0.3).r), mode);
    }
  // Without friction nothing sticks.
  EXPECT_EQ(ModeOf(Vector3d::UnitY(), 0, Vector3d::UnitY()),
            ContactMode::kSlide);
}

TEST_F(CoulombTest, CompliantForceSatisfiesTheLaw) {
  for (double mu : {0.0, 0.3, 2.0}) {
    for (int k = 0; k < 50; ++k) {
      const Vector3d n = Normal(), q = Random();
      const double d = 0.4;
      const Vector3d r = CompliantForce(n, mu, d, q);
      EXPECT_LT(FischerBurmeister(n, mu, 1.0, r, q + d * r).norm(), 1e-12);
    }
  }
}

TEST_F(CoulombTest, CompliantDerivativeMatchesDifferences) {
  const double mu = 0.6, d = 0.3, h = 1e-6;
  int seen[3] = {};
  for (int k = 0; k < 100; ++k) {
    const Vector3d n = Normal(), q = Random(), dq = Random(), dn = Random();
    const CompliantDerivative c = DifferentiateCompliantForce(n, mu, d, q);
    const auto force = [&](double a, double b) {
      return CompliantForce(n + b * dn, mu, d, q + a * dq);
    };
    const Vector3d by_q = (force(h, 0) - force(-h, 0)) / (2 * h);
    EXPECT_LT((c.dq * dq - by_q).norm(), 1e-6 * (1 + by_q.norm()));
    // n stays a unit vector: only its turning is meaningful.
    const Vector3d turn = dn - n.dot(dn) * n;
    const auto turned = [&](double b) {
      return CompliantForce((n + b * turn).normalized(), mu, d, q);
    };
    const Vector3d by_n = (turned(h) - turned(-h)) / (2 * h);
    EXPECT_LT((c.dn * turn - by_n).norm(), 1e-6 * (1 + by_n.norm()));
    ++seen[static_cast<int>(c.mode)];
  }
  for (int count : seen) EXPECT_GT(count, 5);
}

}  // namespace
}  // namespace invsim
