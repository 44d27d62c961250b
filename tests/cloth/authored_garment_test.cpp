// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/authored_garment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "cloth/capsule_body.h"
#include "invsim/base/error.h"
#include "invsim/cloth/clearance.h"
#include "invsim/geometry/mesh.h"
#include "invsim/geometry/remesh.h"
#include "invsim/geometry/self_intersection.h"
#include "invsim/geometry/topology.h"

namespace invsim {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kEdgeLength = 0.03;

const TPoseBody& Body() {
  static const TPoseBody body = CapsuleBody();
  return body;
}

void ExpectMadeToFit(const std::string& name, const Garment& g) {
  ValidateGarment(g, name);
  EXPECT_FALSE(g.rest_angles_from_placed);
  const VectorXd placed = FaceAreas(g.placed, g.faces);
  EXPECT_NEAR(VertexAreas(g).sum(), placed.sum(), 1e-12);
}

void ExpectOneUncrossedPiece(const std::string& name, const Garment& g) {
  const size_t openings = name == "trousers" ? 3 : 4;
  EXPECT_EQ(BoundaryLoops(g.faces).size(), openings);
  EXPECT_EQ(EulerCharacteristic(g.faces), 2 - static_cast<int>(openings));
  const auto piece = VertexComponents(g.faces, g.num_vertices());
  EXPECT_EQ(*std::max_element(piece.begin(), piece.end()), 0);
  EXPECT_TRUE(SelfIntersections(g.placed, g.faces).empty());
}

void ExpectClearOfTheSkinAndOutward(const Garment& g) {
  const SurfaceIndex skin(Body().vertices, Body().faces);
  const Clearance c = MeasureClearance(g.placed, g.faces, skin);
  EXPECT_GE(c.vertices, 0.003);
  EXPECT_GE(c.faces, 0.002);
  // No part of the body pokes through between the samples either.
  const SurfaceIndex cloth(g.placed, g.faces);
  for (int v = 0; v < Body().vertices.cols(); ++v) {
    const auto near = cloth.NearestWithin(Body().vertices.col(v), 0.01);
    if (near && near->feature == TriangleFeature::kFace) {
      EXPECT_LT(near->signed_distance, -0.001);
    }
  }
}

void ExpectWellShapedTriangles(const Garment& g) {
  const VectorXd angles = SmallestAngles(g.placed, g.faces);
  EXPECT_GT(angles.minCoeff(), 18 * kDegree);
  EXPECT_GT(angles.mean(), 48 * kDegree);
  double sum = 0.0;
  const auto edges = Edges(g.faces);
  for (const Edge& e : edges)
    sum += (g.placed.col(e.a) - g.placed.col(e.b)).norm();
  EXPECT_NEAR(
      sum / static_cast<double>(edges.size()), kEdgeLength, 0.1 * kEdgeLength);
}

// Openings are where limbs, neck and trunk leave; the front is closed.
void ExpectOpenings(const std::string& name, const Garment& g) {
  const Vector3d right(-1, 0, 0), up(0, 1, 0), front(0, 0, 1);
  const SurfaceIndex cloth(g.placed, g.faces);
  const auto open = [&](const Vector3d& from, const Vector3d& to) {
    return !cloth.AnyHit(from, to, 3.0);
  };
  if (name == "trousers") {
    EXPECT_TRUE(open(Vector3d(0, -0.2, 0), up));
    for (int side = 0; side < 2; ++side) {
      const Vector3d hip = Body().joints.col(1 + side);
      EXPECT_TRUE(open(hip, Body().joints.col(7 + side) - hip));
    }
    EXPECT_FALSE(open(Vector3d(0, -0.2, 0), front));
    EXPECT_FALSE(open(Vector3d(0.12, -0.5, 0), front));
    return;
  }
  const Vector3d chest(0, 0.24, 0);
  EXPECT_TRUE(open(chest, up));
  EXPECT_TRUE(open(chest, -up));
  EXPECT_TRUE(open(chest, right));
  EXPECT_TRUE(open(chest, -right));
  EXPECT_FALSE(open(chest - 0.15 * up, front));
  EXPECT_FALSE(open(chest - 0.15 * up, -front));
  EXPECT_FALSE(open(chest - 0.3 * up, right));
}

void ExpectLengthOfItsName(const std::string& name, const Garment& g) {
  const double reach = g.placed.row(0).maxCoeff();
  const double lowest = g.placed.row(1).minCoeff();
  if (name == "long_sleeved_shirt") {
    EXPECT_GT(reach, 0.58);  // wrist at 0.65
  } else if (name == "tshirt") {
    EXPECT_GT(reach, 0.28);  // elbow at 0.42
    EXPECT_LT(reach, 0.40);
  } else if (name == "tank_top") {
    EXPECT_LT(reach, 0.25);
  } else if (name == "dress") {
    EXPECT_NEAR(lowest, -0.6, 0.02);  // knee
  } else {
    EXPECT_EQ(name, "trousers");
    EXPECT_LT(lowest, -0.95);  // ankle
  }
}

// One test, for a garment takes seconds to make and every test may run in a
// process of its own.
class AuthoredGarmentTest : public ::testing::TestWithParam<std::string> {};

TEST_P(AuthoredGarmentTest, IsSound) {
  AuthoredGarmentOptions options;
  options.edge_length = kEdgeLength;
  const Garment g = AuthoredGarment(GetParam(), Body(), options);
  ExpectMadeToFit(GetParam(), g);
  ExpectOneUncrossedPiece(GetParam(), g);
  ExpectClearOfTheSkinAndOutward(g);
  ExpectWellShapedTriangles(g);
  ExpectOpenings(GetParam(), g);
  ExpectLengthOfItsName(GetParam(), g);
}

// The largest triangles and the least and most ease, which leave the least
// room at crotch and armpits.
TEST_P(AuthoredGarmentTest, IsOneUncrossedPieceAtTheLimits) {
  for (const double ease : {0.004, 0.03}) {
    AuthoredGarmentOptions options;
    options.edge_length = 0.06;
    options.ease = ease;
    ExpectOneUncrossedPiece(GetParam(),
                            AuthoredGarment(GetParam(), Body(), options));
  }
}

INSTANTIATE_TEST_SUITE_P(All,
                         AuthoredGarmentTest,
                         ::testing::ValuesIn(AuthoredGarmentNames()));

TEST(AuthoredGarment, EaseIsKept) {
  AuthoredGarmentOptions options;
  options.edge_length = 0.05;
  const SurfaceIndex skin(Body().vertices, Body().faces);
  for (const double ease : {0.005, 0.03}) {
    options.ease = ease;
    const Garment g = AuthoredGarment("tank_top", Body(), options);
    EXPECT_GT(MeasureClearance(g.placed, g.faces, skin).vertices, 0.6 * ease);
  }
}

TEST(AuthoredGarment, RefusesWhatItCannotMake) {
  EXPECT_THAT([] { AuthoredGarment("tshrit", Body()); },
              ThrowsMessage<UsageError>(HasSubstr("tshirt")));
  AuthoredGarmentOptions options;
  options.edge_length = 0.5;
  EXPECT_THAT([&] { AuthoredGarment("tshirt", Body(), options); },
              ThrowsMessage<UsageError>(
                  HasSubstr("edge length is 0.5 m, expected 0.008 to 0.08")));
  TPoseBody lying = Body();
  lying.joints.row(1) *= -1.0;
  EXPECT_THROW(AuthoredGarment("tshirt", lying), InputError);
}

}  // namespace
}  // namespace invsim
