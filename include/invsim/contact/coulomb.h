// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CONTACT_COULOMB_H_
#define INVSIM_CONTACT_COULOMB_H_

// Signorini-Coulomb contact at one point, in world coordinates.
//
// r is the contact force on the cloth (N), u the relative velocity including
// the gap (m/s), n the unit normal from the obstacle to the cloth, mu the
// friction coefficient. Index N is the part along n, T the rest. The law:
//
//   open   r = 0,                       u_N >= 0
//   stick  u = 0,                       |r_T| <= mu r_N
//   slide  u_N = 0,  r_T = -mu r_N u_T/|u_T|
//
// Three equations F(r, u) = 0 stand for it, all with these roots:
//  * the projection form of Alart & Curnier (1991), which drives Newton,
//  * Phi of Fischer & Burmeister over the friction cone (Daviet, Bertails-
//    Descoubes & Boissieux 2011, sec. 4), in which residuals are reported,
//  * with a scalar compliance, u = q + d r, a closed form for r.
// rho (kg/s) makes velocities commensurate with forces; it moves no root.

#include "invsim/base/types.h"

namespace invsim {

enum class ContactMode { kOpen, kStick, kSlide };

// Linear equation P dr + Q du = -residual of a semismooth Newton step on the
// Alart-Curnier form. Rows of slide: along n, rho u_N = 0; along the slip
// direction t, r_t = mu r_N; across it, the direction of t.
struct ContactLinearization {
  ContactMode mode;
  Matrix3d p;
  Matrix3d q;
  Vector3d residual;
  // dF/dn where F = 0: the normal turns with the body.
  Matrix3d n;
};

ContactLinearization LinearizeAlartCurnier(const Vector3d& n,
                                           double mu,
                                           double rho,
                                           const Vector3d& r,
                                           const Vector3d& u);

// Phi(r, u) of Fischer-Burmeister in newtons; zero iff the law holds.
Vector3d FischerBurmeister(const Vector3d& n,
                           double mu,
                           double rho,
                           const Vector3d& r,
                           const Vector3d& u);

// The force that satisfies the law when u = q + d r with a scalar d > 0
// ((m/s)/N): the local problem of a splitting method, and the law of a
// compliant contact.
Vector3d CompliantForce(const Vector3d& n,
                        double mu,
                        double d,
                        const Vector3d& q);

// The same where u = q + d_n r along n and q + d_t r across it.
Vector3d CompliantForce(
    const Vector3d& n, double mu, double d_n, double d_t, const Vector3d& q);

// The mode of a force that obeys the law.
ContactMode ModeOf(const Vector3d& n, double mu, const Vector3d& r);

// The derivatives of the first with respect to q and to n.
struct CompliantDerivative {
  ContactMode mode;
  Matrix3d dq;
  Matrix3d dn;
};
CompliantDerivative DifferentiateCompliantForce(const Vector3d& n,
                                                double mu,
                                                double d,
                                                const Vector3d& q);

}  // namespace invsim

#endif  // INVSIM_CONTACT_COULOMB_H_
