// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/section_tube.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/shapes.h"
#include "invsim/base/error.h"
#include "invsim/base/random.h"

namespace invsim {
namespace {

// Spheres of radius 1 at the origin and below it.
class SectionTubeTest : public ::testing::Test {
 protected:
  SectionTube Make(double top, double bottom) {
    return SectionTube(sphere_.vertices,
                       sphere_.faces,
                       std::vector<char>(sphere_.faces.cols(), 1),
                       Vector3d(0, top, 0),
                       Vector3d(0, bottom, 0),
                       0.02);
  }
  TriangleMesh sphere_ = Sphere(4);
};

TEST_F(SectionTubeTest, FollowsAConvexBody) {
  const SectionTube tube = Make(0.9, -0.9);
  Random random(1);
  for (int k = 0; k < 200; ++k) {
    const double angle = random.Uniform(0, 6.3),
                 y = random.Uniform(-0.85, 0.85);
    const double r = std::sqrt(1 - y * y);
    const Vector3d on(r * std::cos(angle), y, r * std::sin(angle));
    EXPECT_NEAR(tube.Value(on), 0.0, 0.01);
    // The value is the distance in the plane of the section.
    const Vector3d off = on + 0.3 * Vector3d(on[0], 0, on[2]).normalized();
    EXPECT_NEAR(tube.Value(off), 0.3, 0.01);
  }
}

TEST_F(SectionTubeTest, HangsFromTheWidestSection) {
  SectionTube tube = Make(0.9, -2.0);
  tube.Hang(0.1, 9.0);
  EXPECT_NEAR(tube.Value(Vector3d(1, 0, 0)), 0.0, 0.01);
  EXPECT_NEAR(tube.Value(Vector3d(0.95, -0.5, 0)), 0.0, 0.01);
  EXPECT_NEAR(tube.Value(Vector3d(0, -1.5, 0.85)), 0.0, 0.01);
  // On beyond its end as at the end.
  EXPECT_NEAR(tube.Value(Vector3d(0, -9.0, 0.80)), 0.0, 0.015);
}

TEST_F(SectionTubeTest, WidensInTime) {
  SectionTube tube = Make(2.0, -0.9);
  tube.Hang(9.0, 0.1);
  EXPECT_NEAR(tube.Value(Vector3d(0.85, 1.5, 0)), 0.0, 0.01);
  EXPECT_NEAR(tube.Value(Vector3d(0, 0, 1)), 0.0, 0.01);
  const double below = std::sqrt(1 - 0.8 * 0.8);
  EXPECT_NEAR(tube.Value(Vector3d(below, -0.8, 0)), 0.0, 0.02);
}

TEST_F(SectionTubeTest, FlaresLikeASkirt) {
  SectionTube tube = Make(0.9, -2.0);
  tube.Flare(0.9, 0.5);
  EXPECT_NEAR(tube.Value(Vector3d(1.5, -1, 0)), 0.0, 0.02);
  EXPECT_NEAR(tube.Value(Vector3d(0, -1.8, 1.9)), 0.0, 0.02);
}

TEST_F(SectionTubeTest, EndsAtItsStart) {
  const SectionTube tube = Make(0.5, -0.5);
  EXPECT_NEAR(tube.Value(Vector3d(0, 0.7, 0)), 0.2, 1e-12);
  EXPECT_LT(tube.Value(Vector3d(0, -0.7, 0)), 0.0);
}

// Two legs: the section is the hull of both.
TEST_F(SectionTubeTest, SpansHollows) {
  const auto n = sphere_.vertices.cols(), f = sphere_.faces.cols();
  TriangleMesh two;
  two.vertices.resize(3, 2 * n);
  two.vertices << sphere_.vertices,
      sphere_.vertices.colwise() + Vector3d(3, 0, 0);
  two.faces.resize(3, 2 * f);
  two.faces << sphere_.faces, sphere_.faces.array() + static_cast<int>(n);
  const SectionTube tube(two.vertices,
                         two.faces,
                         std::vector<char>(2 * f, 1),
                         Vector3d(1.5, 0.5, 0),
                         Vector3d(1.5, -0.5, 0),
                         0.02);
  EXPECT_NEAR(tube.Value(Vector3d(1.5, 0, 1.0)), 0.0, 0.01);
  EXPECT_NEAR(tube.Value(Vector3d(1.5, 0, 1.2)), 0.2, 0.01);
}

TEST_F(SectionTubeTest, NothingAcrossTheAxisIsAnError) {
  EXPECT_THROW(Make(5.0, 4.0), InputError);
}

}  // namespace
}  // namespace invsim
