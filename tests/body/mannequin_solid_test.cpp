// SPDX-License-Identifier: Apache-2.0
#include "../../src/body/mannequin_solid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "invsim/body/mannequin.h"
#include "invsim/geometry/surface_index.h"

namespace invsim {
namespace {

std::vector<Vector3d> PointsAround() {
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> x(-.95, .95), y(-1.2, .7), z(-.2, .2);
  std::vector<Vector3d> points;
  for (int k = 0; k < 3000; ++k) points.emplace_back(x(rng), y(rng), z(rng));
  return points;
}

TEST(MannequinSolid, IsSymmetric) {
  for (const Vector3d& p : PointsAround()) {
    EXPECT_EQ(MannequinDistance(p), MannequinDistance({-p.x(), p.y(), p.z()}));
  }
}

// What the polygoniser relies on to skip empty space, against the distance to
// the finished mesh, which is 3 mm off at most.
TEST(MannequinSolid, IsAtMostTwiceTheDistance) {
  const SurfaceIndex surface(Mannequin().data().v_template,
                             Mannequin().faces());
  for (const Vector3d& p : PointsAround()) {
    const double distance = (surface.Nearest(p).point - p).norm();
    EXPECT_LT(std::abs(MannequinDistance(p)), 2.0 * (distance + 0.003))
        << p.transpose();
  }
}

TEST(MannequinSolid, IsWhereABodyIs) {
  EXPECT_LT(MannequinDistance({0, .1, 0}), 0);         // chest
  EXPECT_LT(MannequinDistance({0, .5, .02}), 0);       // head
  EXPECT_LT(MannequinDistance({-.5, .25, -.01}), 0);   // right forearm
  EXPECT_LT(MannequinDistance({.11, -.6, 0}), 0);      // left knee
  EXPECT_LT(MannequinDistance({.135, -1.08, .1}), 0);  // left toes
  EXPECT_GT(MannequinDistance({0, -.42, 0}), 0);       // between the thighs
  EXPECT_GT(MannequinDistance({.25, .1, 0}), 0);       // under the arm
  EXPECT_GT(MannequinDistance({0, .63, 0}), 0);        // above the head
}

}  // namespace
}  // namespace invsim
