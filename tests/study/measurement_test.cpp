// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/measurement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/shapes.h"
#include "invsim/base/error.h"
#include "invsim/base/threads.h"
#include "invsim/geometry/mesh.h"

namespace invsim {
namespace {

// A ball of radius 0.3 m with a cap of cloth 1 cm above its upper part.
class ScannedBall : public ::testing::Test {
 protected:
  ScannedBall() {
    const TriangleMesh ball = Sphere(4);
    body_ = 0.3 * ball.vertices;
    body_faces_ = ball.faces;
    cloth_ = 0.31 * ball.vertices;
    std::vector<int> top;
    for (int f = 0; f < ball.faces.cols(); ++f)
      if (ball.vertices(1, ball.faces(0, f)) > 0.3 &&
          ball.vertices(1, ball.faces(1, f)) > 0.3 &&
          ball.vertices(1, ball.faces(2, f)) > 0.3)
        top.push_back(f);
    cloth_faces_ = ball.faces(Eigen::all, top);
    exact_.noise = 0;
    exact_.points = 4000;
  }

  Measurement Measure(const MeasurementOptions& options,
                      std::uint64_t seed = 1,
                      int frame = 0) const {
    return Scanner(body_faces_, cloth_faces_, options, seed)
        .Measure(frame, body_, cloth_);
  }

  static double Share(const Measurement& m, PointOrigin origin) {
    return static_cast<double>(
               std::count(m.origins.begin(), m.origins.end(), origin)) /
           static_cast<double>(m.origins.size());
  }

  Points body_, cloth_;
  Faces body_faces_, cloth_faces_;
  MeasurementOptions exact_;
};

TEST_F(ScannedBall, CoveredSkinIsNotMeasured) {
  const Measurement m = Measure(exact_);
  ASSERT_EQ(m.points.cols(), 4000);
  ASSERT_EQ(m.origins.size(), 4000u);
  for (int i = 0; i < m.points.cols(); ++i) {
    const double r = m.points.col(i).norm();
    if (m.origins[i] == PointOrigin::kCloth) {
      EXPECT_NEAR(r, 0.31, 0.002);  // chords of the faces
      EXPECT_GT(m.points(1, i), 0.3 * 0.31 - 0.002);
    } else {
      EXPECT_NEAR(r, 0.3, 0.002);
      EXPECT_LT(m.points(1, i), 0.3 * 0.3 + 0.035);  // a ragged rim
    }
  }
}

TEST_F(ScannedBall, PointsAreSpreadByArea) {
  const Measurement m = Measure(exact_);
  const double cap = FaceAreas(cloth_, cloth_faces_).sum();
  // Skin below the cap's rim, which is ragged by a face.
  const double zone = 2 * M_PI * 0.3 * 0.3 * 1.31;
  EXPECT_NEAR(Share(m, PointOrigin::kCloth), cap / (cap + zone), 0.03);
}

TEST_F(ScannedBall, ShortReachLeavesSkinBare) {
  MeasurementOptions options = exact_;
  options.cover_reach = 0.005;
  const Measurement m = Measure(options);
  int under = 0;
  for (int i = 0; i < m.points.cols(); ++i)
    under += m.origins[i] == PointOrigin::kSkin && m.points(1, i) > 0.15;
  EXPECT_GT(under, 500);
}

TEST_F(ScannedBall, NoiseHasItsStandardDeviation) {
  MeasurementOptions noisy = exact_;
  noisy.noise = 0.004;
  // Noise is drawn after the places: they are the same with and without.
  const Points d = Measure(noisy).points - Measure(exact_).points;
  EXPECT_NEAR(d.mean(), 0, 0.0002);
  EXPECT_NEAR(std::sqrt(d.array().square().mean()), 0.004, 0.0001);
}

TEST_F(ScannedBall, OutliersLieWhereAskedFor) {
  MeasurementOptions options = exact_;
  options.outliers = 0.2;
  const Measurement m = Measure(options);
  EXPECT_NEAR(Share(m, PointOrigin::kOutlier), 0.2, 0.03);
  double farthest = 0, off = 0;
  for (int i = 0; i < m.points.cols(); ++i) {
    const double d = std::abs(m.points.col(i).norm() - 0.3);
    farthest = std::max(farthest, d);
    off += d > 0.02;
  }
  EXPECT_LT(farthest, 0.212);
  EXPECT_GT(farthest, 0.15);
  EXPECT_GT(off / 4000, 0.1);
}

TEST_F(ScannedBall, HolesAreEmptyAndMoveFromFrameToFrame) {
  MeasurementOptions options = exact_;
  options.holes = 2;
  options.hole_radius = 0.15;
  const auto largest_gap = [&](const Measurement& m, int* where) {
    // The vertex of the ball farthest from any point.
    double largest = 0;
    for (int i = 0; i < body_.cols(); ++i) {
      const double gap =
          (m.points.colwise() - body_.col(i)).colwise().norm().minCoeff();
      if (gap <= largest) continue;
      largest = gap;
      *where = i;
    }
    return largest;
  };
  int first = 0, second = 0, none = 0;
  EXPECT_GT(largest_gap(Measure(options, 1, 0), &first), 0.13);
  EXPECT_GT(largest_gap(Measure(options, 1, 1), &second), 0.13);
  EXPECT_LT(largest_gap(Measure(exact_), &none), 0.06);
  EXPECT_NE(first, second);
}

TEST_F(ScannedBall, UnevenDensityReachesItsRatio) {
  MeasurementOptions options = exact_;
  options.points = 40000;
  const auto spread = [&](const Measurement& m) {
    // Per octant, by area alike but for the cloth.
    VectorXd count = VectorXd::Zero(4);
    for (int i = 0; i < m.points.cols(); ++i)
      if (m.points(1, i) < 0)
        count[(m.points(0, i) > 0) + 2 * (m.points(2, i) > 0)] += 1;
    return count.maxCoeff() / count.minCoeff();
  };
  EXPECT_LT(spread(Measure(options)), 1.1);
  options.density_ratio = 20;
  const double ratio = spread(Measure(options));
  EXPECT_GT(ratio, 1.3);
  EXPECT_LT(ratio, 20);
}

TEST_F(ScannedBall, OneCameraSeesOneSide) {
  MeasurementOptions options = exact_;
  options.single_view = true;
  options.camera_direction = Vector3d(1, 0, 0);
  const Measurement m = Measure(options);
  EXPECT_EQ(m.points.cols(), 4000);
  // A camera 3 m away sees of a ball of radius r what lies beyond r / 3.
  EXPECT_GT(m.points.row(0).minCoeff(), 0.3 * 0.3 / 3 - 0.01);
  // Nothing of it is lost for being seen at a flat angle.
  EXPECT_LT(m.points.row(0).minCoeff(), 0.3 * 0.3 / 3 + 0.02);
}

TEST_F(ScannedBall, NothingToBeSeenIsAnError) {
  MeasurementOptions options = exact_;
  options.holes = 200;
  options.hole_radius = 0.5;
  EXPECT_THROW(Measure(options), InputError);
}

TEST_F(ScannedBall, SameSeedSamePointsOnAnyNumberOfThreads) {
  MeasurementOptions options;
  options.points = 500;
  options.outliers = 0.1;
  options.holes = 1;
  options.density_ratio = 3;
  const Points one = Measure(options, 7, 3).points;
  SetThreads(1);
  EXPECT_EQ(Measure(options, 7, 3).points, one);
  SetThreads(0);
  EXPECT_NE(Measure(options, 7, 4).points, one);
  EXPECT_NE(Measure(options, 8, 3).points, one);
}

}  // namespace
}  // namespace invsim
