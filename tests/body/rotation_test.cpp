// SPDX-License-Identifier: Apache-2.0
#include "invsim/body/rotation.h"

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace invsim {
namespace {

constexpr double kPi = std::numbers::pi;

// Directions times the angles that make trouble: none, tiny, about half a
// turn, about a whole turn, more.
std::vector<Vector3d> Vectors() {
  std::vector<Vector3d> vectors = {Vector3d::Zero()};
  const Vector3d axes[] = {Vector3d::UnitX(),
                           Vector3d(1, -2, 3).normalized(),
                           Vector3d(-1e-3, 1, 1e-5).normalized()};
  for (const Vector3d& axis : axes) {
    for (const double angle : {1e-200,
                               1e-12,
                               1e-8,
                               1e-5,
                               1e-3,
                               0.0099,
                               0.0101,
                               0.3,
                               0.999,
                               1.001,
                               2.5,
                               kPi - 1e-3,
                               kPi - 1e-8,
                               kPi,
                               kPi + 1e-8,
                               5.0,
                               2 * kPi - 1e-3,
                               2 * kPi - 1e-8,
                               2 * kPi,
                               2 * kPi + 1e-8,
                               7.0,
                               4 * kPi,
                               20.0}) {
      vectors.push_back(angle * axis);
    }
  }
  return vectors;
}

// The textbook formula in dual numbers, with the linear term alone at zero.
template <typename T>
Eigen::Matrix<T, 3, 3> TextbookExp(const Eigen::Matrix<T, 3, 1>& v) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  Eigen::Matrix<T, 3, 3> k;
  k << T(0), -v(2), v(1), v(2), T(0), -v(0), -v(1), v(0), T(0);
  const T x2 = v(0) * v(0) + v(1) * v(1) + v(2) * v(2);
  Eigen::Matrix<T, 3, 3> r = Eigen::Matrix<T, 3, 3>::Identity();
  if (x2 < T(1e-16)) return r + k;
  const T x = sqrt(x2);
  const Eigen::Matrix<T, 3, 3> first = k * (sin(x) / x);
  const Eigen::Matrix<T, 3, 3> second = k * k * ((T(1) - cos(x)) / x2);
  return r + first + second;
}

TEST(Rotation, SeriesAgreeWithLongDoubleFormulas) {
  for (double x = 1e-3; x < 15.0; x *= 1.07) {
    const long double l = x;
    EXPECT_NEAR(SinOverX(x * x), double(std::sin(l) / l), 2e-16) << x;
    EXPECT_NEAR(OneMinusCosOverX2(x * x),
                double(2 * std::pow(std::sin(l / 2) / l, 2)),
                2e-16)
        << x;
  }
  for (double x = 0.05; x < 15.0; x *= 1.07) {
    const long double l = x;
    EXPECT_NEAR(
        XMinusSinOverX3(x * x), double((l - std::sin(l)) / (l * l * l)), 1e-16)
        << x;
  }
  EXPECT_EQ(SinOverX(0.0), 1.0);
  EXPECT_EQ(OneMinusCosOverX2(0.0), 0.5);
  EXPECT_EQ(XMinusSinOverX3(0.0), 1.0 / 6.0);
}

TEST(Rotation, ExpIsARotation) {
  for (const Vector3d& v : Vectors()) {
    const Matrix3d r = Exp(v);
    EXPECT_LT((r * r.transpose() - Matrix3d::Identity()).norm(), 3e-15);
    EXPECT_NEAR(r.determinant(), 1.0, 3e-15);
    EXPECT_LT((r * v - v).norm(), 1e-14 * (1.0 + v.norm()));
  }
}

TEST(Rotation, ExpOfAQuarterTurn) {
  const Matrix3d r = Exp(Vector3d(0, 0, kPi / 2));
  EXPECT_LT((r * Vector3d::UnitX() - Vector3d::UnitY()).norm(), 1e-15);
}

TEST(Rotation, DerivativesAgreeWithDualNumbers) {
  using Jet3 = ceres::Jet<double, 3>;
  for (const Vector3d& v : Vectors()) {
    Eigen::Matrix<Jet3, 3, 1> jets;
    for (int c = 0; c < 3; ++c) jets(c) = Jet3(v(c), c);
    const Eigen::Matrix<Jet3, 3, 3> expected = TextbookExp(jets);
    const std::array<Matrix3d, 3> d = ExpDerivatives(v);
    // The textbook form itself loses digits as 1e-16 / x; none at the linear
    // end.
    const double tolerance = v.norm() < 1e-2 ? 2e-8 : 1e-12;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(Exp(v)(r, c), expected(r, c).a, tolerance);
        for (int k = 0; k < 3; ++k) {
          EXPECT_NEAR(d[k](r, c), expected(r, c).v(k), tolerance)
              << v.transpose();
        }
      }
    }
  }
}

