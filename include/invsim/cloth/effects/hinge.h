// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CLOTH_EFFECTS_HINGE_H_
#define INVSIM_CLOTH_EFFECTS_HINGE_H_

// The angle of a hinge: two triangles (x0, x1, x2) and (x1, x0, x3) that share
// the edge e = x1 - x0. With N2 = e x (x2 - x0), N3 = -e x (x3 - x0), twice
// the area vectors of the faces,
//
//   theta = atan2((N2 x N3) . e / |e|,  N2 . N3),
//
// zero when flat, positive where the surface bulges to the side the normals
// point to, +-pi when folded flat. (Grinspun et al. 2003; Bridson et al. 2003;
// for second derivatives also Tamstorf & Grinspun 2013.) With
//
//   u_k = -|e| N_k / |N_k|^2,   t_k = (x_k - x0) . e / |e|^2     (k = 2, 3)
//
// the gradient with respect to (x0, x1, x2, x3) is
//
//   [ -(1-t2) u2 - (1-t3) u3,   -t2 u2 - t3 u3,   u2,   u3 ] .
//
// A collapsed face has no angle, and the gradient grows without bound towards
// one. So |N_k| in the denominators is not let below kCollapse times its rest
// value, nor |e| below kCollapse times its rest length; the gradient is then
// bounded, continuous, and that of the angle up to this point. Beyond it the
// angle still turns as the formula without bounds says (AngleGradient).

#include "invsim/base/types.h"

namespace invsim {

inline constexpr double kCollapse = 0.01;

struct Hinge {
  using Vertices = Eigen::Matrix<double, 3, 4>;  // x0 x1 x2 x3
  using Slope = Eigen::Matrix<double, 12, 12>;

  double angle;       // radians, in [-pi, pi]
  Vertices gradient;  // 1/m
  bool collapsed;     // whether a bound is in `gradient`

  // The angle and its gradient. `rest_length` of the edge, m; `rest_area2`
  // and `rest_area3`: rest areas of the two faces, m^2.
  static Hinge At(const Vertices& x,
                  double rest_length,
                  double rest_area2,
                  double rest_area3);

  // How the angle turns, without bounds: equal to `gradient` unless something
  // has collapsed. A face without any area or an edge without length adds none.
  static Vertices AngleGradient(const Vertices& x);

  // The derivative of `gradient` (stacked): the Hessian of the angle, and
  // symmetric, unless something has collapsed.
  static Slope GradientSlope(const Vertices& x,
                             double rest_length,
                             double rest_area2,
                             double rest_area3);
};

}  // namespace invsim

#endif  // INVSIM_CLOTH_EFFECTS_HINGE_H_
