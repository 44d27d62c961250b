// SPDX-License-Identifier: Apache-2.0
#include "invsim/body/rotation.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace invsim {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

// The quaternion of a rotation with w >= 0; its vector part has the length
// sin(x / 2) and loses no digits near the identity or near half a turn.
Eigen::Quaterniond HalfAngle(const Matrix3d& r) {
  Eigen::Quaterniond q(r);
  q.normalize();
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  return q;
}

}  // namespace

double SinOverX(double x_squared) {
  // The series' first term left out is x^8 / 9! < 3e-22.
  if (x_squared < 1e-4) {
    return 1.0 - x_squared / 6.0 *
                     (1.0 - x_squared / 20.0 * (1.0 - x_squared / 42.0));
  }
  const double x = std::sqrt(x_squared);
  return std::sin(x) / x;
}

double OneMinusCosOverX2(double x_squared) {
  // 1 - cos x = 2 sin^2(x / 2) has no cancellation.
  const double s = SinOverX(0.25 * x_squared);
  return 0.5 * s * s;
}

double XMinusSinOverX3(double x_squared) {
  // x - sin x cancels to x^3 / 6: below x = 1 the series, whose first term
  // left out is 6 / 21! < 2e-19, keeps all digits.
  if (x_squared < 1.0) {
    double sum = 1.0;
    for (int n = 8; n >= 1; --n) {
      sum = 1.0 - x_squared / ((2.0 * n + 2.0) * (2.0 * n + 3.0)) * sum;
    }
    return sum / 6.0;
  }
  const double x = std::sqrt(x_squared);
  return (x - std::sin(x)) / (x * x_squared);
}

Matrix3d Cross(const Vector3d& v) {
  Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

Matrix3d Exp(const Vector3d& v) {
  const double x2 = v.squaredNorm();
  const Matrix3d k = Cross(v);
  return Matrix3d::Identity() + SinOverX(x2) * k +
         OneMinusCosOverX2(x2) * k * k;
}

Matrix3d LeftJacobian(const Vector3d& v) {
  const double x2 = v.squaredNorm();
  const Matrix3d k = Cross(v);
  return Matrix3d::Identity() + OneMinusCosOverX2(x2) * k +
         XMinusSinOverX3(x2) * k * k;
}

std::array<Matrix3d, 3> ExpDerivatives(const Vector3d& v) {
  const Matrix3d r = Exp(v);
  const Matrix3d jacobian = LeftJacobian(v);
  std::array<Matrix3d, 3> d;
  for (int c = 0; c < 3; ++c) d[c] = Cross(jacobian.col(c)) * r;
  return d;
}

Vector3d Log(const Matrix3d& r) {
  const Eigen::Quaterniond q = HalfAngle(r);
  const double half = std::atan2(q.vec().norm(), q.w());
  // The vector part is axis * sin(half) = axis * half * SinOverX(half^2).
  return q.vec() * (2.0 / SinOverX(half * half));
}

double GeodesicDistance(const Matrix3d& a, const Matrix3d& b) {
  const Eigen::Quaterniond q = HalfAngle(a.transpose() * b);
  return 2.0 * std::atan2(q.vec().norm(), q.w());
}

Matrix3d Slerp(const Matrix3d& a, const Matrix3d& b, double s) {
  return a * Exp(s * Log(a.transpose() * b));
}

Vector3d NearestEquivalent(const Vector3d& v, const Vector3d& reference) {
  // Without an axis of its own, a whole turn may be about the reference's.
  const bool no_axis = v.norm() < 1e-12;
  const Vector3d towards = no_axis ? reference : v;
  if (towards.norm() < 1e-12) return v;
  const Vector3d axis = towards.normalized();
  const double turns = std::round(axis.dot(reference - v) / kTwoPi);
  return v + turns * kTwoPi * axis;
}

}  // namespace invsim
