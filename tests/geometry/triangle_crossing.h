// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_TESTS_GEOMETRY_TRIANGLE_CROSSING_H_
#define INVSIM_TESTS_GEOMETRY_TRIANGLE_CROSSING_H_

// Whether triangles cross, by a way of its own (Moeller, A fast triangle-
// triangle intersection test, 1997): each triangle cuts the plane of the other
// along a stretch of the line in which the planes meet; the triangles cross if
// the two stretches have a length in common. Every pair is tried.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <vector>

#include "invsim/base/types.h"

namespace invsim {

// The stretch of a triangle on the plane n . x = offset, |n| = 1, as parameters
// along `line`; false if it does not reach through the plane. What is within a
// ten-millionth of a metre of it lies in it.
inline bool Stretch(const Matrix3d& t,
                    const Vector3d& n,
                    double offset,
                    const Vector3d& line,
                    std::array<double, 2>* stretch) {
  Eigen::RowVector3d side = (n.transpose() * t).array() - offset;
  side = (side.array().abs() < 1e-7).select(0, side);
  *stretch = {1e300, -1e300};
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    if (!(side[a] < 0 && side[b] >= 0) && !(side[a] >= 0 && side[b] < 0))
      continue;
    const double s = side[a] / (side[a] - side[b]);
    const double at = line.dot((1 - s) * t.col(a) + s * t.col(b));
    (*stretch)[0] = std::min((*stretch)[0], at);
    (*stretch)[1] = std::max((*stretch)[1], at);
  }
  return (*stretch)[0] <= (*stretch)[1];
}

inline bool TrianglesCross(const Matrix3d& s, const Matrix3d& t) {
  const Vector3d n =
      (s.col(1) - s.col(0)).cross(s.col(2) - s.col(0)).normalized();
  const Vector3d m =
      (t.col(1) - t.col(0)).cross(t.col(2) - t.col(0)).normalized();
  const Vector3d line = n.cross(m);
  std::array<double, 2> a, b;
  if (line.norm() == 0 ||
      !Stretch(s, m, m.dot(t.col(0)), line.normalized(), &a) ||
      !Stretch(t, n, n.dot(s.col(0)), line.normalized(), &b))
    return false;
  return std::min(a[1], b[1]) - std::max(a[0], b[0]) > 1e-9;
}

// Pairs of faces that cross; faces with a common edge do not.
inline int CountCrossings(const Points& x, const Faces& faces) {
  const int n = static_cast<int>(faces.cols());
  std::vector<Matrix3d> triangles(n);
  Points low(3, n), high(3, n);
  for (int f = 0; f < n; ++f) {
    for (int k = 0; k < 3; ++k) triangles[f].col(k) = x.col(faces(k, f));
    low.col(f) = triangles[f].rowwise().minCoeff();
    high.col(f) = triangles[f].rowwise().maxCoeff();
  }
  int count = 0;
  for (int f = 0; f < n; ++f) {
    for (int g = f + 1; g < n; ++g) {
      if ((low.col(f).array() > high.col(g).array()).any() ||
          (low.col(g).array() > high.col(f).array()).any())
        continue;
      int shared = 0;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) shared += faces(i, f) == faces(j, g);
      count += shared < 2 && TrianglesCross(triangles[f], triangles[g]);
    }
  }
  return count;
}

}  // namespace invsim

#endif  // INVSIM_TESTS_GEOMETRY_TRIANGLE_CROSSING_H_
