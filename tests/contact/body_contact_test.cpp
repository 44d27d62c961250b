// SPDX-License-Identifier: Apache-2.0
#include "invsim/contact/body_contact.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "geometry/shapes.h"

namespace invsim {
namespace {

constexpr double kDt = 0.005;
constexpr double kResistance = 0.02;  // N s/m

struct Found {
  std::vector<Contact> contacts;
  std::vector<BodyContact> sources;
};

class BodyContactTest : public testing::Test {
 protected:
  Found Detect(const TriangleMesh& body,
               const Points& body1,
               const Points& x,
               const Points& v) {
    BodyContactDetector detector(body.vertices, body.faces);
    detector.FindInside(body.vertices, x);
    Found found;
    detector.Detect(options_,
                    kDt,
                    body.vertices,
                    body1,
                    x,
                    v,
                    VectorXd::Constant(x.cols(), kResistance),
                    &found.contacts,
                    &found.sources);
    return found;
  }
  Found DetectAtRest(const TriangleMesh& body, const Vector3d& x) {
    return Detect(body, body.vertices, x, Points::Zero(3, 1));
  }
  BodyContactOptions options_;
};

// Two balls that overlap or nearly touch along x, as one surface.
TriangleMesh TwoBalls(double distance) {
  const TriangleMesh ball = Sphere(3);
  const int n = static_cast<int>(ball.vertices.cols());
  const int f = static_cast<int>(ball.faces.cols());
  TriangleMesh both;
  both.vertices.resize(3, 2 * n);
  both.vertices << 0.1 * ball.vertices, 0.1 * ball.vertices;
  both.vertices.rightCols(n).row(0).array() += distance;
  both.faces.resize(3, 2 * f);
  both.faces << ball.faces, ball.faces.array() + n;
  return both;
}

TEST_F(BodyContactTest, OneContactOnAConvexSurface) {
  TriangleMesh ball = Sphere(3);
  ball.vertices *= 0.1;
  const Vector3d direction = Vector3d(0.3, 0.8, -0.4).normalized();
  const Found found = DetectAtRest(ball, 0.1025 * direction);
  ASSERT_EQ(found.contacts.size(), 1u);
  EXPECT_GT(found.contacts[0].normal.dot(direction), 0.98);
  EXPECT_TRUE(found.contacts[0].exact());
  EXPECT_EQ(found.sources[0].side, 1);
}

TEST_F(BodyContactTest, NothingOutOfReach) {
  TriangleMesh ball = Sphere(3);
  ball.vertices *= 0.1;
  EXPECT_TRUE(DetectAtRest(ball, {0.12, 0, 0}).contacts.empty());
}

TEST_F(BodyContactTest, AFastVertexFindsWhatItWouldPass) {
  TriangleMesh ball = Sphere(3);
  ball.vertices *= 0.1;
  Points x(3, 1), v(3, 1);
  x.col(0) << 0, 0.12, 0;
  v.col(0) << 0, -5, 0;
  EXPECT_EQ(Detect(ball, ball.vertices, x, v).contacts.size(), 1u);
  // The same relative motion with the body moving.
  v.setZero();
  const Points moved = ball.vertices.colwise() + Vector3d(0, 5 * kDt, 0);
  const Found found = Detect(ball, moved, x, v);
  ASSERT_EQ(found.contacts.size(), 1u);
  EXPECT_GT(found.contacts[0].velocity.y(), 1);
}

TEST_F(BodyContactTest, TwoContactsBetweenTwoBodies) {
  const TriangleMesh balls = TwoBalls(0.205);
  const Found found = DetectAtRest(balls, {0.1025, 0, 0});
  ASSERT_EQ(found.contacts.size(), 2u);
  EXPECT_LT(found.contacts[0].normal.dot(found.contacts[1].normal), -0.98);
  for (const Contact& c : found.contacts)
    EXPECT_DOUBLE_EQ(c.compliance * kResistance, options_.shared_compliance);
}

// A block with a notch of 44 degrees along z, whose bottom is the z axis.
TriangleMesh NotchedBlock() {
  const Eigen::Matrix<double, 2, 7> outline{
      {-0.1, 0.1, 0.1, 0.02, 0, -0.02, -0.1},
      {-0.1, -0.1, 0.05, 0.05, 0, 0.05, 0.05}};
  const int caps[5][3] = {
      {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {4, 5, 6}, {4, 6, 0}};
  TriangleMesh block;
  block.vertices.resize(3, 14);
  block.vertices.topRows<2>() << outline, outline;
  block.vertices.row(2) << Eigen::RowVectorXd::Constant(7, -0.1),
      Eigen::RowVectorXd::Constant(7, 0.1);
  block.faces.resize(3, 24);
  int f = 0;
  for (int i = 0; i < 7; ++i) {
    const int j = (i + 1) % 7;
    block.faces.col(f++) << i, j, j + 7;
    block.faces.col(f++) << i, j + 7, i + 7;
  }
  for (const auto& c : caps) {
    block.faces.col(f++) << c[0], c[2], c[1];
    block.faces.col(f++) << c[0] + 7, c[1] + 7, c[2] + 7;
  }
  return block;
}

// As in the crease of an armpit: walls that share an edge are two obstacles.
TEST_F(BodyContactTest, BothWallsOfACreaseHold) {
  const Found found = DetectAtRest(NotchedBlock(), {0.0005, 0.011, 0.003});
  ASSERT_EQ(found.contacts.size(), 2u);
  EXPECT_LT(found.contacts[0].normal[0] * found.contacts[1].normal[0], 0);
  for (const BodyContact& source : found.sources) {
    EXPECT_EQ(source.side, 1);
    EXPECT_EQ(source.feature, TriangleFeature::kFace);
  }
}

TEST_F(BodyContactTest, SqueezedBetweenOverlappingBodiesBothPushBack) {
  const TriangleMesh balls = TwoBalls(0.19);
  const Found found = DetectAtRest(balls, {0.095, 0, 0});
  ASSERT_EQ(found.contacts.size(), 2u);
  EXPECT_LT(found.contacts[0].normal.dot(found.contacts[1].normal), -0.95);
  for (const BodyContact& s : found.sources) EXPECT_EQ(s.side, -1);
}

TEST_F(BodyContactTest, InsideIsLedOutThroughTheNearestPoint) {
  TriangleMesh ball = Sphere(3);
  ball.vertices *= 0.1;
  const Vector3d direction = Vector3d(0.3, 0.8, -0.4).normalized();
  const Found found = DetectAtRest(ball, 0.07 * direction);
  ASSERT_EQ(found.contacts.size(), 1u);
  EXPECT_EQ(found.sources[0].side, -1);
  EXPECT_GT(found.contacts[0].normal.dot(direction), 0.98);
  EXPECT_NEAR(found.contacts[0].velocity.norm(), options_.recovery_speed, 1e-9);
}

// As cloth between arm and trunk: 2 mm off the one, and deep in the other.
TEST_F(BodyContactTest, InsideIsLedOutThoughAnotherPartIsNearer) {
  const Found found = DetectAtRest(TwoBalls(0.19), {0.088, 0, 0});
  ASSERT_EQ(found.contacts.size(), 2u);
  for (size_t k = 0; k < 2; ++k)
    EXPECT_GT(found.sources[k].side * -found.contacts[k].normal.x(), 0.9);
}

TEST_F(BodyContactTest, TheFarSideOfAThinPartIsNoObstacle) {
  TriangleMesh finger = Sphere(3);
  finger.vertices *= 0.004;  // thinner than the reach of the search
  const Found found = DetectAtRest(finger, {0.0055, 0, 0});
  ASSERT_EQ(found.contacts.size(), 1u);
  EXPECT_GT(found.contacts[0].normal.x(), 0.9);
}

// A vertex that lies on one wall of a trough, 8 mm from the bottom, in a step
// in which it moves with v1.
class SlippedTest : public BodyContactTest {
 protected:
  SlippedTest() : detector_(trough_.vertices, trough_.faces) {
    x_.col(0) = 0.008 * kOut + options_.thickness * kNormal;
    detector_.Detect(options_,
                     kDt,
                     trough_.vertices,
                     trough_.vertices,
                     x_,
                     -4 * kOut,
                     resistance_,
                     &found_.contacts,
                     &found_.sources);
  }
  int FindSlipped(const Points& v1) {
    return detector_.FindSlipped(options_,
                                 kDt,
                                 trough_.vertices,
                                 trough_.vertices,
                                 x_,
                                 v1,
                                 resistance_,
                                 &found_.contacts,
                                 &found_.sources);
  }
  // Of the wall at x < 0: up along it from the bottom, and away from it.
  inline static const Vector3d kOut = Vector3d(-1, 0.3, 0).normalized();
  inline static const Vector3d kNormal = Vector3d(0.3, 1, 0).normalized();
  const TriangleMesh trough_ = Trough(0.2, 0.06);
  const VectorXd resistance_ = VectorXd::Constant(1, kResistance);
  BodyContactDetector detector_;
  Points x_{3, 1};
  Found found_;
};

// At the start the wall ahead has no place that is a minimum of the distance.
TEST_F(SlippedTest, WhatSlidesPastItsFaceMeetsTheNext) {
  ASSERT_EQ(found_.contacts.size(), 1u);
  EXPECT_TRUE(found_.contacts[0].exact());
  const Vector3d v1 = -4 * kOut;
  EXPECT_EQ(FindSlipped(v1), 1);
  ASSERT_EQ(found_.contacts.size(), 2u);
  ASSERT_EQ(found_.sources.size(), 2u);
  EXPECT_EQ(found_.sources[1].contact, 1);
  EXPECT_EQ(found_.sources[1].vertex, 0);
  const Contact& wall = found_.contacts[1];
  const Vector3d normal(-kNormal.x(), kNormal.y(), 0);
  EXPECT_LT((wall.normal - normal).norm(), 1e-12);
  // The plane of the wall, thickness above it, where the vertex would end.
  EXPECT_NEAR(kDt * wall.normal.dot(v1 - wall.velocity),
              normal.dot(x_.col(0) + kDt * v1) - options_.thickness,
              1e-12);
  for (const Contact& c : found_.contacts)
    EXPECT_DOUBLE_EQ(c.compliance * kResistance, options_.shared_compliance);
}

TEST_F(SlippedTest, WhatStaysOnItsFaceOrOutsideDoesNot) {
  EXPECT_EQ(FindSlipped(-1 * kOut), 0);
  EXPECT_EQ(FindSlipped(4 * kOut), 0);
  EXPECT_EQ(FindSlipped(Vector3d(4, 1.5, 0)), 0);
  EXPECT_TRUE(found_.contacts[0].exact());
}

// The solution is to blame, not a missing contact.
TEST_F(SlippedTest, NorDoesWhatIsPressedThroughItsPlane) {
  EXPECT_EQ(FindSlipped(-4 * kOut - 2 * kNormal), 0);
  EXPECT_EQ(found_.contacts.size(), 1u);
}

TEST_F(BodyContactTest, FindInsideCounts) {
  TriangleMesh ball = Sphere(3);
  ball.vertices *= 0.1;
  BodyContactDetector detector(ball.vertices, ball.faces);
  Points x(3, 3);
  x << 0, 0.2, 0.05, 0, 0, 0, 0.01, 0, 0;
  EXPECT_EQ(detector.FindInside(ball.vertices, x), 2);
}

}  // namespace
}  // namespace invsim
