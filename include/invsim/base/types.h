// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_BASE_TYPES_H_
#define INVSIM_BASE_TYPES_H_

// The array types every layer speaks. Vertices and faces are columns, so that
// `Points` of N vertices is also, byte for byte, the stacked vector of R^{3N}
// in which the equations are written (see `Stacked`).

#include <Eigen/Core>

namespace invsim {

// 3 x N; column i is vertex i. Metres (or m/s for velocities, N for forces).
using Points = Eigen::Matrix3Xd;
// 3 x F; column f holds the vertex numbers of triangle f, counter-clockwise
// seen from outside.
using Faces = Eigen::Matrix3Xi;
// 2 x R pattern points in metres.
using Points2 = Eigen::Matrix2Xd;

// Many right sides at once, one row per scalar unknown, one column per side:
// the rows of a vertex lie together, which is how sparse kernels read them.
using Columns =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Views of the same memory: (3 x N) points as the vector (x0 y0 z0 x1 ...).
inline Eigen::Map<const VectorXd> Stacked(const Points& p) {
  return {p.data(), p.size()};
}
inline Eigen::Map<VectorXd> Stacked(Points& p) { return {p.data(), p.size()}; }

}  // namespace invsim

#endif  // INVSIM_BASE_TYPES_H_
