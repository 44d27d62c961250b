// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/effects/hinge.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace invsim {
namespace {

// m [v]x, where [v]x w = v x w.
Matrix3d TimesCross(const Matrix3d& m, const Vector3d& v) {
  return m.rowwise().cross(v.transpose());
}

// The shared edge, its length kept off zero in `length`.
struct HingeEdge {
  Vector3d vector;
  Vector3d direction;  // zero if there is none
  double length;
  bool collapsed;
};

inline HingeEdge EdgeOf(const Hinge::Vertices& x, double rest_length) {
  const Vector3d e = x.col(1) - x.col(0);
  const double length = e.norm();
  const double least = kCollapse * rest_length;
  const Vector3d direction =
      length > 0 ? Vector3d(e / length) : Vector3d::Zero();
  return {e, direction, std::max(length, least), length < least};
}

// One face seen from the hinge: u and t of the header.
struct Wing {
  Vector3d normal;  // N
  double square;    // |N|^2, kept off zero
  bool collapsed;
  Vector3d u;
  double t;
};

// `side` is +1 for face (x0, x1, xk), -1 for (x1, x0, xk).
inline Wing WingOf(const HingeEdge& e,
                   const Vector3d& arm,
                   double side,
                   double rest_area) {
  Wing w;
  w.normal = side * e.vector.cross(arm);
  w.square = w.normal.squaredNorm();
  const double least = kCollapse * 2.0 * rest_area;
  w.collapsed = w.square < least * least;
  if (w.collapsed) w.square = least * least;
  if (w.square == 0 || e.length == 0) {
    w.u.setZero();
    w.t = 0;
    return w;
  }
  w.u = -(e.length / w.square) * w.normal;
  w.t = arm.dot(e.vector) / (e.length * e.length);
  return w;
}

// Derivatives of u and t of one wing by (x0, x1, xk).
struct WingSlope {
  Matrix3d u[3];
  Eigen::RowVector3d t[3];
};

WingSlope SlopeOf(const HingeEdge& e,
                  const Vector3d& arm,
                  double side,
                  const Wing& w) {
  const double inverse_square = 1.0 / (e.length * e.length);
  const Vector3d direction = e.collapsed ? Vector3d::Zero() : e.direction;
  // d(N / |N|^2) = (I - 2 n n^T) dN / |N|^2.
  Matrix3d shape = Matrix3d::Identity() / w.square;
  if (!w.collapsed)
    shape -= (2.0 / (w.square * w.square)) * w.normal * w.normal.transpose();
  const Matrix3d from_normal = -e.length * side * shape;
  const Matrix3d from_length = -(w.normal / w.square) * direction.transpose();

  WingSlope s;
  // N = side (x1 - x0) x (xk - x0).
  s.u[0] = TimesCross(from_normal, arm - e.vector) - from_length;
  s.u[1] = from_length - TimesCross(from_normal, arm);
  s.u[2] = TimesCross(from_normal, e.vector);
  const Eigen::RowVector3d shrink =
      (2.0 * w.t / e.length) * direction.transpose();
  s.t[0] = -(e.vector + arm).transpose() * inverse_square + shrink;
  s.t[1] = arm.transpose() * inverse_square - shrink;
  s.t[2] = e.vector.transpose() * inverse_square;
  return s;
}

}  // namespace

Hinge Hinge::At(const Vertices& x,
                double rest_length,
                double rest_area2,
                double rest_area3) {
  const HingeEdge e = EdgeOf(x, rest_length);
  const Wing w2 = WingOf(e, x.col(2) - x.col(0), 1.0, rest_area2);
  const Wing w3 = WingOf(e, x.col(3) - x.col(0), -1.0, rest_area3);
  Hinge hinge;
  hinge.angle = std::atan2(w2.normal.cross(w3.normal).dot(e.direction),
                           w2.normal.dot(w3.normal));
  hinge.gradient.col(0) = -(1.0 - w2.t) * w2.u - (1.0 - w3.t) * w3.u;
  hinge.gradient.col(1) = -w2.t * w2.u - w3.t * w3.u;
  hinge.gradient.col(2) = w2.u;
  hinge.gradient.col(3) = w3.u;
  hinge.collapsed = e.collapsed || w2.collapsed || w3.collapsed;
  return hinge;
}

Hinge::Vertices Hinge::AngleGradient(const Vertices& x) {
  return At(x, 0, 0, 0).gradient;
}

Hinge::Slope Hinge::GradientSlope(const Vertices& x,
                                  double rest_length,
                                  double rest_area2,
                                  double rest_area3) {
  const HingeEdge e = EdgeOf(x, rest_length);
  const double rest_area[2] = {rest_area2, rest_area3};
  Slope h = Slope::Zero();
  for (int k = 0; k < 2; ++k) {
    const double side = k == 0 ? 1.0 : -1.0;
    const Vector3d arm = x.col(2 + k) - x.col(0);
    const Wing w = WingOf(e, arm, side, rest_area[k]);
    const WingSlope s = SlopeOf(e, arm, side, w);
    const int columns[3] = {0, 3, 6 + 3 * k};
    for (int j = 0; j < 3; ++j) {
      const Matrix3d turn = w.u * s.t[j];
      h.block<3, 3>(0, columns[j]) += turn - (1.0 - w.t) * s.u[j];
      h.block<3, 3>(3, columns[j]) += -turn - w.t * s.u[j];
      h.block<3, 3>(6 + 3 * k, columns[j]) += s.u[j];
    }
  }
  return h;
}

}  // namespace invsim
