// SPDX-License-Identifier: Apache-2.0
#include "../../src/cloth/sewing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/shapes.h"
#include "invsim/base/error.h"
#include "invsim/cloth/clearance.h"
#include "invsim/geometry/self_intersection.h"
#include "invsim/geometry/topology.h"

namespace invsim {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double kSkinRadius = 0.1, kClothRadius = 0.115;  // m
constexpr double kHem = 0.05, kSewnEdge = 0.025;           // m

// A round belly, and the ball about it that a garment is cut from.
class SewingTest : public ::testing::Test {
 protected:
  SewingTest() { Sew(BallAt(Vector3d::Zero())); }

  static Field BallAt(const Vector3d& centre) {
    return [centre](const Vector3d& x) {
      return (x - centre).norm() - kClothRadius;
    };
  }
  // A ring round the y-axis, its middle on the circle of the skin's radius.
  static double Ring(const Vector3d& x) {
    return std::hypot(std::hypot(x[0], x[2]) - kSkinRadius, x[1]) - 0.03;
  }
  static double AboveHem(const Vector3d& x) { return x[1] + kHem; }
  static double BelowTop(const Vector3d& x) { return kHem - x[1]; }

  void Sew(const Field& solid) {
    const Vector3d corner = Vector3d::Constant(0.14);
    solid_ = ScalarGrid(-corner, corner + Vector3d(0.3, 0, 0), 0.01);
    solid_.Fill(solid, 0.03);
  }
  TriangleMesh Make(const std::vector<Field>& cuts, int openings) const {
    return SewGarment({"belt",
                       solid_,
                       cuts,
                       Vector3d::Zero(),
                       SurfaceIndex(skin_.vertices, skin_.faces),
                       openings,
                       kSewnEdge,
                       0.01});
  }
  void ExpectRefused(const std::vector<Field>& cuts,
                     int openings,
                     const std::string& why) const {
    EXPECT_THAT([&] { Make(cuts, openings); },
                ThrowsMessage<InputError>(
                    HasSubstr("cannot make a belt for this body: " + why)));
  }

  TriangleMesh skin_ = [] {
    TriangleMesh ball = Sphere(3);
    ball.vertices *= kSkinRadius;
    return ball;
  }();
  ScalarGrid solid_{Vector3d::Zero(), Vector3d::Ones(), 1.0};
};

// The cuts are straight and the ball is round, though made of few triangles.
TEST_F(SewingTest, ABeltIsThePartOfTheBallBetweenTheCuts) {
  const TriangleMesh belt = Make({AboveHem, BelowTop}, 2);
  EXPECT_EQ(EulerCharacteristic(belt.faces), 0);
  for (int v = 0; v < belt.vertices.cols(); ++v)
    EXPECT_NEAR(belt.vertices.col(v).norm(), kClothRadius, 5e-4);
  const std::vector<std::vector<int>> rims = BoundaryLoops(belt.faces);
  ASSERT_EQ(rims.size(), 2u);
  for (const std::vector<int>& rim : rims) {
    EXPECT_GT(rim.size(), 20u);
    const double side = belt.vertices(1, rim[0]) > 0 ? 1 : -1;
    for (const int v : rim) EXPECT_NEAR(side * belt.vertices(1, v), kHem, 2e-3);
  }
  double length = 0;
  const std::vector<Edge> edges = Edges(belt.faces);
  for (const Edge& e : edges)
    length += (belt.vertices.col(e.a) - belt.vertices.col(e.b)).norm();
  EXPECT_NEAR(length / edges.size(), kSewnEdge, 0.1 * kSewnEdge);
  // Outwards, as a garment is worn.
  EXPECT_GT(VertexNormals(belt.vertices, belt.faces)
                .cwiseProduct(belt.vertices)
                .sum(),
            0);
}

// A hem that runs up and down by 5 mm from vertex to vertex is none.
TEST_F(SewingTest, EvensOutItsOpenings) {
  const Field wavy = [](const Vector3d& x) {
    return AboveHem(x) + 0.005 * std::sin(9 * std::atan2(x[2], x[0]));
  };
  const TriangleMesh belt = Make({wavy, BelowTop}, 2);
  for (const std::vector<int>& rim : BoundaryLoops(belt.faces))
    for (const int v : rim)
      EXPECT_NEAR(std::abs(belt.vertices(1, v)), kHem, 1.5e-3);
}

// The cloth that the solid has on the skin is moved off it.
TEST_F(SewingTest, KeepsClearWhereTheSolidDoesNot) {
  Sew([](const Vector3d& x) { return x.norm() - kSkinRadius; });
  const TriangleMesh belt = Make({AboveHem, BelowTop}, 2);
  const Clearance c = MeasureClearance(
      belt.vertices, belt.faces, SurfaceIndex(skin_.vertices, skin_.faces));
  EXPECT_GE(c.vertices, 0.6 * 0.01);
  EXPECT_GE(c.faces, 0.5 * 0.01);
  EXPECT_TRUE(SelfIntersections(belt.vertices, belt.faces).empty());
}

TEST_F(SewingTest, KeepsThePieceAboutTheInside) {
  const Vector3d elsewhere(0.28, 0, 0);
  Sew([&](const Vector3d& x) {
    return std::min(BallAt(Vector3d::Zero())(x), BallAt(elsewhere)(x));
  });
  const TriangleMesh belt = Make({AboveHem, BelowTop}, 2);
  EXPECT_LT(belt.vertices.row(0).maxCoeff(), 0.5 * elsewhere[0]);
}

TEST_F(SewingTest, NothingLeftIsRefused) {
  ExpectRefused({[](const Vector3d& x) { return x[1] - 1; }},
                1,
                "nothing is left after the cuts");
}

TEST_F(SewingTest, AnotherNumberOfOpeningsIsRefused) {
  ExpectRefused({AboveHem}, 2, "1 openings, expected 2");
}

// A ring with a hole cut into its side has one opening, but is no bag.
TEST_F(SewingTest, AHandleIsRefused) {
  Sew(Ring);
  skin_.vertices *= 0.2;  // in the middle of the ring
  ExpectRefused({[](const Vector3d& x) { return 0.115 - x[0]; }},
                1,
                "its parts have grown together");
}

// Skin round the skin, 5 mm off: cloth between is no more than 2.5 mm from one.
TEST_F(SewingTest, TooLittleRoomIsRefused) {
  Sew([](const Vector3d& x) { return x.norm() - kSkinRadius - 0.0025; });
  const auto n = skin_.vertices.cols(), f = skin_.faces.cols();
  TriangleMesh two;
  two.vertices.resize(3, 2 * n);
  two.vertices << skin_.vertices, 1.05 * skin_.vertices;
  two.faces.resize(3, 2 * f);
  two.faces << skin_.faces,
      skin_.faces.colwise().reverse().array() + static_cast<int>(n);
  skin_ = two;
  ExpectRefused({AboveHem, BelowTop}, 2, "it comes within ");
}

}  // namespace
}  // namespace invsim
