// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/surface_index.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "geometry/shapes.h"
#include "invsim/base/error.h"
#include "invsim/base/threads.h"

namespace invsim {
namespace {

// A sphere with bumps and dents, so that every kind of feature comes closest.
TriangleMesh BumpySphere(int levels) {
  TriangleMesh m = Sphere(levels);
  for (int i = 0; i < m.vertices.cols(); ++i) {
    const Vector3d p = m.vertices.col(i);
    m.vertices.col(i) *= 1.0 + 0.3 * std::sin(5 * p[0]) * std::cos(4 * p[1]);
  }
  return m;
}

Points RandomPoints(int n, double size, int seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-size, size);
  return Points::NullaryExpr(3, n, [&] { return unit(random); });
}

ClosestPoint OnFace(const TriangleMesh& m, const Vector3d& q, int f) {
  return ClosestPointOnTriangle(q,
                                m.vertices.col(m.faces(0, f)),
                                m.vertices.col(m.faces(1, f)),
                                m.vertices.col(m.faces(2, f)));
}

// The solid angle of the surface seen from q, over 4 pi: 1 inside, 0 outside
// (van Oosterom & Strackee 1983). Independent of normals and rays.
double WindingNumber(const TriangleMesh& m, const Vector3d& q) {
  double sum = 0.0;
  for (int f = 0; f < m.faces.cols(); ++f) {
    const Vector3d a = m.vertices.col(m.faces(0, f)) - q;
    const Vector3d b = m.vertices.col(m.faces(1, f)) - q;
    const Vector3d c = m.vertices.col(m.faces(2, f)) - q;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2.0 * std::atan2(a.dot(b.cross(c)),
                            la * lb * lc + a.dot(b) * lc + b.dot(c) * la +
                                c.dot(a) * lb);
  }
  return sum / (4.0 * std::numbers::pi);
}

void ExpectNearestIsBruteForce(const SurfaceIndex& index,
                               const TriangleMesh& m,
                               const Points& queries) {
  const std::vector<SurfacePoint> found = index.NearestAll(queries);
  for (int i = 0; i < queries.cols(); ++i) {
    const Vector3d q = queries.col(i);
    int face = 0;
    ClosestPoint best = OnFace(m, q, 0);
    for (int f = 1; f < m.faces.cols(); ++f) {
      const ClosestPoint p = OnFace(m, q, f);
      if (p.squared_distance < best.squared_distance) best = p, face = f;
    }
    ASSERT_EQ(found[i].face, face);
    EXPECT_EQ(found[i].feature, best.feature);
    EXPECT_EQ(found[i].distance, std::sqrt(best.squared_distance));
    EXPECT_EQ(found[i].point, best.point);
    EXPECT_EQ(found[i].weights, best.weights);
    if (found[i].distance > 0.0) {
      const bool inside = WindingNumber(m, q) > 0.5;
      EXPECT_EQ(found[i].signed_distance < 0.0, inside);
    }
    EXPECT_NEAR(found[i].normal.norm(), 1.0, 1e-14);
  }
}

TEST(SurfaceIndex, NearestIsBruteForceExactly) {
  const TriangleMesh m = BumpySphere(3);
  const SurfaceIndex index(m.vertices, m.faces);
  ExpectNearestIsBruteForce(index, m, RandomPoints(1500, 1.5, 1));
  ExpectNearestIsBruteForce(index, m, m.vertices);
}

// Far from the origin single precision resolves micrometres at best.
TEST(SurfaceIndex, StaysExactFarFromTheOriginAndAfterUpdates) {
  TriangleMesh m = BumpySphere(2);
  SurfaceIndex index(m.vertices, m.faces);
  for (const double shift : {3.0, 100.0, 5000.0}) {
    m.vertices.colwise() += Vector3d(shift, -shift, 0.5 * shift);
    m.vertices.row(0) *= 1.01;
    index.Update(m.vertices);
    Points queries = RandomPoints(300, 1.5, 2);
    queries.colwise() += Vector3d(m.vertices.rowwise().mean());
    ExpectNearestIsBruteForce(index, m, queries);
  }
}

// The sign at edges and corners, where a face's own normal would be wrong.
TEST(SurfaceIndex, SignAtSharpFeatures) {
  const TriangleMesh cube = UnitCube();
  const SurfaceIndex index(cube.vertices, cube.faces);
  const SurfacePoint corner = index.Nearest(Vector3d(1.2, 1.01, 1.4));
  EXPECT_TRUE(IsVertex(corner.feature));
  EXPECT_GT(corner.signed_distance, 0.0);
  EXPECT_LT((corner.normal - Vector3d::Ones().normalized()).norm(), 1e-14);
  const SurfacePoint edge = index.Nearest(Vector3d(1.2, 1.01, 0.5));
  EXPECT_LT((edge.normal - Vector3d(1, 1, 0).normalized()).norm(), 1e-14);
  const SurfacePoint inside = index.Nearest(Vector3d(0.5, 0.5, 0.9));
  EXPECT_NEAR(inside.signed_distance, -0.1, 1e-15);
  EXPECT_EQ(index.Nearest(Vector3d(0.3, 0.4, 1.0)).signed_distance, 0.0);
}

TEST(SurfaceIndex, NearestWithinRespectsTheRadius) {
  const TriangleMesh cube = UnitCube();
  const SurfaceIndex index(cube.vertices, cube.faces);
  const Vector3d q(0.5, 0.4, 1.25);
  EXPECT_FALSE(index.NearestWithin(q, 0.2499999999));
  ASSERT_TRUE(index.NearestWithin(q, 0.25));
  EXPECT_EQ(index.NearestWithin(q, 0.25)->distance, 0.25);
}

TEST(SurfaceIndex, WithinFindsEveryFace) {
  const TriangleMesh m = BumpySphere(2);
  const SurfaceIndex index(m.vertices, m.faces);
  const Points queries = RandomPoints(200, 1.5, 3);
  std::vector<FacePoint> found;
  for (int i = 0; i < queries.cols(); ++i) {
    const Vector3d q = queries.col(i);
    index.Within(q, 0.5, &found);
    size_t k = 0;
    for (int f = 0; f < m.faces.cols(); ++f) {
      const ClosestPoint p = OnFace(m, q, f);
      if (p.squared_distance > 0.25) continue;
      ASSERT_LT(k, found.size());
      EXPECT_EQ(found[k].face, f);
      EXPECT_EQ(found[k].point, p.point);
      EXPECT_EQ(found[k].distance, std::sqrt(p.squared_distance));
      ++k;
    }
    EXPECT_EQ(k, found.size());
  }
}

// Distance along the ray to a face, or infinity (Moeller & Trumbore 1997).
double HitDistance(const TriangleMesh& m,
                   int f,
                   const Vector3d& o,
                   const Vector3d& d) {
  const Vector3d a = m.vertices.col(m.faces(0, f));
  const Vector3d u = m.vertices.col(m.faces(1, f)) - a;
  const Vector3d v = m.vertices.col(m.faces(2, f)) - a;
  const Vector3d p = d.cross(v), s = o - a, r = s.cross(u);
  const double det = u.dot(p);
  const double b1 = s.dot(p) / det, b2 = d.dot(r) / det, t = v.dot(r) / det;
  const bool hit = b1 >= 0 && b2 >= 0 && b1 + b2 <= 1 && t >= 0;
  return hit ? t : std::numeric_limits<double>::infinity();
}

TEST(SurfaceIndex, FirstHitIsBruteForce) {
  const TriangleMesh m = BumpySphere(2);
  const SurfaceIndex index(m.vertices, m.faces);
  const Points from = RandomPoints(2000, 1.5, 4),
               way = RandomPoints(2000, 1, 5);
  int hits = 0;
  for (int i = 0; i < from.cols(); ++i) {
    const Vector3d o = from.col(i), d = way.col(i).normalized();
    double expected = std::numeric_limits<double>::infinity();
    for (int f = 0; f < m.faces.cols(); ++f)
      expected = std::min(expected, HitDistance(m, f, o, d));
    const auto hit = index.FirstHit(o, way.col(i), 10.0);
    ASSERT_EQ(hit.has_value(), std::isfinite(expected));
    EXPECT_EQ(index.AnyHit(o, way.col(i), 10.0), hit.has_value());
    if (!hit) continue;
    ++hits;
    EXPECT_NEAR(hit->distance, expected, 1e-9);
    Vector3d p = Vector3d::Zero();
    for (int c = 0; c < 3; ++c)
      p += hit->weights[c] * m.vertices.col(m.faces(c, hit->face));
    EXPECT_LT((p - o - hit->distance * d).norm(), 1e-9);
    EXPECT_FALSE(index.FirstHit(o, d, expected * 0.999));
    EXPECT_FALSE(index.AnyHit(o, d, expected * 0.999));
  }
  EXPECT_GT(hits, 500);
}

TEST(SurfaceIndex, ContainsIsTheWindingNumber) {
  TriangleMesh m = BumpySphere(2);
  const SurfaceIndex index(m.vertices, m.faces);
  const Points queries = RandomPoints(1000, 1.3, 6);
  for (int i = 0; i < queries.cols(); ++i)
    EXPECT_EQ(index.Contains(queries.col(i)),
              WindingNumber(m, queries.col(i)) > 0.5);
}

// Two overlapping balls: a point in both, next to the skin of one but deep in
// the other, is inside although the nearest skin has it on its outer side.
TEST(SurfaceIndex, ContainsIsRightWhereTheSurfaceCrossesItself) {
  const TriangleMesh ball = Sphere(3);
  const auto n = ball.vertices.cols(), f = ball.faces.cols();
  TriangleMesh two;
  two.vertices.resize(3, 2 * n);
  two.vertices << ball.vertices, ball.vertices.colwise() + Vector3d(1, 0, 0);
  two.faces.resize(3, 2 * f);
  two.faces << ball.faces, ball.faces.array() + static_cast<int>(n);
  const SurfaceIndex index(two.vertices, two.faces);
  const Vector3d q(-0.02, 0.0, 0.0);
  EXPECT_GT(index.Nearest(q).signed_distance, 0.0);
  EXPECT_TRUE(index.Contains(q));
  EXPECT_EQ(index.WindingNumber(q), 1);
  EXPECT_TRUE(index.Contains(Vector3d(0.5, 0.1, 0.0)));
  EXPECT_EQ(index.WindingNumber(Vector3d(0.5, 0.1, 0.0)), 2);
  EXPECT_FALSE(index.Contains(Vector3d(0.5, 1.0, 0.0)));
}

TEST(SurfaceIndex, ThreadsDoNotChangeResults) {
  const TriangleMesh m = BumpySphere(3);
  const SurfaceIndex index(m.vertices, m.faces);
  const Points queries = RandomPoints(3000, 1.5, 8);
  const auto parallel = index.NearestAll(queries);
  SetThreads(1);
  const auto serial = index.NearestAll(queries);
  SetThreads(0);
  for (size_t i = 0; i < serial.size(); ++i) {
    EXPECT_EQ(serial[i].face, parallel[i].face);
    EXPECT_EQ(serial[i].point, parallel[i].point);
    EXPECT_EQ(serial[i].signed_distance, parallel[i].signed_distance);
  }
}

TEST(SurfaceIndex, UpdatesInsideAParallelLoop) {
  const TriangleMesh m = Sphere(2);
  std::vector<double> distance(16);
  ParallelFor(16, 1, [&](int i) {
    SurfaceIndex index(m.vertices, m.faces);
    index.Update(m.vertices * (1.0 + i));
    distance[i] = index.Nearest(Vector3d(0, 0, 100)).distance;
  });
  for (int i = 0; i < 16; ++i) EXPECT_NEAR(distance[i], 99.0 - i, 1e-12);
}

TEST(SurfaceIndex, RefusesUnusableInput) {
  const TriangleMesh m = UnitCube();
  EXPECT_THROW(SurfaceIndex(m.vertices, Faces(3, 0)), InputError);
  EXPECT_THROW(SurfaceIndex(m.vertices.leftCols(7), m.faces), InputError);
  SurfaceIndex index(m.vertices, m.faces);
  EXPECT_THAT([&] { index.Update(m.vertices.leftCols(7)); },
              ::testing::ThrowsMessage<InputError>(
                  ::testing::HasSubstr("7 vertices, expected 8")));
  EXPECT_EQ(index.Nearest(Vector3d::Constant(std::nan(""))).face, -1);
}

}  // namespace
}  // namespace invsim
