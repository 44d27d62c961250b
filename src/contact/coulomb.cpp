// SPDX-License-Identifier: Apache-2.0
#include "invsim/contact/coulomb.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace invsim {
namespace {

// A force is on the friction cone up to rounding.
constexpr double kOnCone = 1e-9;

Matrix3d Outer(const Vector3d& a, const Vector3d& b) {
  return a * b.transpose();
}

// The determinant of x^2 + y^2 in the Jordan algebra of the Lorentz cone, x =
// (a0, a) and y = (b0, b), as a sum of terms none of which is negative:
//
//   (a0^2 - |a|^2)^2 + (b0^2 - |b|^2)^2
//     + 2 (a0 b0 - s |a||b|)^2 + 2 (a0 |b| - s b0 |a|)^2
//     + 8 |a0 b0| (|a||b| - s a.b),                      s the sign of a0 b0 .
//
// As a difference it would be lost in rounding where x^2 + y^2 is nearly on the
// cone: that is wherever cloth hardly slides or hardly sticks.
double DeterminantOfSquares(double a0,
                            const Vector3d& a,
                            double b0,
                            const Vector3d& b) {
  const double a1 = a.norm(), b1 = b.norm();
  const double s = a0 * b0 < 0 ? -1 : 1;
  const auto square = [](double x) { return x * x; };
  // |a||b| - s a.b
  const double angle =
      a1 * b1 > 0 ? (b1 * a - s * a1 * b).squaredNorm() / (2 * a1 * b1) : 0;
  return square((a0 - a1) * (a0 + a1)) + square((b0 - b1) * (b0 + b1)) +
         2 * square(a0 * b0 - s * a1 * b1) + 2 * square(a0 * b1 - s * b0 * a1) +
         8 * std::abs(a0 * b0) * angle;
}

}  // namespace

ContactLinearization LinearizeAlartCurnier(const Vector3d& n,
                                           double mu,
                                           double rho,
                                           const Vector3d& r,
                                           const Vector3d& u) {
  const Vector3d trial = r - rho * u;
  const double normal = n.dot(trial);
  const Vector3d tangent = trial - normal * n;
  const double length = tangent.norm();
  ContactLinearization c;
  c.n.setZero();
  if (normal <= 0) {
    c.mode = ContactMode::kOpen;
    c.p.setIdentity();
    c.q.setZero();
    c.residual = r;
  } else if (length <= mu * normal && mu > 0) {
    c.mode = ContactMode::kStick;
    c.p.setZero();
    c.q = rho * Matrix3d::Identity();
    c.residual = rho * u;
  } else {
    c.mode = ContactMode::kSlide;
    const Vector3d t =
        length > 0 ? Vector3d(tangent / length) : n.unitOrthogonal();
    const Vector3d s = n.cross(t);
    const double k = length > 0 ? mu * normal / length : 0.0;
    c.p = Outer(t, t) - mu * Outer(t, n) + (1 - k) * Outer(s, s);
    // The cone's radius is mu (r_N - rho u_N), hence the last term.
    c.q = rho * (Outer(n, n) + k * Outer(s, s) + mu * Outer(t, n));
    // Across the slip the trial vanishes, so r_s is the whole residual.
    c.residual =
        rho * n.dot(u) * n + (t.dot(r) - mu * normal) * t + s.dot(r) * s;
    // At the solution u_N = 0 and r = r_N (n + mu t), t = -u/|u|: the rows are
    // rho dn . u,  mu rho dn . u - (1 + mu^2) r_N dn . t  and
    // -(1 - k) r_N dn . s.
    c.n = rho * Outer(n + mu * t, u) - (1 + mu * mu) * normal * Outer(t, t) -
          (1 - k) * normal * Outer(s, s);
  }
  return c;
}

