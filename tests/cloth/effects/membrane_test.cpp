// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/effects/membrane.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "../test_cloth.h"

namespace invsim {
namespace {

using Matrix32 = Eigen::Matrix<double, 3, 2>;

Matrix32 SomeGradient() {
  Matrix32 f;
  f << 1.08, 0.1, -0.05, 1.02, 0.0, 0.0;
  const Eigen::AngleAxisd turn(0.7, Vector3d(1, 2, -1).normalized());
  return turn.toRotationMatrix() * f;
}

bool OnBorder(const Garment& g, int i) {
  const Vector2d top = g.rest.rowwise().maxCoeff();
  const Vector2d p = g.rest.col(i);
  return p.x() < 1e-9 || p.y() < 1e-9 || p.x() > top.x() - 1e-9 ||
         p.y() > top.y() - 1e-9;
}

// A uniform deformation of an irregular mesh: every face has the same strain,
// nothing is left over inside, and the border carries the traction P N.
TEST(Membrane, PassesThePatchTest) {
  const Garment garment = Sheet(5, 4, 0.02, 0.3);
  const Matrix32 f = SomeGradient();
  const Matrix2d e = 0.5 * (f.transpose() * f - Matrix2d::Identity());
  for (const Material& material : ExampleMaterials()) {
    const Membrane membrane(garment, material.stretch);
    const Points x = f * garment.rest;
    const MembraneFields fields = membrane.Fields(x);
    const Vector3d strain(e(0, 0), e(1, 1), 2.0 * e(0, 1));
    EXPECT_LE((fields.strain.colwise() - strain).norm(), 1e-13);
    const Vector3d s = fields.stress.col(0);
    EXPECT_LE((fields.stress.colwise() - s).norm(), 1e-11 * s.norm());

    const Points force = ForceOf(membrane, {x, Points::Zero(3, x.cols())});
    for (int i = 0; i < x.cols(); ++i)
      if (!OnBorder(garment, i)) {
        EXPECT_LE(force.col(i).norm(), 1e-13 * s.norm());
      }
    // A vertex inside the right border carries P N over one cell, N = +x.
    Matrix2d stress;
    stress << s[0], s[2], s[2], s[1];
    const int right = 2 * 6 + 5;
    EXPECT_LE((force.col(right) + 0.02 * (f * stress).col(0)).norm(),
              1e-12 * s.norm());
    EXPECT_LE(force.rowwise().sum().norm(), 1e-13 * s.norm());
  }
}

// A strip pulled by its ends with its sides free: force = Y strain width.
TEST(Membrane, StripResistsWithItsStiffness) {
  const double y = 200.0, nu = 0.4, cell = 0.02;
  const int nx = 8, ny = 3;
  const Garment garment = Sheet(nx, ny, cell, 0.25);
  Membrane membrane(garment, IsotropicStretch{y, nu});
  const auto pattern = BindAlone(&membrane, garment.num_vertices());
  const double stretch = 1e-4, length = nx * cell, width = ny * cell;

  // Free are x between the ends and y but for one corner; z stays.
  const Eigen::VectorXi free = Where(3 * garment.num_vertices(), [&](int k) {
    const double u = garment.rest(0, k / 3);
    if (k % 3 == 0) return u > 1e-9 && u < length - 1e-9;
    return k % 3 == 1 && k != 1;
  });
  ClothState state{garment.placed, Points::Zero(3, garment.num_vertices())};
  for (int i = 0; i < garment.num_vertices(); ++i)
    if (garment.rest(0, i) > length - 1e-9) state.x(0, i) += stretch * length;
  for (int iteration = 0; iteration < 6; ++iteration) {
    BlockMatrix h(pattern), unused(pattern);
    h.SetZero();
    const Points zero = Points::Zero(3, garment.num_vertices());
    membrane.AddTangent(state, zero, zero, 1.0, &h, &unused);
    const MatrixXd k = Dense(h)(free, free);
    const Points force = ForceOf(membrane, state);
    const VectorXd step = k.lu().solve(Stacked(force)(free));
    Stacked(state.x)(free) += step;
  }
  const Points force = ForceOf(membrane, state);
  double pull = 0.0;
  for (int i = 0; i < garment.num_vertices(); ++i)
    if (garment.rest(0, i) > length - 1e-9) pull -= force(0, i);
  EXPECT_NEAR(pull, y * stretch * width, 3e-4 * y * stretch * width);
  // and narrows by Poisson's ratio.
  const double top = state.x(1, ny * (nx + 1));
  EXPECT_NEAR(top - state.x(1, 0),
              width * (1.0 - nu * stretch),
              1e-3 * width * nu * stretch);
}

TEST(Membrane, VonMisesOfOneDirectionIsItsCauchyStress) {
  const Garment garment = Sheet(1, 1, 1.0);
  const Membrane membrane(garment, OrthotropicStretch{100.0, 0.0, 50.0, 10.0});
  Points x = garment.placed;
  x.row(0) *= 1.2;  // S11 = 100 (1.44 - 1)/2 = 22, Cauchy 22 * 1.44 / 1.2
  const MembraneFields fields = membrane.Fields(x);
  EXPECT_NEAR(fields.stress(0, 0), 22.0, 1e-12);
  EXPECT_NEAR(fields.von_mises[0], 26.4, 1e-12);
  EXPECT_NEAR(fields.von_mises[1], 26.4, 1e-12);
}

TEST(Membrane, SurvivesCollapsedFaces) {
  const Garment garment = Sheet(2, 2, 0.02);
  const Membrane membrane(garment, ExampleStretchTable());
  const Points x = Points::Zero(3, garment.num_vertices());
  EXPECT_TRUE(ForceOf(membrane, {x, x}).allFinite());
  EXPECT_TRUE(membrane.Fields(x).von_mises.allFinite());
}

TEST(FaceToVertexAverage, WeighsByArea) {
  Garment garment = Sheet(1, 1, 1.0);
  garment.rest.col(3) = Vector2d(3.0, 3.0);  // the second corner further out
  MatrixXd per_face(1, 2);
  per_face << 1.0, 4.0;
  const MatrixXd average = FaceToVertexAverage(garment, per_face);
  const double a = 1.5, b = 1.5;  // 0-1-3 and 0-3-2
  EXPECT_NEAR(average(0, 0), (a * 1.0 + b * 4.0) / (a + b), 1e-15);
  EXPECT_NEAR(average(0, 1), 1.0, 1e-15);
  EXPECT_NEAR(average(0, 2), 4.0, 1e-15);
}

}  // namespace
}  // namespace invsim
