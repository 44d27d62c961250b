// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/garment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

#include "geometry/shapes.h"
#include "invsim/base/error.h"
#include "invsim/io/obj.h"

namespace invsim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// A vertical sheet of 1 m, facing +z, with its pattern.
Garment UnitSheet(int n) {
  const TriangleMesh m = Grid(n);
  Garment g;
  g.placed = m.vertices;
  g.faces = m.faces;
  g.rest = m.vertices.topRows<2>();
  g.rest_faces = m.faces;
  return g;
}

TEST(Garment, LaidFlatFacesKeepTheirSidesAndFaceUp) {
  const TriangleMesh m = Sphere(2);
  const Garment g = GarmentFromRestMesh(m.vertices, m.faces);
  EXPECT_TRUE(g.rest_angles_from_placed);
  ValidateGarment(g, "sphere");
  for (int f = 0; f < g.num_faces(); ++f) {
    for (int c = 0; c < 3; ++c) {
      const int d = (c + 1) % 3;
      EXPECT_NEAR(
          (g.rest.col(g.rest_faces(c, f)) - g.rest.col(g.rest_faces(d, f)))
              .norm(),
          (g.placed.col(g.faces(c, f)) - g.placed.col(g.faces(d, f))).norm(),
          1e-15);
    }
  }
}

// On a vertical sheet turned about the vertical, height is pattern +y.
TEST(Garment, VerticalIsTheWarp) {
  TriangleMesh m = Grid(2);
  const double c = std::cos(0.7), s = std::sin(0.7);
  for (int i = 0; i < m.vertices.cols(); ++i) {
    const double x = m.vertices(0, i);
    m.vertices(0, i) = c * x;
    m.vertices(2, i) = -s * x;
  }
  const Garment g = GarmentFromRestMesh(m.vertices, m.faces);
  for (int f = 0; f < g.num_faces(); ++f) {
    for (int k = 1; k < 3; ++k) {
      const double rise =
          g.placed(1, g.faces(k, f)) - g.placed(1, g.faces(0, f));
      const Vector2d p =
          g.rest.col(g.rest_faces(k, f)) - g.rest.col(g.rest_faces(0, f));
      EXPECT_NEAR(p[1], rise, 1e-15);
    }
  }
}

TEST(Garment, HorizontalFacesAreLaidFlatToo) {
  TriangleMesh m = Grid(2);
  m.vertices.row(2).swap(m.vertices.row(1));  // in the plane y = 0
  ValidateGarment(GarmentFromRestMesh(m.vertices, m.faces), "table");
}

TEST(Garment, VertexAreasAddToThePattern) {
  Garment g = UnitSheet(4);
  g.placed *= 1.5;  // stretched: the pattern counts
  const VectorXd areas = VertexAreas(g);
  EXPECT_NEAR(areas.sum(), 1.0, 1e-14);
  EXPECT_GT(areas.minCoeff(), 0.0);
  EXPECT_NEAR(areas[12], 1.0 / 16, 1e-15);
}

TEST(Garment, ReadsWithAndWithoutPattern) {
  const std::string path =
      (std::filesystem::temp_directory_path() / "invsim_garment_test.obj")
          .string();
  Garment g = UnitSheet(3);
  g.rest.array() *= 0.9;
  WriteObj(path, {g.placed, g.faces, g.rest, g.rest_faces});
  const Garment with = ReadGarment(path);
  EXPECT_EQ(with.rest, g.rest);
  EXPECT_EQ(with.placed, g.placed);
  EXPECT_FALSE(with.rest_angles_from_placed);
  WriteObj(path, {g.placed, g.faces, {}, {}});
  const Garment without = ReadGarment(path);
  EXPECT_TRUE(without.rest_angles_from_placed);
  EXPECT_NEAR(VertexAreas(without).sum(), 1.0, 1e-14);
  // Bad meshes name the file and the part.
  std::swap(g.faces(0, 4), g.faces(1, 4));
  WriteObj(path, {g.placed, g.faces, {}, {}});
  EXPECT_THAT([&] { ReadGarment(path); },
              ThrowsMessage<InputError>(
                  AllOf(HasSubstr(path), HasSubstr("the same way"))));
  std::filesystem::remove(path);
}

class BadGarment : public ::testing::Test {
 protected:
  void ExpectError(const std::string& text) {
    EXPECT_THAT([&] { ValidateGarment(g_, "shirt.obj"); },
                ThrowsMessage<InputError>(AllOf(
                    ::testing::StartsWith("shirt.obj: "), HasSubstr(text))));
  }
  Garment g_ = UnitSheet(2);
};

TEST_F(BadGarment, Centimetres) {
  g_.placed *= 70.0;
  g_.rest *= 70.0;
  ExpectError("garment is 70 m across, expected 0.02 to 5 m (centimetres?");
}
TEST_F(BadGarment, Millimetres) {
  g_.placed *= 700.0;
  ExpectError("(millimetres? multiply by 0.001)");
}
TEST_F(BadGarment, TooSmall) {
  g_.placed *= 0.001;
  ExpectError("garment is 0.001 m across");
}
TEST_F(BadGarment, PatternInCentimetres) {
  g_.rest *= 100.0;
  ExpectError("typically 0.01 times as long as in the pattern");
}
TEST_F(BadGarment, InvertedPatternTriangle) {
  std::swap(g_.rest_faces(0, 3), g_.rest_faces(1, 3));
  ExpectError("face 3 is inverted in the pattern (1 of 8 are)");
}
TEST_F(BadGarment, PatternTriangleWithoutArea) {
  g_.rest_faces(1, 5) = g_.rest_faces(0, 5);
  ExpectError("face 5 has no area in the pattern");
}
TEST_F(BadGarment, PatternPointsMissing) {
  g_.rest = g_.rest.leftCols(8).eval();
  ExpectError("refers to pattern point 8, expected 0 to 7");
}
TEST_F(BadGarment, PatternTrianglesMissing) {
  g_.rest_faces = g_.rest_faces.leftCols(7).eval();
  ExpectError("7 pattern triangles, expected one for each of 8 faces");
}
TEST_F(BadGarment, PatternNotFinite) {
  g_.rest(0, 3) = std::numeric_limits<double>::infinity();
  ExpectError("pattern point 3 is not finite");
}
TEST_F(BadGarment, MeshProblemsAreFoundToo) {
  g_.placed.col(4) = g_.placed.col(0);
  ExpectError("has no area");
}

}  // namespace
}  // namespace invsim
