// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_BODY_LOFT_H_
#define INVSIM_SRC_BODY_LOFT_H_

// Solids swept along a coordinate axis: a limb, a torso, a head. At the place
// s of the axis the section is a superellipse about (u, v),
//
//   (|du| / ru)^n + (|dv| / rv)^n = 1,
//
// with a half axis of its own on each side. Between stations all numbers run
// as cubic Hermite splines; beyond the last ones they run straight on, and the
// sections shrink to nothing within the length of the cap, as an ellipsoid's.

#include <vector>

#include "invsim/base/types.h"

namespace invsim {

struct Station {
  double s;                // place along the axis
  double u, v;             // centre of the section
  double u_plus, u_minus;  // half axes along u
  double v_plus, v_minus;  // half axes along v
  double exponent = 2.0;   // 2: ellipse; larger: squarer
};

class Loft {
 public:
  // axis 0: along x, (u, v) = (y, z); 1: along y, (u, v) = (x, z); 2: along z,
  // (u, v) = (x, y). Stations ascend; cap_low and cap_high are the lengths of
  // the caps.
  Loft(int axis,
       std::vector<Station> stations,
       double cap_low,
       double cap_high);

  // Negative inside; near the surface, the distance to it to first order for
  // sections that change slowly along the axis.
  double Distance(const Vector3d& x) const;

 private:
  static constexpr int kNumChannels = 7;
  using Channels = Eigen::Array<double, kNumChannels, 1>;

  Channels At(double s) const;

  int axis_;
  double cap_low_;
  double cap_high_;
  std::vector<double> places_;
  std::vector<Channels> values_;
  std::vector<Channels> slopes_;
  // A box round the solid, from which far points take their distance.
  Vector3d low_;
  Vector3d high_;
};

// The smaller of two distances with the corner rounded: differs from
// min(a, b) only where |a - b| < k, by at most k / 4 (once continuously
// differentiable; symmetric in a and b).
double SmoothMin(double a, double b, double k);

}  // namespace invsim

#endif  // INVSIM_SRC_BODY_LOFT_H_
