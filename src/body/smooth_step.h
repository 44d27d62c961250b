// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_BODY_SMOOTH_STEP_H_
#define INVSIM_SRC_BODY_SMOOTH_STEP_H_

// Once or twice continuously differentiable ways from 0 to 1, of which skin
// weights and shape directions are made.

#include <algorithm>

namespace invsim {

// 0 up to a, 1 from b on, 10 t^3 - 15 t^4 + 6 t^5 between: twice
// differentiable. a > b falls instead.
inline double SmoothStep(double a, double b, double x) {
  const double t = std::clamp((x - a) / (b - a), 0.0, 1.0);
  return t * t * t * (10.0 + t * (6.0 * t - 15.0));
}

// SmoothStep up from a to b, and down from c to d.
inline double Bump(double a, double b, double c, double d, double x) {
  return SmoothStep(a, b, x) * (1.0 - SmoothStep(c, d, x));
}

// max(0, x) with the corner rounded between -r and r.
inline double SmoothRamp(double r, double x) {
  if (x <= -r) return 0.0;
  if (x >= r) return x;
  return (x + r) * (x + r) / (4.0 * r);
}

// 0 up to a, 1 from b on, at even slope between but for corners rounded by r:
// how far a point is carried when the piece from a to b is made longer by one.
inline double EvenStep(double a, double b, double r, double x) {
  return (SmoothRamp(r, x - a) - SmoothRamp(r, x - b)) / (b - a);
}

}  // namespace invsim

#endif  // INVSIM_SRC_BODY_SMOOTH_STEP_H_
