// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CLOTH_CONE_CUT_H_
#define INVSIM_CLOTH_CONE_CUT_H_

// The opening of a garment (neck, cuff, armhole) as the curve where a wavy
// cone cuts its surface. Round an axis, at angle psi, the curve is to be at
// height A(psi) along the axis and radius R(psi) from it; what lies above the
// cone through it,
//
//   g(x) = slope (r(x) - R(psi)) - (a(x) - A(psi)) < 0,
//
// is cut away. With slope 1 the cone meets both a shoulder, which is nearly
// level, and a chest, which is nearly upright, at an angle, and far from the
// axis nothing is cut.

#include <array>

#include "invsim/base/types.h"

namespace invsim {

class ConeCut {
 public:
  // Where the curve is to be.
  struct Anchor {
    double height = 0.0;  // along the axis, metres from the centre
    double radius = 0.0;  // from the axis, metres
  };

  // Anchors at psi = 0, 90, 180, 270 degrees: in the direction `first`, of
  // axis x first, opposite `first`, opposite the second. Between anchors a and
  // b the curve goes as a cos^2 + b sin^2.
  ConeCut(const Vector3d& centre,
          const Vector3d& axis,
          const Vector3d& first,
          const std::array<Anchor, 4>& anchors,
          double slope);

  // Positive where the garment stays.
  double Value(const Vector3d& x) const;

  // The curve at angle psi (radians).
  Vector3d Curve(double psi) const;

 private:
  Anchor At(double cosine, double sine) const;

  Vector3d centre_, axis_, first_, second_;
  std::array<Anchor, 4> anchors_;
  double slope_;
};

}  // namespace invsim

#endif  // INVSIM_CLOTH_CONE_CUT_H_
