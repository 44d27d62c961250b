// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/metrics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "geometry/shapes.h"
#include "invsim/base/error.h"
#include "invsim/base/random.h"
#include "sim/sphere_scene.h"
#include "sim/test_scene.h"

namespace invsim {
namespace {

using ::testing::HasSubstr;

// Nearest distances the slow way, over all pairs.
double MeanNearest(const Points& from, const Points& to) {
  double sum = 0;
  for (int i = 0; i < from.cols(); ++i)
    sum += (to.colwise() - from.col(i)).colwise().norm().minCoeff();
  return sum / static_cast<double>(from.cols());
}

// Vertices and the middles of all sides, each side once.
Points WithMidpoints(const Points& v, const Faces& faces) {
  std::map<std::pair<int, int>, Vector3d> middles;
  for (int f = 0; f < faces.cols(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int a = faces(k, f), b = faces((k + 1) % 3, f);
      middles[std::minmax(a, b)] = 0.5 * (v.col(a) + v.col(b));
    }
  Points all(3, v.cols() + middles.size());
  all.leftCols(v.cols()) = v;
  int i = static_cast<int>(v.cols());
  for (const auto& [edge, middle] : middles) all.col(i++) = middle;
  return all;
}

// Möller-Trumbore over all faces.
bool MeetsWithin(const Vector3d& o,
                 const Vector3d& d,
                 const Points& v,
                 const Faces& faces,
                 double reach) {
  for (int f = 0; f < faces.cols(); ++f) {
    const Vector3d a = v.col(faces(0, f));
    const Vector3d e1 = v.col(faces(1, f)) - a, e2 = v.col(faces(2, f)) - a;
    const Vector3d h = d.cross(e2);
    const double det = e1.dot(h);
    if (std::abs(det) < 1e-14) continue;
    const Vector3d q = o - a;
    const double u = q.dot(h) / det, w = d.dot(q.cross(e1)) / det;
    const double l = e2.dot(q.cross(e1)) / det;
    if (u >= 0 && w >= 0 && u + w <= 1 && l > 0 && l < reach) return true;
  }
  return false;
}

struct Soup {
  Points vertices;
  Faces faces;
};

// Garment and bare body, the slow way.
Soup Seen(const Points& body,
          const Faces& bf,
          const Points& x,
          const Faces& cf) {
  const Points normals = VertexNormals(body, bf);
  std::vector<bool> hidden(body.cols());
  for (int i = 0; i < body.cols(); ++i)
    hidden[i] = MeetsWithin(body.col(i), normals.col(i), x, cf, 0.15);
  std::vector<int> number(body.cols(), -1);
  std::vector<Vector3d> vertices;
  for (int i = 0; i < x.cols(); ++i) vertices.push_back(x.col(i));
  std::vector<Eigen::Vector3i> faces;
  for (int f = 0; f < cf.cols(); ++f) faces.push_back(cf.col(f));
  for (int f = 0; f < bf.cols(); ++f) {
    if (hidden[bf(0, f)] || hidden[bf(1, f)] || hidden[bf(2, f)]) continue;
    Eigen::Vector3i face;
    for (int k = 0; k < 3; ++k) {
      int& n = number[bf(k, f)];
      if (n < 0) {
        n = static_cast<int>(vertices.size());
        vertices.push_back(body.col(bf(k, f)));
      }
      face[k] = n;
    }
    faces.push_back(face);
  }
  Soup soup;
  soup.vertices.resize(3, vertices.size());
  for (size_t i = 0; i < vertices.size(); ++i)
    soup.vertices.col(i) = vertices[i];
  soup.faces.resize(3, faces.size());
  for (size_t f = 0; f < faces.size(); ++f) soup.faces.col(f) = faces[f];
  return soup;
}

// A ball that moves under a sheet; the estimate is a little off.
class MetricsTest : public ::testing::Test {
 protected:
  MetricsTest() : body_(BallBody()), reference_{body_, {}, {}, {}} {
    const TriangleMesh grid = Grid(6);
    reference_.cloth_faces = grid.faces;
    Motion& truth = reference_.truth.body;
    truth.frame_rate = 20;
    Random random(3);
    estimate_.body.frame_rate = 20;
    truth.shape[0] = 0.3;
    estimate_.body.shape[0] = 0.1;
    for (int t = 0; t < 5; ++t) {
      PoseVector pose = PoseVector::Zero();
      pose[2] = 0.1 * t;
      truth.poses.push_back(pose);
      truth.translations.push_back(Vector3d(0.01 * t * t, 0, 0));
      estimate_.body.poses.push_back(0.9 * pose);
      estimate_.body.translations.push_back(truth.translations[t] +
                                            Noise(0.004, &random));
      Points x = 0.5 * grid.vertices;
      x.array() -= 0.25;
      x.row(2).setConstant(kBallRadius + 0.01);
      reference_.truth.cloth.push_back(x);
      Points y = x;
      for (int i = 0; i < y.cols(); ++i) y.col(i) += Noise(0.005, &random);
      if (t == 2) y(2, 24) -= 0.05;  // into the ball
      cloth_.push_back(y);
      Points p(3, 50);
      for (int i = 0; i < 50; ++i) p.col(i) = Noise(0.1, &random);
      points_.push_back(p);
    }
    reference_.points = [this](int t) { return points_[t]; };
    estimate_.cloth = [this](int t) {
      return std::optional<ClothEstimate>(ClothEstimate{cloth_[t]});
    };
  }

  static Vector3d Noise(double sigma, Random* random) {
    return sigma *
           Vector3d(random->Normal(), random->Normal(), random->Normal());
  }
  Points Body(const Motion& m, int t) const {
    return body_.Vertices(m.Frame(t));
  }

  BodyModel body_;
  Reference reference_;
  Estimate estimate_;
  std::vector<Points> cloth_, points_;
};

TEST_F(MetricsTest, AgreeWithAllPairs) {
  const Metrics metrics = Evaluate(reference_, estimate_);
  ASSERT_EQ(metrics.frames.size(), 5u);
  const Faces& bf = body_.faces();
  const Faces& cf = reference_.cloth_faces;
  for (int t = 0; t < 5; ++t) {
    const FrameMetrics& m = metrics.frames[t];
    const Points a = Body(estimate_.body, t);
    const Points b = Body(reference_.truth.body, t);
    EXPECT_NEAR(m.body_v2v, 1000 * (a - b).colwise().norm().mean(), 1e-9);
    const Points am = WithMidpoints(a, bf), bm = WithMidpoints(b, bf);
    EXPECT_NEAR(m.body_chamfer.a_to_b, 1000 * MeanNearest(am, bm), 1e-9);
    EXPECT_NEAR(m.body_chamfer.b_to_a, 1000 * MeanNearest(bm, am), 1e-9);
    const Points x = WithMidpoints(cloth_[t], cf);
    const Points y = WithMidpoints(reference_.truth.cloth[t], cf);
    EXPECT_NEAR(m.cloth_chamfer.a_to_b, 1000 * MeanNearest(x, y), 1e-9);
    EXPECT_NEAR(m.cloth_chamfer.b_to_a, 1000 * MeanNearest(y, x), 1e-9);
    const Soup s = Seen(a, bf, cloth_[t], cf);
    const Soup r = Seen(b, bf, reference_.truth.cloth[t], cf);
    EXPECT_LT(s.faces.cols(), bf.cols() + cf.cols());  // some skin is hidden
    const Points sm = WithMidpoints(s.vertices, s.faces);
    const Points rm = WithMidpoints(r.vertices, r.faces);
    EXPECT_NEAR(m.combined_chamfer.a_to_b, 1000 * MeanNearest(sm, rm), 1e-9);
    EXPECT_NEAR(m.combined_chamfer.b_to_a, 1000 * MeanNearest(rm, sm), 1e-9);
    double sum = 0;
    for (int i = 0; i < points_[t].cols(); ++i) {
      double nearest = 1e9;
      for (int f = 0; f < s.faces.cols(); ++f)
        nearest = std::min(nearest,
                           ClosestPointOnTriangle(points_[t].col(i),
                                                  s.vertices.col(s.faces(0, f)),
                                                  s.vertices.col(s.faces(1, f)),
                                                  s.vertices.col(s.faces(2, f)))
                               .squared_distance);
      sum += std::sqrt(nearest);
    }
    EXPECT_NEAR(m.points_to_surface, 1000 * sum / 50, 1e-9);
  }
  // The shape scales the ball by a tenth; poses do not count.
  EXPECT_NEAR(metrics.body_tpose_v2v, 1000 * kBallRadius * 0.1 * 0.2, 1e-9);
}

TEST_F(MetricsTest, TheTruthScoresZero) {
  estimate_.body = reference_.truth.body;
  cloth_ = reference_.truth.cloth;
  for (const auto& [key, value] : Evaluate(reference_, estimate_).Values()) {
    if (key == "points_to_surface_mean_mm" ||
        key.find("jerk") != std::string::npos)
      EXPECT_GT(value, 0) << key;
    else
      EXPECT_EQ(value, 0) << key;
  }
}

TEST_F(MetricsTest, PenetrationIsTheDeepestVertexOfAllFrames) {
  const Metrics metrics = Evaluate(reference_, estimate_);
  const Points ball = Body(estimate_.body, 2);
  const SurfaceIndex skin(ball, body_.faces());
  double deepest = 0;
  for (int i = 0; i < cloth_[2].cols(); ++i)
    if (skin.Contains(cloth_[2].col(i)))
      deepest = std::max(deepest, skin.Nearest(cloth_[2].col(i)).distance);
  ASSERT_GT(deepest, 0.02);
  std::map<std::string, double> values;
  for (const auto& [key, value] : metrics.Values()) values[key] = value;
  EXPECT_NEAR(values["penetration_max_mm"], 1000 * deepest, 1e-9);
  EXPECT_GT(values["penetrating_vertices_share"], 0);
}

TEST_F(MetricsTest, AccelerationAndJerkOfAKnownMotion) {
  // x = 0.01 t^2 per frame: acceleration 0.02 fps^2, no jerk. The root turns
  // about its own joint, which does not move it.
  estimate_.body = reference_.truth.body;
  for (int t = 0; t < 5; ++t)
    estimate_.body.translations[t] = Vector3d(0, 0.001 * t * t * t, 0);
  estimate_.cloth = {};
  reference_.truth.body.poses.assign(5, PoseVector::Zero());
  estimate_.body.poses.assign(5, PoseVector::Zero());
  const Metrics metrics = Evaluate(reference_, estimate_);
  EXPECT_NEAR(metrics.jerk_truth, 0, 1e-9);
  EXPECT_NEAR(metrics.jerk, 0.006 * 20 * 20 * 20, 1e-9);
  // Second differences: truth (0.02, 0), estimate (0, 0.006 (t + 1)).
  double mean = 0;
  for (int t = 0; t < 3; ++t)
    mean += std::hypot(0.02, 0.006 * (t + 1)) * 400 / 3;
  EXPECT_NEAR(metrics.acceleration_error, mean, 1e-9);
  EXPECT_TRUE(std::isnan(metrics.frames[0].cloth_v2v));
}

TEST_F(MetricsTest, ConeViolationOfKnownForces) {
  const Points ball = body_.Vertices({});
  const SurfaceIndex skin(ball, body_.faces());
  ClothEstimate cloth;
  cloth.vertices = 1.05 * ball.leftCols(4);
  cloth.force = Points::Zero(3, 4);
  Points normal(3, 4), tangent(3, 4);
  for (int i = 0; i < 4; ++i) {
    normal.col(i) = skin.Nearest(cloth.vertices.col(i)).normal;
    tangent.col(i) = normal.col(i).unitOrthogonal();
  }
  // No force; inside the cone; outside by 0.2; a pull.
  cloth.force.col(1) = normal.col(1) + 0.29 * tangent.col(1);
  cloth.force.col(2) = normal.col(2) + 0.5 * tangent.col(2);
  cloth.force.col(3) = -normal.col(3);
  const ConeViolation v = MeasureConeViolation(skin, cloth, 0.3);
  EXPECT_NEAR(v.excess, 0.2 + 0.3, 1e-12);
  EXPECT_NEAR(v.force, std::hypot(1, 0.29) + std::hypot(1, 0.5) + 1, 1e-12);
}

// A fit may use a coarser garment than the one that was measured.
TEST_F(MetricsTest, ClothOfAnotherMeshIsComparedAsASurface) {
  // The same surface with its vertices in another order, and one added.
  estimate_.cloth = [&](int t) {
    ClothEstimate cloth;
    const Points& truth = reference_.truth.cloth[t];
    cloth.vertices.resize(3, truth.cols() + 1);
    cloth.vertices << truth.col(0), truth;
    cloth.faces = reference_.cloth_faces.array() + 1;
    return std::optional<ClothEstimate>(cloth);
  };
  const Metrics metrics = Evaluate(reference_, estimate_);
  EXPECT_TRUE(std::isnan(metrics.frames[0].cloth_v2v));
  EXPECT_NEAR(metrics.frames[0].cloth_chamfer.mean(), 0, 1e-9);
}

TEST_F(MetricsTest, MismatchesAreNamed) {
  cloth_[1] = Points::Zero(3, 3);
  try {
    Evaluate(reference_, estimate_);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("frame 1"));
    EXPECT_THAT(error.what(), HasSubstr("3 vertices, expected 49"));
  }
  estimate_.body.poses.pop_back();
  EXPECT_THROW(Evaluate(reference_, estimate_), InputError);
}

}  // namespace
}  // namespace invsim
