// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_TESTS_CLOTH_TEST_CLOTH_H_
#define INVSIM_TESTS_CLOTH_TEST_CLOTH_H_

// Small sheets, materials and states on which the cloth tests run.

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "invsim/algebra/block_matrix.h"
#include "invsim/cloth/effect.h"
#include "invsim/cloth/garment.h"
#include "invsim/cloth/material.h"

namespace invsim {

// A flat sheet of nx by ny cells whose inner pattern points are moved by up to
// `jitter` cells; placed in the plane z = 0 as it lies in the pattern.
inline Garment Sheet(
    int nx, int ny, double cell, double jitter = 0.0, unsigned seed = 1) {
  Garment g;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> move(-jitter, jitter);
  g.rest.resize(2, (nx + 1) * (ny + 1));
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) {
      Vector2d p(i, j);
      const bool inner = i > 0 && i < nx && j > 0 && j < ny;
      if (inner) p += Vector2d(move(random), move(random));
      g.rest.col(j * (nx + 1) + i) = cell * p;
    }
  g.faces.resize(3, 2 * nx * ny);
  int f = 0;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int a = j * (nx + 1) + i, b = a + 1, c = a + nx + 1, d = c + 1;
      if ((i + j) % 2 == 0) {
        g.faces.col(f++) << a, b, d;
        g.faces.col(f++) << a, d, c;
      } else {
        g.faces.col(f++) << a, b, c;
        g.faces.col(f++) << b, d, c;
      }
    }
  g.rest_faces = g.faces;
  g.placed = Points::Zero(3, g.rest.cols());
  g.placed.topRows<2>() = g.rest;
  return g;
}

// Rows of (nearly) equilateral triangles with edges `edge` along x.
inline Garment TriangleSheet(int nx, int ny, double edge) {
  Garment g = Sheet(nx, ny, 1.0);
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i)
      g.rest.col(j * (nx + 1) + i) =
          edge * Vector2d(i + 0.5 * (j % 2), j * std::sqrt(0.75));
  int f = 0;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int a = j * (nx + 1) + i, b = a + 1, c = a + nx + 1, d = c + 1;
      if (j % 2 == 0) {
        g.faces.col(f++) << a, b, c;
        g.faces.col(f++) << b, d, c;
      } else {
        g.faces.col(f++) << a, b, d;
        g.faces.col(f++) << a, d, c;
      }
    }
  g.rest_faces = g.faces;
  g.placed.topRows<2>() = g.rest;
  return g;
}

// Invented figures of the size of a real fabric's, with a negative entry, as
// published tables have.
inline MeasuredStretch ExampleStretchTable() {
  return {{{{20.0, -5.0, 35.0, 30.0},
            {45.0, 50.0, 250.0, 20.0},
            {50.0, 80.0, 200.0, 25.0},
            {120.0, 100.0, 360.0, 40.0},
            {140.0, 70.0, 410.0, -15.0},
            {130.0, 85.0, 400.0, 30.0}}}};
}

inline MeasuredBending ExampleBendingTable() {
  return {{{{20e-6, 30e-6, 35e-6, 40e-6, 25e-6},
            {25e-6, 18e-6, 16e-6, 25e-6, 9e-6},
            {14e-6, 7e-6, 15e-6, 24e-6, 19e-6}}}};
}

inline std::vector<Material> ExampleMaterials() {
  return {
      {"isotropic", 0.15, IsotropicStretch{150.0, 0.3}, IsotropicBending{8e-6}},
      {"orthotropic",
       0.2,
       OrthotropicStretch{300.0, 60.0, 500.0, 40.0},
       IsotropicBending{2e-5}},
      {"measured", 0.187, ExampleStretchTable(), ExampleBendingTable()}};
}

inline Points RandomPoints(int n, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-size, size);
  Points p(3, n);
  for (int i = 0; i < p.size(); ++i) p.data()[i] = value(random);
  return p;
}

inline MatrixXd Dense(const BlockMatrix& a) {
  const BlockPattern& p = a.pattern();
  MatrixXd dense = MatrixXd::Zero(3 * p.size, 3 * p.size);
  for (int i = 0; i < p.size; ++i)
    for (int k = p.row_start[i]; k < p.row_start[i + 1]; ++k)
      dense.block<3, 3>(3 * i, 3 * p.column[k]) = a.block(k);
  return dense;
}

// The pattern of one effect, bound to it.
inline std::shared_ptr<const BlockPattern> BindAlone(Effect* effect,
                                                     int vertices) {
  BlockPatternBuilder builder(vertices);
  effect->AddStencils(&builder);
  auto pattern = builder.Build();
  effect->Bind(*pattern);
  return pattern;
}

inline Points ForceOf(const Effect& effect, const ClothState& y) {
  Points force = Points::Zero(3, y.x.cols());
  effect.AddForce(y, &force);
  return force;
}

inline MatrixXd StiffnessOf(const Effect& effect,
                            std::shared_ptr<const BlockPattern> pattern,
                            const ClothState& y,
                            double x_scale,
                            double v_scale) {
  BlockMatrix a(std::move(pattern));
  a.SetZero();
  effect.AddStiffness(y, x_scale, v_scale, &a);
  return Dense(a);
}

// The numbers 0 ... n - 1 that satisfy `predicate`.
template <typename Predicate>
Eigen::VectorXi Where(int n, const Predicate& predicate) {
  Eigen::VectorXi chosen(n);
  int count = 0;
  for (int i = 0; i < n; ++i)
    if (predicate(i)) chosen[count++] = i;
  return chosen.head(count);
}

// Derivative at zero of a vector function of one number, by central
// differences extrapolated twice (error h^6).
template <typename Function>
VectorXd Derivative(const Function& function, double h) {
  const auto central = [&](double s) -> VectorXd {
    return (function(s) - function(-s)) / (2.0 * s);
  };
  const VectorXd d1 = central(h), d2 = central(h / 2), d4 = central(h / 4);
  const VectorXd r1 = (4.0 * d2 - d1) / 3.0, r2 = (4.0 * d4 - d2) / 3.0;
  return (16.0 * r2 - r1) / 15.0;
}

// The Jacobian of `function` of points, column by column.
inline MatrixXd Jacobian(const std::function<VectorXd(const Points&)>& function,
                         const Points& at,
                         double h) {
  MatrixXd jacobian(function(at).size(), at.size());
  for (int k = 0; k < at.size(); ++k)
    jacobian.col(k) = Derivative(
        [&](double s) {
          Points moved = at;
          moved.data()[k] += s;
          return function(moved);
        },
        h);
  return jacobian;
}

}  // namespace invsim

#endif  // INVSIM_TESTS_CLOTH_TEST_CLOTH_H_
