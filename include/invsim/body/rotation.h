// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_BODY_ROTATION_H_
#define INVSIM_BODY_ROTATION_H_

// Rotations as axis-angle vectors v (axis times angle, radians), as SMPL and
// AMASS keep them, and as matrices. With x = |v| and [v] the matrix of the
// cross product, [v] a = v x a (Rodrigues 1840; Sola, Deray, Atchuthan, "A
// micro Lie theory", 2018, eqs. 133-149):
//
//   Exp(v)          = I + (sin x / x) [v] + ((1 - cos x) / x^2) [v]^2
//   LeftJacobian(v) = I + ((1 - cos x) / x^2) [v] + ((x - sin x) / x^3) [v]^2
//   Exp(v + dv)     = Exp(LeftJacobian(v) dv) Exp(v) + O(|dv|^2)
//
// Every function holds at v = 0 and at any number of turns. At |v| = 2 pi n,
// n > 0, LeftJacobian has rank one (turning the axis does nothing there); that
// is a fact, not a failure.

#include <array>

#include "invsim/base/types.h"

namespace invsim {

// sin x / x, (1 - cos x) / x^2 and (x - sin x) / x^3 as functions of x^2, to
// full precision down to and at x = 0 (1, 1/2 and 1/6).
double SinOverX(double x_squared);
double OneMinusCosOverX2(double x_squared);
double XMinusSinOverX3(double x_squared);

// [v]: Cross(v) a = v x a.
Matrix3d Cross(const Vector3d& v);

Matrix3d Exp(const Vector3d& v);
Matrix3d LeftJacobian(const Vector3d& v);

// Element c is the derivative of Exp(v) by v_c, [LeftJacobian(v) e_c] Exp(v).
std::array<Matrix3d, 3> ExpDerivatives(const Vector3d& v);

// The axis-angle vector of a rotation with |Log(r)| <= pi, accurate from the
// identity to half a turn (where either sign of the axis would do).
Vector3d Log(const Matrix3d& r);

// The angle between two rotations, |Log(a^T b)|, in [0, pi].
double GeodesicDistance(const Matrix3d& a, const Matrix3d& b);

// The rotation at fraction s of the shortest way from a to b at constant
// angular velocity: a Exp(s Log(a^T b)).
Matrix3d Slerp(const Matrix3d& a, const Matrix3d& b, double s);

// Among the vectors of the same rotation as v, v (1 + 2 pi k / |v|), the one
// nearest to `reference`. A smooth rotation whose vectors wrap around becomes
// a smooth path of vectors if each frame refers to the one before, unless it
// passes near a whole turn: there the axis may swing round within a frame, and
// no choice of vectors is smooth.
Vector3d NearestEquivalent(const Vector3d& v, const Vector3d& reference);

}  // namespace invsim

#endif  // INVSIM_BODY_ROTATION_H_