Vector3d FischerBurmeister(const Vector3d& n,
                           double mu,
                           double rho,
                           const Vector3d& r,
                           const Vector3d& u) {
  const double r_n = n.dot(r);
  const double u_n = rho * n.dot(u);
  const Vector3d r_t = r - r_n * n;
  const Vector3d u_t = rho * (u - n.dot(u) * n);
  if (mu == 0) return (r_n + u_n - std::hypot(r_n, u_n)) * n + r_t;
  // In the coordinates (mu r_N, r_T) and (u_N + mu |u_T|, mu u_T), scaled by
  // 1/mu, both cones are the self-dual Lorentz cone.
  const double a0 = mu * r_n;
  const double b0 = u_n + mu * u_t.norm();
  const Vector3d a = r_t;
  const Vector3d b = mu * u_t;
  // z = a^2 + b^2 in the Jordan algebra, then its square root.
  const double z0 = a0 * a0 + a.squaredNorm() + b0 * b0 + b.squaredNorm();
  const Vector3d z = 2 * (a0 * a + b0 * b);
  const double length = z.norm();
  // Its eigenvalues are z0 +- |z_T|; their product is the determinant.
  const double plus = z0 + length;
  const double root_plus = std::sqrt(plus);
  const double root_minus =
      plus > 0 ? std::sqrt(DeterminantOfSquares(a0, a, b0, b) / plus) : 0;
  const Vector3d direction =
      length > 0 ? Vector3d(z / length) : Vector3d::Zero();
  const double phi_n = a0 + b0 - 0.5 * (root_plus + root_minus);
  const Vector3d phi_t = a + b - 0.5 * (root_plus - root_minus) * direction;
  return phi_n * n + phi_t;
}

Vector3d CompliantForce(
    const Vector3d& n, double mu, double d_n, double d_t, const Vector3d& q) {
  const double normal = -n.dot(q) / d_n;
  if (normal <= 0) return Vector3d::Zero();
  const Vector3d tangent = -(q - n.dot(q) * n) / d_t;
  const double length = tangent.norm();
  if (length <= mu * normal) return normal * n + tangent;
  return normal * (n + mu / length * tangent);
}

Vector3d CompliantForce(const Vector3d& n,
                        double mu,
                        double d,
                        const Vector3d& q) {
  return CompliantForce(n, mu, d, d, q);
}

ContactMode ModeOf(const Vector3d& n, double mu, const Vector3d& r) {
  const double normal = n.dot(r);
  if (normal <= 0) return ContactMode::kOpen;
  const double tangent = (r - normal * n).norm();
  return tangent < mu * normal * (1 - kOnCone) ? ContactMode::kStick
                                               : ContactMode::kSlide;
}

CompliantDerivative DifferentiateCompliantForce(const Vector3d& n,
                                                double mu,
                                                double d,
                                                const Vector3d& q) {
  CompliantDerivative out{
      ContactMode::kOpen, Matrix3d::Zero(), Matrix3d::Zero()};
  const double q_n = n.dot(q);
  const double normal = -q_n / d;
  if (normal <= 0) return out;
  const Vector3d q_t = q - q_n * n;
  const double length = q_t.norm();
  if (length <= -mu * q_n) {
    out.mode = ContactMode::kStick;
    out.dq = -Matrix3d::Identity() / d;
    return out;
  }
  // r = r_N e with e = n + mu t, t = -q_T/|q_T|.
  out.mode = ContactMode::kSlide;
  const Vector3d t =
      length > 0 ? Vector3d(-q_t / length) : Vector3d(Vector3d::Zero());
  const Vector3d e = n + mu * t;
  out.dq = -Outer(e, n) / d;
  out.dn = -Outer(e, q) / d + normal * Matrix3d::Identity();
  if (mu > 0 && length > 0) {
    const Matrix3d turn =
        -(mu * normal / length) * (Matrix3d::Identity() - Outer(t, t));
    out.dq += turn * (Matrix3d::Identity() - Outer(n, n));
    out.dn += turn * (-q_n * Matrix3d::Identity() - Outer(n, q));
  }
  return out;
}

}  // namespace invsim
