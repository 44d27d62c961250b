// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/carry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cloth/capsule_body.h"
#include "geometry/shapes.h"
#include "invsim/base/error.h"
#include "invsim/cloth/authored_garment.h"
#include "invsim/cloth/clearance.h"
#include "invsim/geometry/self_intersection.h"

namespace invsim {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(Carry, RigidMotionIsFollowedExactly) {
  const TriangleMesh body = Sphere(3);
  const Vector3d step(0.1, -0.2, 0.05);
  const Points cloth = 1.1 * Sphere(2).vertices;
  const Points moves = CarryDisplacement(
      cloth, body.vertices, body.vertices.colwise() + step, body.faces);
  EXPECT_LT((moves.colwise() - step).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(Carry, FollowsTheSkinNearIt) {
  // A finely meshed body that widens in the middle.
  const TriangleMesh body = Sphere(5);
  Points wider = body.vertices;
  for (int v = 0; v < wider.cols(); ++v)
    wider.col(v) *= 1.0 + 0.2 * (1.0 - wider(1, v) * wider(1, v));
  const Points cloth = 1.01 * Sphere(2).vertices;
  const Points moves =
      CarryDisplacement(cloth, body.vertices, wider, body.faces);
  for (int v = 0; v < cloth.cols(); ++v) {
    const Vector3d n = cloth.col(v).normalized();
    const Vector3d skin = 0.2 * (1.0 - n[1] * n[1]) * n;
    EXPECT_LT((moves.col(v) - skin).norm(), 0.012);
  }
}

// A shirt goes to a fatter, taller, thinner and smaller wearer.
TEST(Carry, GarmentLiesRoundAnotherBody) {
  const TPoseBody body = CapsuleBody();
  AuthoredGarmentOptions options;
  options.edge_length = 0.035;
  const Garment shirt = AuthoredGarment("tshirt", body, options);
  const Points normals = VertexNormals(body.vertices, body.faces);
  const Points fatter = body.vertices + 0.03 * normals;
  const Points thinner = body.vertices - 0.01 * normals;
  const Points taller = 1.12 * body.vertices, smaller = 0.85 * body.vertices;
  for (const Points& to : {fatter, thinner, taller, smaller}) {
    const Garment g =
        CarryGarment(shirt, body.vertices, to, body.faces, "tshirt");
    EXPECT_EQ(g.rest, shirt.rest);
    EXPECT_EQ(g.rest_faces, shirt.rest_faces);
    EXPECT_EQ(g.faces, shirt.faces);
    const Clearance c =
        MeasureClearance(g.placed, g.faces, SurfaceIndex(to, body.faces));
    EXPECT_GE(c.vertices, 0.002);
    EXPECT_GE(c.faces, 0.002 * 2 / 3);
    EXPECT_TRUE(SelfIntersections(g.placed, g.faces).empty());
  }
}

TEST(Carry, SameBodySameGarment) {
  const TPoseBody body = CapsuleBody();
  AuthoredGarmentOptions options;
  options.edge_length = 0.05;
  const Garment g = AuthoredGarment("tank_top", body, options);
  const Garment same =
      CarryGarment(g, body.vertices, body.vertices, body.faces, "tank top");
  EXPECT_EQ(same.placed, g.placed);
}

TEST(Carry, BodiesThatDoNotMatchAreNamed) {
  const TriangleMesh body = Sphere(1);
  const Garment g = GarmentFromRestMesh(1.5 * body.vertices, body.faces);
  EXPECT_THAT(
      [&] {
        CarryGarment(g, body.vertices, Sphere(2).vertices, body.faces, "g.obj");
      },
      ThrowsMessage<InputError>(
          HasSubstr("g.obj: carried from a body of 18 vertices to one of 66")));
  EXPECT_THROW(
      CarryGarment(g, body.vertices, body.vertices, Sphere(2).faces, "g"),
      InputError);
}

}  // namespace
}  // namespace invsim
