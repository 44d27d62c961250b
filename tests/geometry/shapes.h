// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_TESTS_GEOMETRY_SHAPES_H_
#define INVSIM_TESTS_GEOMETRY_SHAPES_H_

// Small meshes with known answers, for tests.

#include <cmath>
#include <map>
#include <utility>

#include "invsim/geometry/mesh.h"

namespace invsim {

// [0, 1]^3, two faces a side, outward. Vertex bits: x + 2 y + 4 z.
inline TriangleMesh UnitCube() {
  TriangleMesh m;
  m.vertices.resize(3, 8);
  for (int i = 0; i < 8; ++i)
    m.vertices.col(i) = Vector3d(i & 1, (i >> 1) & 1, (i >> 2) & 1);
  m.faces.resize(3, 12);
  m.faces << 0, 0, 4, 4, 0, 0, 2, 2, 0, 0, 1, 1,  //
      3, 2, 5, 7, 1, 5, 7, 6, 6, 4, 3, 7,         //
      1, 3, 7, 6, 5, 4, 3, 7, 2, 6, 7, 5;
  return m;
}

// An octahedron cut `levels` times into four and put on the unit sphere.
inline TriangleMesh Sphere(int levels) {
  TriangleMesh m;
  m.vertices.resize(3, 6);
  m.vertices << 1, -1, 0, 0, 0, 0,  //
      0, 0, 1, -1, 0, 0,            //
      0, 0, 0, 0, 1, -1;
  m.faces.resize(3, 8);
  m.faces << 0, 2, 1, 3, 2, 1, 3, 0,  //
      2, 1, 3, 0, 0, 2, 1, 3,         //
      4, 4, 4, 4, 5, 5, 5, 5;
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middle;
    const auto mid = [&](int a, int b) {
      const auto key = std::minmax(a, b);
      const auto [it, fresh] = middle.try_emplace(key, m.vertices.cols());
      if (fresh) {
        m.vertices.conservativeResize(Eigen::NoChange, m.vertices.cols() + 1);
        m.vertices.col(it->second) =
            (m.vertices.col(a) + m.vertices.col(b)).normalized();
      }
      return it->second;
    };
    Faces fine(3, 4 * m.faces.cols());
    for (int f = 0; f < m.faces.cols(); ++f) {
      const int a = m.faces(0, f), b = m.faces(1, f), c = m.faces(2, f);
      const int ab = mid(a, b), bc = mid(b, c), ca = mid(c, a);
      fine.middleCols<4>(4 * f) << a, b, c, ab, ab, bc, ca, bc, ca, ab, bc, ca;
    }
    m.faces = fine;
  }
  return m;
}

// An n x n grid of squares of side 1/n in the plane z = 0, normal +z.
inline TriangleMesh Grid(int n) {
  TriangleMesh m;
  m.vertices.resize(3, (n + 1) * (n + 1));
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      m.vertices.col(j * (n + 1) + i) = Vector3d(i, j, 0) / n;
  m.faces.resize(3, 2 * n * n);
  for (int j = 0, f = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i, f += 2) {
      const int v = j * (n + 1) + i;
      m.faces.col(f) << v, v + 1, v + n + 2;
      m.faces.col(f + 1) << v, v + n + 2, v + n + 1;
    }
  }
  return m;
}

// A block with a flat trough along z in its top: two walls that rise from the
// z axis to `rise` at |x| = `half`.
inline TriangleMesh Trough(double half, double rise) {
  const Eigen::Matrix<double, 2, 5> outline{{-half, half, half, 0, -half},
                                            {-half, -half, rise, 0, rise}};
  const int caps[3][3] = {{3, 4, 0}, {3, 0, 1}, {3, 1, 2}};
  TriangleMesh block;
  block.vertices.resize(3, 10);
  block.vertices.topRows<2>() << outline, outline;
  block.vertices.row(2) << Eigen::RowVectorXd::Constant(5, -half),
      Eigen::RowVectorXd::Constant(5, half);
  block.faces.resize(3, 16);
  int f = 0;
  for (int i = 0; i < 5; ++i) {
    const int j = (i + 1) % 5;
    block.faces.col(f++) << i, j, j + 5;
    block.faces.col(f++) << i, j + 5, i + 5;
  }
  for (const auto& c : caps) {
    block.faces.col(f++) << c[0], c[2], c[1];
    block.faces.col(f++) << c[0] + 5, c[1] + 5, c[2] + 5;
  }
  return block;
}

}  // namespace invsim

#endif  // INVSIM_TESTS_GEOMETRY_SHAPES_H_