// Independent of the textbook form where that one is weak: a Richardson
// difference of Exp.
TEST(Rotation, DerivativesAgreeWithDifferences) {
  for (const Vector3d& v : Vectors()) {
    const std::array<Matrix3d, 3> d = ExpDerivatives(v);
    for (int k = 0; k < 3; ++k) {
      const auto difference = [&](double h) -> Matrix3d {
        const Vector3d step = h * Vector3d::Unit(k);
        return (Exp(v + step) - Exp(v - step)) / (2 * h);
      };
      const Matrix3d richardson = (4 * difference(1e-3) - difference(2e-3)) / 3;
      EXPECT_LT((d[k] - richardson).norm(), 1e-11) << v.transpose();
    }
  }
}

TEST(Rotation, LogUndoesExpWithinHalfATurn) {
  for (const Vector3d& v : Vectors()) {
    const Vector3d log = Log(Exp(v));
    EXPECT_LE(log.norm(), kPi + 1e-14);
    EXPECT_LT((Exp(log) - Exp(v)).norm(), 1e-14) << v.transpose();
    if (v.norm() < kPi - 1e-9) {
      EXPECT_LT((log - v).norm(), 1e-14) << v.transpose();
    }
  }
}

TEST(Rotation, TinyLogKeepsItsDigits) {
  const Vector3d v = 1e-8 * Vector3d(1, -2, 3);
  EXPECT_LT((Log(Exp(v)) - v).norm(), 1e-22);
}

TEST(Rotation, GeodesicDistanceIsTheAngleBetween) {
  const Matrix3d a = Exp(Vector3d(0.3, -1.0, 2.0));
  for (const double angle : {0.0, 1e-9, 0.5, kPi - 1e-9, kPi}) {
    const Matrix3d b = a * Exp(angle * Vector3d(2, 1, 2) / 3);
    EXPECT_NEAR(GeodesicDistance(a, b), angle, 1e-15 + 1e-15 * angle);
  }
  EXPECT_NEAR(
      GeodesicDistance(a, a * Exp(Vector3d(4, 0, 0))), 2 * kPi - 4, 1e-14);
}

TEST(Rotation, SlerpRunsEvenlyTheShortWay) {
  const Matrix3d a = Exp(Vector3d(3.0, 0, 0));
  const Matrix3d b = Exp(Vector3d(-3.0, 0, 0));
  EXPECT_LT((Slerp(a, b, 0.0) - a).norm(), 1e-15);
  EXPECT_LT((Slerp(a, b, 1.0) - b).norm(), 1e-14);
  EXPECT_LT((Slerp(a, b, 0.5) - Exp(Vector3d(kPi, 0, 0))).norm(), 1e-14);
  const double whole = GeodesicDistance(a, b);
  EXPECT_NEAR(GeodesicDistance(a, Slerp(a, b, 0.3)), 0.3 * whole, 1e-14);
}

TEST(Rotation, NearestEquivalentIsTheSameRotationNearest) {
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> uniform(-4.0, 4.0);
  const auto draw = [&]() {
    return Vector3d(uniform(rng), uniform(rng), uniform(rng));
  };
  for (int trial = 0; trial < 200; ++trial) {
    const Vector3d v = draw();
    const Vector3d reference = 2 * draw();
    const Vector3d nearest = NearestEquivalent(v, reference);
    EXPECT_LT((Exp(nearest) - Exp(v)).norm(), 1e-13);
    for (int k = -6; k <= 6; ++k) {
      const Vector3d other = v + 2 * kPi * k * v.normalized();
      EXPECT_LE((nearest - reference).norm(),
                (other - reference).norm() + 1e-12);
    }
  }
}

TEST(Rotation, NearestEquivalentOfNoRotationIsAWholeTurn) {
  const Vector3d reference(0, 6.2, 0);
  EXPECT_LT(
      (NearestEquivalent(Vector3d::Zero(), reference) - Vector3d(0, 2 * kPi, 0))
          .norm(),
      1e-14);
  EXPECT_EQ(NearestEquivalent(Vector3d::Zero(), Vector3d::Zero()).norm(), 0.0);
}

}  // namespace
}  // namespace invsim
