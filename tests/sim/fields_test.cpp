// SPDX-License-Identifier: Apache-2.0
#include "invsim/sim/fields.h"

#include <gtest/gtest.h>

#include "geometry/shapes.h"
#include "invsim/geometry/mesh.h"
#include "sim/test_scene.h"

namespace invsim {
namespace {

TEST(MeasureCloth, OfAUniaxialStretchIsKnown) {
  const Garment sheet = Sheet(3, 3, 0.1);
  const double stiffness = 100, poisson = 0.25, stretch = 1.02;
  Points x = sheet.placed;
  x.row(0) *= stretch;
  const ClothFields fields =
      MeasureCloth(sheet, IsotropicStretch{stiffness, poisson}, x);
  const double e = 0.5 * (stretch * stretch - 1);
  const double scale = stiffness / (1 - poisson * poisson) * e;
  // Cauchy stress F S F^T / det F, S11 = scale, S22 = poisson scale.
  const double s1 = scale * stretch, s2 = poisson * scale / stretch;
  const double von_mises = std::sqrt(s1 * s1 - s1 * s2 + s2 * s2);
  for (int i = 0; i < sheet.num_vertices(); ++i) {
    EXPECT_NEAR(fields.strain[i], 0.02, 1e-12);
    EXPECT_NEAR(fields.stress[i], von_mises, 1e-9);
  }
}

TEST(MeasureCloth, ShearStretchesAlongTheDiagonal) {
  const Garment sheet = Sheet(2, 2, 0.1);
  const double shear = 0.1;
  Points x = sheet.placed;
  x.row(0) += shear * sheet.placed.row(1);
  const ClothFields fields = MeasureCloth(sheet, IsotropicStretch{100.0}, x);
  // The larger singular value of [1 s; 0 1].
  const double largest = 0.5 * (shear + std::sqrt(4 + shear * shear));
  EXPECT_NEAR(fields.strain.maxCoeff(), largest - 1, 1e-12);
  EXPECT_NEAR(fields.strain.minCoeff(), largest - 1, 1e-12);
}

TEST(MeasureCloth, AtRestIsZeroHoweverItIsTurned) {
  const Garment sheet = SheetAboveBall(3, 0.3);
  const ClothFields fields =
      MeasureCloth(sheet, IsotropicStretch{100.0}, sheet.placed);
  EXPECT_LT(fields.strain.cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT(fields.stress.cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Pressure, OfEvenForcesOnABallIsForceOverArea) {
  const TriangleMesh ball = Sphere(3);
  VectorXd areas = VectorXd::Zero(ball.vertices.cols());
  const VectorXd faces = FaceAreas(ball.vertices, ball.faces);
  for (int f = 0; f < ball.faces.cols(); ++f)
    for (int k = 0; k < 3; ++k) areas[ball.faces(k, f)] += faces[f] / 3;
  Points force =
      -7.0 * VertexNormals(ball.vertices, ball.faces) * areas.asDiagonal();
  const VectorXd pressure = Pressure(ball.vertices, ball.faces, force);
  EXPECT_LT((pressure.array() - 7.0).abs().maxCoeff(), 1e-12);
  // What pulls sideways does not press.
  force.setZero();
  force(0, 4) = 1.0;  // the vertex at +z
  EXPECT_NEAR(Pressure(ball.vertices, ball.faces, force)[4], 0, 1e-12);
}

}  // namespace
}  // namespace invsim
