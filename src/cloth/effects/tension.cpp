// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/effects/tension.h"

#include <cmath>

namespace invsim {

Vector3d TensilePart(const Vector3d& stress, Matrix3d* derivative) {
  const double m = 0.5 * (stress[0] + stress[1]);
  const double d = 0.5 * (stress[0] - stress[1]);
  const double s = stress[2];
  const double r = std::sqrt(d * d + s * s);
  if (m >= r) {
    if (derivative) derivative->setIdentity();
    return stress;
  }
  if (m <= -r) {
    if (derivative) derivative->setZero();
    return Vector3d::Zero();
  }
  // Here |m| < r, so r > 0 and every quotient below is at most one.
  const double c = d / r;
  const double q = s / r;
  const double p = m / r;
  if (derivative) {
    // Rows: tensors I and R/r written as (11, 22, 12).
    const Vector3d identity(1.0, 1.0, 0.0);
    const Vector3d unit(c, -c, q);
    // Gradients of m, d, s, r with respect to (S11, S22, S12).
    const Eigen::RowVector3d dm(0.5, 0.5, 0.0);
    const Eigen::RowVector3d dd(0.5, -0.5, 0.0);
    const Eigen::RowVector3d ds(0.0, 0.0, 1.0);
    const Eigen::RowVector3d dr = c * dd + q * ds;
    Matrix3d d_deviator;
    d_deviator << dd, -dd, ds;
    *derivative = 0.5 * (identity * (dm + dr) + (p + 1.0) * d_deviator +
                         unit * (dm - p * dr));
  }
  return 0.5 * (m + r) * Vector3d(1.0 + c, 1.0 - c, q);
}

}  // namespace invsim
