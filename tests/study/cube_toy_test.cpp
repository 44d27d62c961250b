// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/cube_toy.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "invsim/geometry/mesh.h"

namespace invsim {
namespace {

constexpr double kDegree = M_PI / 180;

SceneOptions Scene() {
  SceneOptions scene;
  scene.step.substeps = 2;
  scene.step.friction.tolerance = 1e-10;
  return scene;
}

TEST(CubeToy, BodyIsAClosedCube) {
  const BodyModel cube = CubeBody();
  const Points vertices = cube.Vertices({});
  EXPECT_NEAR(FaceAreas(vertices, cube.faces()).sum(), 6 * 0.3 * 0.3, 1e-12);
  double volume = 0;
  for (int f = 0; f < cube.faces().cols(); ++f) {
    const Vector3d a = vertices.col(cube.faces()(0, f));
    const Vector3d b = vertices.col(cube.faces()(1, f));
    const Vector3d c = vertices.col(cube.faces()(2, f));
    volume += a.dot(b.cross(c)) / 6;
  }
  EXPECT_NEAR(volume, 0.3 * 0.3 * 0.3, 1e-12);
}

// Of the whole fall, about two tilts. Steps small enough that contacts stay.
TEST(CubeToy, SlopeOfTheLossMatchesDifferences) {
  CubeToy toy(Scene(), 8, 20);
  for (const double tilt : {-3 * kDegree, 6 * kDegree}) {
    const CubeToy::Loss at = toy.Evaluate(tilt);
    double best = 1;
    for (const double h : {1e-5, 1e-6, 1e-7}) {
      const double difference =
          (toy.Evaluate(tilt + h).value - toy.Evaluate(tilt - h).value) /
          (2 * h);
      best = std::min(best,
                      std::abs(at.slope - difference) / std::abs(difference));
    }
    EXPECT_LT(best, 1e-5) << tilt;
  }
}

TEST(CubeToy, DescentFindsTheTilt) {
  CubeToy toy(Scene(), 8, 20);
  double tilt = 6 * kDegree, step = 4;
  CubeToy::Loss at = toy.Evaluate(tilt);
  const double first = at.value;
  for (int k = 0; k < 60 && std::abs(tilt) > 0.05 * kDegree; ++k) {
    const double next = tilt - step * at.slope;
    const CubeToy::Loss there = toy.Evaluate(next);
    if (there.value < at.value) {
      tilt = next;
      at = there;
      step *= 1.5;
    } else {
      step *= 0.5;
    }
  }
  EXPECT_LT(std::abs(tilt), 0.1 * kDegree);
  EXPECT_LT(at.value, 1e-3 * first);
}

}  // namespace
}  // namespace invsim
