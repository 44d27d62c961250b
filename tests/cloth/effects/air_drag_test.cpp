// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/effects/air_drag.h"

#include <gtest/gtest.h>

#include "../test_cloth.h"

namespace invsim {
namespace {

// A square of 2 m x 1 m in the plane z = 0.
struct Plate {
  Garment garment = Sheet(2, 1, 1.0);
  ClothState y{garment.placed, Points::Zero(3, 6)};
  Vector3d Push(const AirDragOptions& options) const {
    return ForceOf(AirDrag(garment.faces, options), y).rowwise().sum();
  }
};

TEST(AirDrag, PlateAcrossTheWindFeelsTheQuadraticLaw) {
  const Plate plate;
  // 1/2 rho c A u^2, along the wind either way.
  const double push = 0.5 * 1.2 * 1.17 * 2.0 * 9.0;
  EXPECT_LE(
      (plate.Push({.wind = Vector3d(0, 0, 3)}) - Vector3d(0, 0, push)).norm(),
      1e-13);
  EXPECT_LE(
      (plate.Push({.wind = Vector3d(0, 0, -3)}) + Vector3d(0, 0, push)).norm(),
      1e-13);
}

TEST(AirDrag, PlateAlongTheWindFeelsFrictionOnly) {
  const Plate plate;
  const Vector3d push = plate.Push({.wind = Vector3d(3, 4, 0)});
  EXPECT_LE((push - 0.5 * 1.2 * 0.01 * 2.0 * 5.0 * Vector3d(3, 4, 0)).norm(),
            1e-13);
}

TEST(AirDrag, LinearLawAddsUp) {
  const Plate plate;
  const Vector3d push = plate.Push({.wind = Vector3d(1, 0, 2),
                                    .air_density = 0.0,
                                    .linear_normal = 0.3,
                                    .linear_tangential = 0.1});
  EXPECT_LE((push - 2.0 * Vector3d(0.1, 0.0, 0.6)).norm(), 1e-14);
}

TEST(AirDrag, VanishesForClothThatGoesWithTheWind) {
  Plate plate;
  plate.y.v.colwise() = Vector3d(1, -2, 3);
  EXPECT_EQ(plate.Push({.wind = Vector3d(1, -2, 3)}).norm(), 0.0);
  // and takes energy from cloth that moves in still air.
  const Points force = ForceOf(AirDrag(plate.garment.faces, {}), plate.y);
  EXPECT_LT(force.cwiseProduct(plate.y.v).sum(), 0.0);
}

// At the kinks of the law: still air, and wind straight across or along.
TEST(AirDrag, IsFiniteAtSpecialStreams) {
  const Plate plate;
  for (const Vector3d& wind :
       {Vector3d(0, 0, 0), Vector3d(0, 0, 2), Vector3d(2, 0, 0)}) {
    AirDrag drag(plate.garment.faces, {.wind = wind});
    const auto pattern = BindAlone(&drag, 6);
    BlockMatrix h_x(pattern), h_v(pattern);
    h_x.SetZero();
    h_v.SetZero();
    const Points w = RandomPoints(6, 1.0, 2);
    drag.AddTangent(plate.y, w, w, 1.0, &h_x, &h_v);
    EXPECT_TRUE(Dense(h_x).allFinite());
    EXPECT_TRUE(Dense(h_v).allFinite());
    const ClothState nowhere{Points::Zero(3, 6), w};
    EXPECT_EQ(ForceOf(drag, nowhere).norm(), 0.0);
  }
}

TEST(AirDrag, TangentIsExactWithEveryTerm) {
  const Garment garment = Sheet(2, 2, 0.05, 0.2);
  AirDrag drag(garment.faces,
               {.wind = Vector3d(0.5, -1.0, 2.0),
                .tangential = 0.3,
                .linear_normal = 0.4,
                .linear_tangential = 0.2});
  const auto pattern = BindAlone(&drag, 9);
  const ClothState y{garment.placed + RandomPoints(9, 0.01, 4),
                     RandomPoints(9, 1.0, 5)};
  const Points dv = RandomPoints(9, 1.0, 6);
  BlockMatrix h_x(pattern), h_v(pattern);
  h_x.SetZero();
  h_v.SetZero();
  drag.AddTangent(y, dv, dv, 1.0, &h_x, &h_v);
  const auto g = [&](const ClothState& s) -> VectorXd {
    return StiffnessOf(drag, pattern, s, 0.0, 1.0) * Stacked(dv) -
           Stacked(ForceOf(drag, s));
  };
  const MatrixXd by_x = Jacobian(
      [&](const Points& x) {
        return g({x, y.v});
      },
      y.x,
      1e-5);
  const MatrixXd by_v = Jacobian(
      [&](const Points& v) {
        return g({y.x, v});
      },
      y.v,
      1e-3);
  EXPECT_LE((Dense(h_x) - by_x).norm(), 1e-9 * by_x.norm());
  EXPECT_LE((Dense(h_v) - by_v).norm(), 1e-9 * by_v.norm());
}

}  // namespace
}  // namespace invsim
