// SPDX-License-Identifier: Apache-2.0
#include "../../src/study/closed_faces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace invsim {
namespace {

constexpr double kPi = std::numbers::pi;

// Two triangles along the x axis, the second turned about it by `angle` from
// where it lies flat beside the first, which is `height` high.
TriangleMesh Fold(double angle, double height = 1) {
  TriangleMesh mesh;
  mesh.vertices.resize(3, 4);
  mesh.vertices << 0, 1, 0.5, 0.5,     //
      0, 0, height, -std::cos(angle),  //
      0, 0, 0, std::sin(angle);
  mesh.faces.resize(3, 2);
  mesh.faces << 0, 1,  //
      1, 0,            //
      2, 3;
  return mesh;
}

int Count(const std::vector<TriangleMesh>& steps) {
  const TriangleMesh flat = Fold(0);
  ClosedFaces closed(GarmentFromRestMesh(flat.vertices, flat.faces));
  for (const TriangleMesh& mesh : steps) closed.Add(mesh.vertices);
  return closed.count();
}

TEST(ClosedFaces, AnAnglePastPiIsCounted) {
  EXPECT_EQ(Count({Fold(kPi - 0.1), Fold(kPi + 0.1)}), 1);
  EXPECT_EQ(Count({Fold(0.1 - kPi), Fold(-0.1 - kPi), Fold(0.1 - kPi)}), 2);
}

TEST(ClosedFaces, FoldingBackAndForthIsNot) {
  EXPECT_EQ(Count({Fold(0), Fold(3.1), Fold(0.2), Fold(-1.5), Fold(1.5)}), 0);
}

TEST(ClosedFaces, AFaceCloseToALineIsCountedAtEachStep) {
  EXPECT_EQ(Count({Fold(0.3, 0.02), Fold(0.3, 0.5)}), 0);
  EXPECT_EQ(Count({Fold(0.3, 0.009), Fold(0.3, 1e-5), Fold(0.3, 0.5)}), 2);
}

}  // namespace
}  // namespace invsim
